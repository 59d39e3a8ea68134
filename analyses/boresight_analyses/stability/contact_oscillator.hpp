// The linear contact: a journal of mass m on a spring and a damper, stepped by the project's own Runge-Kutta
// methods.
//   m x'' + c x' + k x = 0,   omega = sqrt(k / m),   zeta = c / (2 m omega)
// What a contact is to an explicit method once the journal touches; its own nonlinearity moves omega with the
// depth.
#pragma once

#include "boresight/integrate/explicit_tables.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

struct ContactOscillator {
  double mass = 1.0;       // [kg]
  double stiffness = 0.0;  // [N/m]
  double damping = 0.0;    // [N s/m]

  static ContactOscillator of(double mass, double angular_frequency, double damping_ratio) {
    return {mass, mass * angular_frequency * angular_frequency, 2.0 * damping_ratio * mass * angular_frequency};
  }
  void derivative(double, const VecX& y, VecX& dy) const {
    dy[0] = y[1];
    dy[1] = -(stiffness * y[0] + damping * y[1]) / mass;
  }
};

// Growth per step of the oscillation when `method` steps it with step h [s], read off the displacement over
// 12 steps.
double measured_growth(const ExplicitTable& method, const ContactOscillator& contact, double h);

}  // namespace boresight
