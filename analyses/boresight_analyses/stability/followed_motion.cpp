#include "boresight_analyses/stability/followed_motion.hpp"

#include <algorithm>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {
namespace {

constexpr double kMostSteps = 1e5;

RunResult run(const Rung& rung, const Mechanism& mechanism, double until) {
  RunOptions options;
  options.sample_spacing = std::min(1e-3, mechanism.duration() / 1000.0);
  options.events = false;
  options.model_look = ModelLook::shares;
  options.integrator = "rk4";
  if (until < mechanism.duration()) options.progress = [until](const RunProgress& p) { return p.t < until; };
  return rung.run(mechanism.parameters(), options);
}

}  // namespace

RunOptions FollowedMotion::options(double at_step) const {
  RunOptions options;
  options.step = at_step;
  options.sample_spacing = 0.0;
  options.events = false;
  options.model_look = ModelLook::shares;
  options.progress = [until = until](const RunProgress& p) { return p.t < until; };
  return options;
}

FollowedMotion follow(const std::shared_ptr<const Mechanism>& mechanism) {
  // A rung's own step is the paper's or shorter, so this much is a hundred thousand steps or more.
  const double until = std::min(mechanism->duration(), kMostSteps * kPaperStep);
  FollowedMotion followed;
  try {
    followed.rung = make_rung("perturbation", mechanism);
    followed.result = run(*followed.rung, *mechanism, until);
  } catch (const ComputationError&) {
    followed.rung = make_rung("multibody", mechanism);
    followed.result = run(*followed.rung, *mechanism, until);
  }
  // The steps counted are those of the whole motion.
  followed.step = mechanism->duration() / static_cast<double>(std::max<std::int64_t>(1, followed.result.cost.steps));
  followed.until = std::min(mechanism->duration(), kMostSteps * followed.step);
  return followed;
}

}  // namespace boresight
