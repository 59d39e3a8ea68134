// The slider-crank of Flores et al. (2006) with clearance between rod and slider, written a second time by
// hand: two coordinates (the rod's angle, the slider's position), a crank that turns evenly, no gravity,
// nothing shared with the library. What differs from one author to the next, the lever of friction on the
// journal, is an argument.
//
// Without friction it gives the impacts of tests/reference/flores_slider_crank.py digit for digit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace boresight::scenes {

class SliderCrankInTwoCoordinates {
 public:
  struct Event {
    double start, speed, angle,
        sliding;  // [s], [m/s], of the journal's contact from the bearing's centre [rad], [m/s]
    double depth = 0.0, force = 0.0, end_speed = 0.0, duration = 0.0;  // [m], [N], [m/s], [s]
  };

  // damping_factor: h of F = K d^1.5 (1 + h d' / d'_0). friction: 0.03 ramped from 1 to 10 mm/s where asked
  // for. lever: from the journal's centre to where friction acts, of the penetration [m].
  SliderCrankInTwoCoordinates(double damping_factor, bool friction, std::function<double(double)> lever)
      : h_(damping_factor), mu_(friction ? 0.03 : 0.0), lever_(std::move(lever)) {}

  // Contacts begun and ended before `duration` [s]: RK4 with a uniform step, cut at each contact's start and
  // end.
  std::vector<Event> events(double duration, double step) {
    State y = {0.0, kCrank + kRod, -kCrank * kSpeed / kRod, 0.0};  // the ideal mechanism, in line
    std::vector<Event> out;
    bool touching = false;
    for (double t = 0.0; t < duration;) {
      State next = rk4(t, y, step);
      Contact c = contact(t + step, next);
      if ((c.depth > 0.0) == touching) {
        y = next;
        t += step;
        if (touching) {
          out.back().depth = std::max(out.back().depth, c.depth);
          out.back().force = std::max(out.back().force, c.normal);
        }
        continue;
      }
      double before = 0.0, after = step;
      while (after - before > 1e-12 * step) {
        const double middle = 0.5 * (before + after);
        ((contact(t + middle, rk4(t, y, middle)).depth > 0.0) == touching ? before : after) = middle;
      }
      y = rk4(t, y, after);
      t += after;
      c = contact(t, y);
      touching = !touching;
      if (touching) {
        impact_speed_ = c.rate;
        out.push_back({t, c.rate, std::atan2(c.ny, c.nx), c.sliding});
      } else {
        out.back().end_speed = -c.rate;
        out.back().duration = t - out.back().start;
      }
    }
    if (touching) out.pop_back();
    return out;
  }

  static constexpr double kBearing = 0.01, kClearance = 0.5e-3,
                          kJournal = kBearing - kClearance;                 // radii [m]
  static constexpr double kCrank = 0.05, kRod = 0.12;                       // lengths [m]
  static constexpr double kSpeed = 2.0 * std::numbers::pi * 5000.0 / 60.0;  // [rad/s]

 private:
  using State = std::array<double, 4>;  // rod's angle, slider's position, their rates
  struct Contact {
    double depth, rate, nx, ny, sliding, normal, friction;
  };

  Contact contact(double t, const State& y) const {
    const double x = kCrank * std::cos(kSpeed * t) + kRod * std::cos(y[0]) - y[1],
                 z = kCrank * std::sin(kSpeed * t) + kRod * std::sin(y[0]);
    const double vx = -kCrank * kSpeed * std::sin(kSpeed * t) - kRod * std::sin(y[0]) * y[2] - y[3],
                 vz = kCrank * kSpeed * std::cos(kSpeed * t) + kRod * std::cos(y[0]) * y[2];
    const double length = std::hypot(x, z) + 1e-30;
    Contact c{length - kClearance, 0.0, x / length, z / length, 0.0, 0.0, 0.0};
    c.rate = vx * c.nx + vz * c.ny;
    c.sliding = -vx * c.ny + vz * c.nx + y[2] * lever_(std::max(c.depth, 0.0));
    if (c.depth <= 0.0) return c;
    const double stiffness =  // steel on steel: 207 GPa, 0.3
        4.0 / 3.0 * 207e9 / (2.0 * (1.0 - 0.3 * 0.3)) * std::sqrt(kBearing * kJournal / kClearance);
    c.normal = std::max(0.0, stiffness * std::pow(c.depth, 1.5) * (1.0 + h_ * c.rate / impact_speed_));
    const double ramp = std::clamp((std::abs(c.sliding) - 1e-3) / 9e-3, 0.0, 1.0);
    c.friction = -std::copysign(mu_ * ramp * c.normal, c.sliding);
    return c;
  }

  State rate(double t, const State& y) const {
    constexpr double rod_mass = 0.21, rod_inertia = 2.5e-4, slider_mass = 0.14;
    const Contact c = contact(t, y);
    const double fx = -c.normal * c.nx - c.friction * c.ny, fz = -c.normal * c.ny + c.friction * c.nx;
    const double ax = -kCrank * kSpeed * kSpeed * std::cos(kSpeed * t),
                 az = -kCrank * kSpeed * kSpeed * std::sin(kSpeed * t);
    const double sine = std::sin(y[0]), cosine = std::cos(y[0]);
    // About the crank pin, which accelerates.
    const double moment = kRod * (cosine * fz - sine * fx) + lever_(std::max(c.depth, 0.0)) * c.friction -
                          0.5 * rod_mass * kRod * (cosine * az - sine * ax);
    return {y[2], y[3], moment / (rod_inertia + 0.25 * rod_mass * kRod * kRod), -fx / slider_mass};
  }

  State rk4(double t, const State& y, double step) const {
    const auto moved = [&y](const State& k, double by) {
      State z = y;
      for (int i = 0; i < 4; ++i) z[i] += by * k[i];
      return z;
    };
    const State a = rate(t, y), b = rate(t + 0.5 * step, moved(a, 0.5 * step)),
                c = rate(t + 0.5 * step, moved(b, 0.5 * step)), d = rate(t + step, moved(c, step));
    State out = y;
    for (int i = 0; i < 4; ++i) out[i] += step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    return out;
  }

  double h_, mu_, impact_speed_ = 1.0;
  std::function<double(double)> lever_;
};

}  // namespace boresight::scenes
