// A step too large for a contact: the error that says which contact, how fast it vibrates, and the largest step that holds.
#pragma once

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/stiffest_contact.hpp"

namespace boresight {

class UnstableStep : public ComputationError {
 public:
  // At t [s] with step h [s] of RK4.
  UnstableStep(const Mechanism& mechanism, const StiffestContact& contact, double t, double h);
  double largest_step = 0.0;  // that would have been stable there [s]
};

// The step that the paper uses, and the most that a rung takes on its own [s].
inline constexpr double kPaperStep = 1e-4;
// Share of RK4's stable step taken when a rung chooses: 2.785 x 0.36 = 1 radian of the stiffest contact a step, about three
// steps in a half wave of contact, and room for contacts that turn out twice as deep as foreseen.
inline constexpr double kShareOfStableStep = 0.36;

// Shortened so that whole steps make a sample spacing: samples then lie where they were asked for.
double step_on_grid(double step, double spacing);

// Runs integrate(step) with the caller's step, or with `own` shortened as often as a contact proves stiffer than foreseen.
template <typename Integrate>
auto with_stable_step(double asked, double own, double spacing, Integrate&& integrate) {
  if (asked > 0.0) return integrate(asked);
  double step = step_on_grid(own, spacing);
  for (bool shortened = false;; shortened = true) {
    try {
      auto result = integrate(step);
      if (shortened) result.warnings.insert(result.warnings.begin(), "the step was shortened: a contact was stiffer than foreseen");
      return result;
    } catch (const UnstableStep&) {
      // A motion that has begun to blow up has contacts far deeper than a stable one: what they ask for says too much.
      if (step < 1e-9) throw;
      step = step_on_grid(0.5 * step, spacing);
    }
  }
}

}  // namespace boresight
