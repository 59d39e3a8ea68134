// How long a computed trajectory means anything: impacts in a clearance amplify every difference, however small, until
// two motions that started alike go their own ways. Past that time only statistics (the indices) can be judged,
// whatever the method.
//
// Measured by twins: the perturbation rung, RK4 at its own step, once as it is and once started kStartOffset off in
// every coordinate (a picometre: a million roundings of a clearance, a millionth of what the steps themselves err by).
// They have parted where the offset of any journal differs by kPartedShare of its joint's radial clearance. Fixed
// steps, because error control decides by thresholds: its twins would part by the tolerance at the first decision that
// differs. A run errs by more than a picometre, so its own trajectory is lost somewhat sooner: by ln(error /
// kStartOffset) / growth.
#pragma once

#include <memory>
#include <string>

#include "boresight/rungs/rung.hpp"

namespace boresight {

inline constexpr double kStartOffset = 1e-12;  // [m or rad]
inline constexpr double kPartedShare = 0.1;

struct Predictability {
  bool measured = false;
  std::string refusal;   // why not, where not measured
  bool parted = false;   // before the end of the motion
  double horizon = 0.0;  // when they parted, or the end of the motion [s]
  double growth = 0.0;   // mean rate up to there, of the logarithm of their difference [1/s]
  // How the twins' indices of position error differ, relative, though their trajectories may have parted.
  double max_difference = 0.0, rms_difference = 0.0;
};

Predictability measure_predictability(std::shared_ptr<const Mechanism> mechanism, const Parameters& parameters);

}  // namespace boresight
