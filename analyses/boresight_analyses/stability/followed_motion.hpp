// Runs of a rung for a stability report: the first rung with dynamics that can follow the scene, its step,
// and how much of a long motion is looked at.
#pragma once

#include <memory>
#include <optional>

#include "boresight/rungs/rung.hpp"

namespace boresight {

struct FollowedMotion {
  std::shared_ptr<const Rung> rung;  // perturbation; multibody where that refuses
  double step = 0.0;                 // its own [s]
  double until = 0.0;                // time up to which runs are followed [s]: a hundred thousand steps at most
  RunResult result;                  // at its own step, with histories

  // Options of further runs.
  RunOptions options(double at_step) const;
};

// Throws ComputationError where not even multibody can follow the motion.
FollowedMotion follow(const std::shared_ptr<const Mechanism>& mechanism);

}  // namespace boresight
