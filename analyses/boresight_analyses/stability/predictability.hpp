// How long a motion with impacts can be foretold. Two runs that differ by a whisper in the clearance part
// company at a rate that the impacts set; from the horizon on trajectories are chance, and only their
// statistics hold.
#pragma once

#include <vector>

#include "boresight/perturbation/predictability.hpp"
#include "boresight_analyses/stability/followed_motion.hpp"

namespace boresight {

struct Separation {
  double start = 0.0;            // relative difference of the clearances [-]
  std::vector<double> time;      // [s]
  std::vector<double> distance;  // between the boresight body's positions, over the radial clearance [-]
  double horizon = 0.0;          // first time at which the distance exceeds kApart [s]; negative: never
  double max_difference = 0.0, rms_difference = 0.0;  // of the position error's maximum and RMS, relative
};

inline constexpr double kApart =
    kPartedShare;  // of the clearance: the trajectories have nothing to do with each other any more

// For each relative difference given.
std::vector<Separation> separations(const Mechanism& mechanism, const FollowedMotion& followed,
                                    const std::vector<double>& starts);

}  // namespace boresight
