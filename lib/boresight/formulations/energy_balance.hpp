// Whether a computed motion keeps its energy: what the bodies have gained must be what was done to them,
//
//   E(t) - E(0) = integral of P dt,     E = sum of m |v_c|^2 / 2 + w . I w / 2 - m g . p_c   (kinetic and gravitational),
//
// with P the power of drives, loads, springs, dampers, contacts and their friction. P is read off the accelerations, so
// one line serves every formulation: what the bodies gain, m v_c . a_c + w . I alpha, less what gravity gives them, less
// what the reactions of ideal joints do where a joint's rows are opening (in an exact motion they never open). It is
// integrated along with the motion, by the method's own weights or at its step's nodes, so what is left over is what the
// steps, the stabilisation and the joints' drift have made or lost. A step that is too large for a contact shows here.
//
// The error is the largest |E(t) - E(0) - W(t)|, relative to the largest energy met: kinetic, risen against gravity, or
// handed over. Positions are taken from where the bodies start, so that it does not matter where a drawing lies. Of a
// mechanism that rests there is no such share: what rounding moves is not looked at.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "boresight/formulations/body_energy.hpp"
#include "boresight/formulations/formulation.hpp"

namespace boresight {

class EnergyBalance {
 public:
  EnergyBalance(const Mechanism& mechanism, const Parameters& parameters, const std::vector<BodyMotion>& start)
      : mass_(mechanism.mass_properties(parameters)), gravity_(parameters.gravity) {
    double away = mechanism.characteristic_length(), masses = 0.0;
    for (std::size_t b = 0; b < mass_.size(); ++b) {
      start_.push_back(start[b].p + start[b].R * mass_[b].c);
      away = std::max(away, start_[b].norm());
      masses += mass_[b].mass;
    }
    const double rounding = kRoundingOfPlaces * away;
    of_rounding_ = masses * (gravity_.norm() * rounding + rounding * rounding / (kSecond * kSecond));
    first_ = energy(start);
  }

  // P [W], of the formulation's last derivative(), whose bodies these are.
  double power(const Formulation& formulation, const std::vector<BodyMotion>& bodies) const {
    const std::vector<BodyAcceleration>& acceleration = formulation.acceleration();
    double sum = -formulation.opening_power();
    for (std::size_t b = 0; b < mass_.size(); ++b) {
      const MassProperties& m = mass_[b];
      const BodyMotion& body = bodies[b];
      const Vec3 a = acceleration[b].head<3>(), alpha = acceleration[b].tail<3>();
      const Vec3 c = body.R * m.c;
      const Vec3 v = body.v + body.w.cross(c), v_dot = a + alpha.cross(c) + body.w.cross(body.w.cross(c));
      sum += m.mass * v.dot(v_dot - gravity_) +
             (body.R.transpose() * body.w).dot(m.inertia * (body.R.transpose() * alpha));
    }
    return sum;
  }

  void add_work(double work) { work_ += work; }

  // After each accepted step, with all its work added.
  void look(const std::vector<BodyMotion>& bodies) {
    const double now = energy(bodies);
    largest_error_ = std::max(largest_error_, std::abs(now - first_ - work_));
    largest_energy_ = std::max(largest_energy_, std::abs(work_));
  }

  double error() const { return largest_energy_ > of_rounding_ ? largest_error_ / largest_energy_ : 0.0; }

 private:
  // Fifty thousand times what a place is rounded to, of its size: what steps and the closing of joints make of it stays below.
  static constexpr double kRoundingOfPlaces = 1e-11;
  static constexpr double kSecond = 1.0;  // in which such a way is gone by what rests [s]

  double energy(const std::vector<BodyMotion>& bodies) {
    double kinetic = 0.0, potential = 0.0;
    for (std::size_t b = 0; b < mass_.size(); ++b) {
      kinetic += kinetic_energy(mass_[b], bodies[b]);
      potential += potential_energy(mass_[b], bodies[b], gravity_, start_[b]);
    }
    largest_energy_ = std::max({largest_energy_, kinetic, std::abs(potential)});
    return kinetic + potential;
  }

  std::vector<MassProperties> mass_;
  Vec3 gravity_;
  std::vector<Vec3> start_;   // of the centres of mass, world axes [m]
  double of_rounding_ = 0.0;  // the energy of a body that falls as far as rounding may move it, and goes as fast [J]
  double first_ = 0.0, work_ = 0.0, largest_error_ = 0.0, largest_energy_ = 0.0;  // [J]
};

}  // namespace boresight
