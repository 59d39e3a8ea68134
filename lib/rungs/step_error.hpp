// What a fixed step of RK4 does to the indices, estimated from the stiffest vibration met in contact.
//
// A contact's force has a kink at its start (order 2.5 in the phase of the vibration a step covers, w h), and impacts in
// their sequence scatter the rest. Measured on the default scene over steps from 1e-5 to 1e-4 s and loads from 0 to 500 kg:
// the maximum moves by about 0.15 percent times (w h)^2.5, over a floor of scatter.
#pragma once

#include <algorithm>
#include <cmath>

namespace boresight {

inline constexpr double kScatterOfImpacts = 2e-3;

// angular_frequency: of the stiffest contact met [rad/s], 0 if nothing touched; step [s].
inline double step_error(double angular_frequency, double step) {
  if (angular_frequency <= 0.0) return 0.0;
  return std::min(1.0, kScatterOfImpacts + 1.5e-3 * std::pow(angular_frequency * step, 2.5));
}

// The same of steps that locate contacts: tolerance over the smallest clearance, of one step; what many steps make of
// it, see the README of tests/benchmarks.
inline double tolerance_error(double tolerance) { return std::min(1.0, kScatterOfImpacts + tolerance); }

}  // namespace boresight
