// Which integrator follows a motion where none is asked for: rk4 with its own step, and rosenbrock in its place where that step is no step for
// this motion: it blows up, or a contact is damped faster than it follows.
//
// Shorter steps of rk4 would go on from there as well, but what they make of such contacts is wrong by any amount until they follow them:
// with a planar loop of the gauntlet ten times, at a step that does not blow up, for two hundred times the cost of rosenbrock.
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/rung.hpp"
#include "boresight/rungs/singular_pose.hpp"
#include "boresight/rungs/unstable_step.hpp"

namespace boresight {

// own: of rk4 [s]. by_steps(step): rk4. located(options): the integrator that the options name.
template <typename Steps, typename Located>
RunResult follow_by_default(const RunOptions& options, double own, Steps&& by_steps, Located&& located) {
  const auto stable = [&] { return with_stable_step(options.step, own, options.sample_spacing, by_steps); };
  if (!options.integrator.empty() || options.step > 0.0) return stable();
  std::optional<RunResult> first;
  double reached = 0.0;
  const char* why = "the motion blows up at its own step";
  try {
    first = by_steps(step_on_grid(own, options.sample_spacing));
    if (!first->damped_beyond_steps || first->interrupted) return *std::move(first);
    why = "a contact is damped faster than its own step follows";
    reached = first->end_time;
  } catch (const UnstableStep& step) {
    reached = step.t;
  } catch (const SingularPose& pose) {  // what a motion that blows up may meet on its way
    reached = pose.t;
  }
  RunOptions implicit = options;
  implicit.integrator = "rosenbrock";
  if (options.progress)  // which only grows
    implicit.progress = [&](RunProgress p) {
      p.t = std::max(p.t, reached);
      return options.progress(p);
    };
  try {
    RunResult followed = located(implicit);
    followed.integrator_taken = implicit.integrator;
    followed.warnings.insert(followed.warnings.begin(), std::string("rosenbrock took over from rk4: ") + why);
    return followed;
  } catch (const ComputationError&) {
  } catch (const std::invalid_argument&) {  // friction with a state of its own
  }
  return first ? *std::move(first) : stable();
}

}  // namespace boresight
