// Before the exact model is run in earnest: some points of both models around the tail tell how far the proposal must reach
// beyond what the cheap model calls the tail, how much of the cheap model to lean on, how many points to give to each, and
// what standard error to expect of that. A cheap model that costs no less than the exact one buys nothing: the tail is then looked for on the exact
// one, and the cheap one is left alone.
#pragma once

#include "boresight_analyses/tails/tail_estimate.hpp"
#include "boresight_analyses/tails/tail_proposal.hpp"

namespace boresight {

struct TwoLevelCosts {
  double cheap = 0.0, exact = 0.0;  // CPU seconds of one evaluation
};

struct TwoLevelPlan {
  TailProposal proposal;     // fitted to the model that was searched beyond `cheap_limit`
  bool on_exact = false;     // the exact model was searched: the cheap one costs no less
  double cheap_limit = 0.0;  // the limit, less what the exact model was seen to lie above the cheap one
  double control = 0.0;      // a of tail_estimate.hpp; 0: the exact model alone is the better buy
  std::int64_t cheap_points = 0, exact_points = 0;
  // Whether the pilot saw the exact model exceed the limit. Where it did not, it knows neither how the models agree nor
  // what to expect: the cheap one is then not leaned on, and the standard errors are not a number.
  bool informed = false;
  // Whether it saw enough to forecast by. Where a few of its points carry all of its weight, or it found much more or less of the tail than the search
  // did, the rest is what it has not seen: the standard errors are not a number then either.
  bool forecasts = false;
  double probability = 0.0;           // from the pilot alone, rough
  double standard_error = 0.0;        // to expect of the plan
  double exact_standard_error = 0.0;  // of as much CPU spent on the exact model alone, same proposal
  double plain_standard_error = 0.0;  // of as much CPU spent on plain Monte Carlo of the exact model
  std::int64_t cheap_evaluations = 0, exact_evaluations = 0;  // that the pilot has spent
};

// `budget`: CPU seconds left for the estimate after the pilot. The pilot's points are not used again, so that the estimate
// stays unbiased. Throws std::invalid_argument for costs or a budget that are not positive, or a pilot below ten points.
TwoLevelPlan two_level_pilot(const BatchModel& cheap, const BatchModel& exact, int dimensions, double limit,
                             std::int64_t pilot_points, const TwoLevelCosts& costs, double budget,
                             const ProposalOptions& options);

}  // namespace boresight
