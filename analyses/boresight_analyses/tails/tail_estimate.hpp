// The probability that a result exceeds a limit, measured without bias by importance sampling: points are drawn where the
// excess lies, and each counts by how much less likely the standard normal space has it there.
//
//   P = E_q[w 1(y > limit)],   w = phi / q                        q: a mixture fitted to what subset simulation found
//
// Two models (Peherstorfer, Cui, Marzouk, Willcox 2016): many points of the cheap one, few of both,
//
//   P_exact = a E_q[w 1_cheap] + E_q[w (1_exact - a 1_cheap)]
//
// The second term takes out whatever the cheap model gets wrong: for any a fixed beforehand the sum is unbiased for the
// exact one, however poor the cheap one is; a poor one costs interval width, and the pilot (two_level_pilot.hpp) an a near 0.
//
// Two intervals. That of the central limit is what to expect of the estimate, and is too narrow where few points or few large
// weights make it up: a region that no point has met leaves no trace in their scatter. q keeps a share of the standard
// normal, so no weight exceeds W = 1 / share, and `bounds` hold wherever the excess lies: Clopper and Pearson's where all
// weights are 1, else by betting on w 1 / W of the exact points (betting_mean.hpp). What is claimed rests on them.
#pragma once

#include <cmath>
#include <cstdint>

#include "boresight_analyses/statistics/interval.hpp"
#include "boresight_analyses/tails/gaussian_mixture.hpp"

namespace boresight {

struct TailOptions {
  double confidence = 0.95;
  std::uint64_t seed = 1;
  std::uint64_t stream = 0;  // different numbers draw different points
};

struct TailEstimate {
  IndependentInterval probability;  // central limit; the ends are kept in [0, 1], the unbiased value is not
  IndependentInterval bounds;       // whatever the excess: each end errs with a chance of at most (1 - confidence) / 2
  double most_weight = 1.0;         // W of them
  double standard_error = 0.0;
  std::int64_t exceedances = 0;        // points of the (exact) model beyond the limit
  double effective_exceedances = 0.0;  // (sum of their weights)^2 / sum of squares: small: do not trust the interval
  std::int64_t disagreements = 0;  // points on which the two models disagree: none or few leave their scatter unknown
  std::int64_t cheap_evaluations = 0, exact_evaluations = 0, failed = 0;
};

// Whether a point counts as beyond the limit: one that fails (a value that is not finite) does.
inline bool is_beyond(double value, double limit) { return !std::isfinite(value) || value > limit; }

// Both throw std::invalid_argument for less than two points.
TailEstimate importance_sampling(const BatchModel& model, double limit, const GaussianMixture& proposal,
                                 std::int64_t points, const TailOptions& options);
// `exact_points` of both models, and `cheap_points` further ones of the cheap one alone. `control` is a above.
TailEstimate two_level_importance_sampling(const BatchModel& cheap, const BatchModel& exact, double limit,
                                           const GaussianMixture& proposal, std::int64_t cheap_points,
                                           std::int64_t exact_points, double control, const TailOptions& options);

}  // namespace boresight
