#include "boresight/rungs/scene_rung.hpp"

#include <chrono>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/ideal_simulation.hpp"

namespace boresight {

RunResult SceneRung::run(const Parameters& parameters, const RunOptions& options) const {
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = thread_cpu_seconds();
  if (!options.pose_bodies.empty())
    throw ComputationError("the " + name() + " rung follows the boresight body only; poses of other bodies need multibody");
  std::call_once(once_, [this] {
    if (!is_kinematic(*mechanism_))
      throw ComputationError("the " + name() + " rung needs a motion that is prescribed in all its freedoms; use multibody");
    ideal_.emplace(IdealMotion::kinematic(*mechanism_));
    scene_.emplace(*mechanism_, *ideal_);
  });
  RunResult result = follow(parameters, options);
  result.rung = name();
  result.cost.cpu_seconds = thread_cpu_seconds() - cpu;
  result.cost.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return result;
}

}  // namespace boresight
