// A step too large for the motion: the error that says so, and what a rung does about it where the step was its own choice.
#pragma once

#include <algorithm>
#include <cmath>

#include "boresight/contact_events/stiffest_contact.hpp"
#include "boresight/formulations/singular_pose.hpp"

namespace boresight {

class UnstableStep : public ComputationError {
 public:
  // A contact that vibrates too fast for RK4 with step h [s], at t [s].
  UnstableStep(const Mechanism& mechanism, const StiffestContact& contact, double t, double h);
  // The motion blew up with step h: seen at t, as `sign` says ("the state is not finite").
  UnstableStep(const std::string& sign, double t, double h);
  // The same, where springs and dampers alone ask for a step of at most `of_springs` [s].
  UnstableStep(const UnstableStep& blown_up, double of_springs, double h);
  double t = 0.0;             // [s]
  double largest_step = 0.0;  // that would have been stable there [s]; 0: not known
};

// The error control found no step short enough to go on with, or a given step's equations were not solved.
class StepFailed : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

// The step that the paper uses [s], and the most that a rung takes on its own.
inline constexpr double kPaperStep = 1e-4;
inline double longest_step(double duration) { return std::min(kPaperStep, duration / 100.0); }
// Share of RK4's stable step taken when a rung chooses: 2.785 x 0.36 = 1 radian of the stiffest contact a step, about three
// steps in a half wave of contact, and room for contacts that turn out twice as deep as foreseen.
inline constexpr double kShareOfStableStep = 0.36;

// Shortened so that whole steps make a sample spacing (0: no samples): samples then lie where they were asked for.
double step_on_grid(double step, double spacing);

// Runs integrate(step) with the caller's step, or with `own` shortened as often as it proves too large. A motion that blows up
// can meet any pose on its way, so a singular one is believed only where shorter steps meet it too, at the same time.
template <typename Integrate>
auto with_stable_step(double asked, double own, double spacing, Integrate&& integrate) {
  if (asked > 0.0) return integrate(asked);
  constexpr double kSmallestShare = 1e-5, kSameTime = 0.01;
  constexpr int kAlike = 2;
  double step = step_on_grid(own, spacing), singular_before = -1.0;
  int alike = 0;
  for (bool shortened = false;; shortened = true) {
    try {
      auto result = integrate(step);
      if (shortened)
        result.warnings.insert(result.warnings.begin(),
                               "the step was shortened: the one chosen first was too large for this motion");
      return result;
    } catch (const UnstableStep&) {
      // A motion that has begun to blow up has contacts far deeper than a stable one: what they ask for says too much.
      if (step < kSmallestShare * own) throw;
    } catch (const SingularPose& pose) {
      alike = std::abs(pose.t - singular_before) <= kSameTime * pose.t ? alike + 1 : 0;
      if (alike == kAlike || step < kSmallestShare * own) throw;
      singular_before = pose.t;
    }
    step = step_on_grid(0.5 * step, spacing);
  }
}

}  // namespace boresight
