// Subset simulation (Au, Beck 2001, Probabilistic Engineering Mechanics 16): a rare excess as a product of frequent ones.
//
//   P(y > limit) = P(y > y_1) P(y > y_2 | y > y_1) ...        y_i: the (1 - level) quantile of the level before
//
// The samples of a level are chains started from those of the level before; a step draws u' = r u + sqrt(1 - r^2) z and
// keeps it where it stays beyond y_i (Papaioannou, Betz, Zwirglmaier, Straub 2015, section 4: the limit of Au and Beck's
// component-wise step, and as good in many dimensions). A point whose value is not finite counts as beyond every limit.
//
// The estimate has a bias of the order of 1 / samples. It finds the tail; tail_estimate.hpp then measures it without bias.
#pragma once

#include <cstdint>
#include <vector>

#include "boresight_analyses/statistics/batch_model.hpp"

namespace boresight {

struct SubsetOptions {
  int samples = 1000;        // per level
  double level = 0.1;        // conditional probability of a level; 1 / level must be a whole number
  double correlation = 0.8;  // r of a step
  int most_levels = 20;      // stops a limit that cannot be reached
  std::uint64_t seed = 1;
};

struct SubsetLevel {
  double threshold = 0.0;                 // y_i, or the limit
  double probability = 0.0;               // of exceeding it, given the level before
  double coefficient_of_variation = 0.0;  // Au and Beck, Eq. 28: chains' correlation included
};

struct SubsetResult {
  double probability = 0.0;
  double coefficient_of_variation = 0.0;  // levels taken as independent (Au and Beck, Eq. 30, lower bound)
  std::vector<SubsetLevel> levels;
  Points beyond;         // points of the last level beyond the limit, standard normal space
  bool reached = false;  // false: the limit lies beyond `most_levels`, or y does not change any more
  std::int64_t evaluations = 0, failed = 0;
};

// `model` takes points of the standard normal space of `dimensions`. Throws std::invalid_argument for options out of range.
SubsetResult subset_simulation(const BatchModel& model, int dimensions, double limit, const SubsetOptions& options);

}  // namespace boresight
