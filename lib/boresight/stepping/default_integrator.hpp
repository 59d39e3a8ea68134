// Which integrator follows a motion where none is asked for: rk4 with its own step, and rosenbrock in its place where that step is no step for
// this motion: it blows up, or a contact is damped faster than it follows.
//
// Shorter steps of rk4 would go on from there as well, but what they make of such contacts is wrong by any amount until they follow them:
// with a planar loop of the gauntlet ten times, at a step that does not blow up, for two hundred times the cost of rosenbrock. Where rosenbrock
// cannot take over, steps are halved until that changes nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

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

// Whether two runs of one motion agree in every index to `share` of it.
inline bool indices_agree(const PointingIndices& a, const PointingIndices& b, double share) {
  constexpr double kRounding = 1e-12;  // [m or rad]
  for (const auto quantity :
       {&PointingIndices::position_error, &PointingIndices::orientation_error, &PointingIndices::boresight_error})
    for (const auto statistic : {&Statistics::max, &Statistics::rms})
      if (!(std::abs(a.*quantity.*statistic - b.*quantity.*statistic) <=
            kRounding + share * std::abs(b.*quantity.*statistic)))
        return false;
  return true;
}

// Goes on from `result` with steps halved until a contact's damping is followed and halving them once more changes no index.
template <typename Steps>
RunResult with_steps_that_agree(const RunOptions& options, RunResult result, Steps&& by_steps) {
  constexpr int kMostHalvings = 6;
  constexpr double kAgreed = 0.01;  // where errors are measured afterwards, on neighbouring steps
  if (result.cost.steps == 0) return result;
  double step = result.end_time / static_cast<double>(result.cost.steps);
  for (int halving = 1; halving <= kMostHalvings && !result.interrupted; ++halving) {
    step = step_on_grid(0.5 * step, options.sample_spacing);
    std::optional<RunResult> finer;
    try {
      finer = by_steps(options, step);
    } catch (const UnstableStep&) {  // near the largest stable step it is chance which run
      continue;
    } catch (const SingularPose&) {
      continue;
    }
    const bool agree = !finer->damped_beyond_steps && indices_agree(result.index, finer->index, kAgreed);
    result = *std::move(finer);
    if (!agree) continue;
    char text[160];
    std::snprintf(text, sizeof text, "steps were halved %d times, until that changed the indices by less than %g %%",
                  halving, 100.0 * kAgreed);
    result.warnings.insert(result.warnings.begin(), text);
    break;
  }
  return result;
}

// own: of rk4 [s]. by_steps(options, step): rk4. located(options): the integrator that the options name.
template <typename Steps, typename Located>
RunResult follow_by_default(const RunOptions& asked, double own, Steps&& by_steps, Located&& located) {
  double reached = 0.0;
  const RunOptions options = growing(asked, reached);
  const auto stable = [&] {
    return with_stable_step(options.step, own, options.sample_spacing,
                            [&](double step) { return by_steps(options, step); });
  };
  if (!options.integrator.empty() || options.step > 0.0) return stable();
  std::optional<RunResult> first;
  const char* why = "the motion blows up at its own step";
  try {
    first = by_steps(options, step_on_grid(own, options.sample_spacing));
    if (!first->damped_beyond_steps || first->interrupted) return *std::move(first);
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
  } catch (const std::invalid_argument&) {  // friction with a state of its own, which rk4 alone carries
    return with_steps_that_agree(options, first ? *std::move(first) : stable(), by_steps);
  }
  return first ? *std::move(first) : stable();
}

}  // namespace boresight
