// Which integrator follows a motion where none is asked for: rk4 with its own step, and rosenbrock in its place where that step is no step for
// this motion: it blows up, or a contact is damped faster than it follows.
//
// Shorter steps of rk4 would go on from there as well, but what they make of such contacts is wrong by any amount until they follow them:
// with a planar loop of the gauntlet ten times, at a step that does not blow up, for two hundred times the cost of rosenbrock.
#pragma once

#include <algorithm>
#include <string>

#include "boresight/formulations/singular_pose.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/rung.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {

// The options with progress that only grows, over all attempts at one motion.
inline RunOptions growing(RunOptions options, double& reached) {
  if (options.progress)
    options.progress = [&reached, tell = options.progress](RunProgress p) {
      p.t = reached = std::max(p.t, reached);
      return tell(p);
    };
  return options;
}

// What steps do from when it is sure that a contact is damped faster than they follow: go on to the end of the motion, or end there, as the
// motion is followed anew and nothing of it is kept.
enum class WhereDampedBeyond { goes_on, ends };

// own: of rk4 [s]. by_steps(options, step, where_beyond): rk4. located(options): the integrator that the options name.
template <typename Steps, typename Located>
RunResult follow_by_default(const RunOptions& asked, double own, Steps&& by_steps, Located&& located) {
  double reached = 0.0;
  const RunOptions options = growing(asked, reached);
  const auto stable = [&] {
    return with_stable_step(options.step, own, options.sample_spacing,
                            [&](double step) { return by_steps(options, step, WhereDampedBeyond::goes_on); });
  };
  if (!options.integrator.empty() || options.step > 0.0) return stable();
  const char* why = "the motion blows up at its own step";
  try {
    RunResult first = by_steps(options, step_on_grid(own, options.sample_spacing), WhereDampedBeyond::ends);
    if (!first.damped_beyond_steps || first.interrupted) return first;
    why = "a contact is damped faster than its own step follows";
  } catch (const UnstableStep&) {
  } catch (const SingularPose&) {  // what a motion that blows up may meet on its way
  }
  RunOptions implicit = options;
  implicit.integrator = "rosenbrock";
  try {
    RunResult followed = located(implicit);
    followed.integrator_taken = implicit.integrator;
    followed.warnings.insert(followed.warnings.begin(), std::string("rosenbrock took over from rk4: ") + why);
    return followed;
  } catch (const ComputationError&) {
  }
  return stable();
}

}  // namespace boresight
