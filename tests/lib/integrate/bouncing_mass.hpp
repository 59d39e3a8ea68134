// One mass above a floor: the smallest system with everything that a joint with clearance asks of an integrator.
//   m x'' = -m g + F,   F = K d^n (1 + h d'/d'0) >= 0,   d = -x,   y = (x, x')
// The family of Hunt and Crossley (1975); h = 8 (1 - e)/(5 e) is the law of Flores et al. (2011).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "boresight/integrate/integrator.hpp"

namespace boresight::testing_scenes {

struct BouncingMass {
  double mass = 1.0, gravity = 0.0, stiffness = 1e8, power = 1.5, damping = 0.0;
  double minimum_speed = 1e-3;

  // Discrete memory.
  bool touching = false;
  double impact_speed = 1e-3;
  // False: the force follows the sign of the gap, as where steps do not stop at contact.
  bool follows_memory = true;

  std::vector<double> closing_times{}, closing_speeds{}, opening_speeds{};
  int lastings = 0;

  static constexpr bool autonomous = true;
  int gap_count() const { return 1; }
  void gaps(double, const VecX& y, VecX& g) const { g[0] = y[0]; }
  double force(const VecX& y) const {
    const double d = -y[0];
    if (d <= 0.0 || (follows_memory && !touching)) return 0.0;
    return std::max(0.0, stiffness * std::pow(d, power) * (1.0 - damping * y[1] / impact_speed));
  }
  void derivative(double, const VecX& y, VecX& dy) const {
    dy[0] = y[1];
    dy[1] = force(y) / mass - gravity;
  }
  void jacobian(double, const VecX& y, MatX& j) const {
    const double d = -y[0];
    j << 0.0, 1.0, 0.0, 0.0;
    if (force(y) <= 0.0) return;
    const double elastic = stiffness * std::pow(d, power), damped = 1.0 - damping * y[1] / impact_speed;
    j(1, 0) = -power * elastic / d * damped / mass;
    j(1, 1) = -elastic * damping / impact_speed / mass;
  }
  AfterEvent on_event(const GapEvent& event, VecX& y) {
    touching = event.crossing == Crossing::closing || event.crossing == Crossing::lasting;
    if (touching) impact_speed = std::max(minimum_speed, -y[1]);
    if (event.crossing == Crossing::closing) {
      closing_times.push_back(event.t);
      closing_speeds.push_back(-y[1]);
    }
    if (event.crossing == Crossing::opening) opening_speeds.push_back(y[1]);
    lastings += event.crossing == Crossing::lasting;
    return AfterEvent::crossed;
  }

  double flores(double restitution) { return damping = 8.0 * (1.0 - restitution) / (5.0 * restitution); }
  // Depth of an undamped impact at speed v, without load [m].
  double depth(double v) const {
    return std::pow((power + 1.0) * mass * v * v / (2.0 * stiffness), 1.0 / (power + 1.0));
  }
};

inline VecX state_of(double x, double v) {
  VecX y(2);
  y << x, v;
  return y;
}

}  // namespace boresight::testing_scenes
