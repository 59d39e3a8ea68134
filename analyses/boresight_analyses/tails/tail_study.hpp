// A study of a rare excess: how likely the index exceeds the requirement's limit. Subset simulation finds the excess on the
// cheap rung, importance sampling measures it, the exact rung corrects it; forecast before it is spent. The budget is divided
// by counted costs (counted_cost.hpp), so the same study gives the same numbers again.
//
// Every point is kept as it is done, in a store per rung. Which point comes next hangs on the values of those before alone, so
// a study that goes on takes the way of the one before it, and computes what that one had not.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/runs/study_run.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "boresight_analyses/tails/two_level_pilot.hpp"

namespace boresight {

struct TailStudy {
  TwoLevelPlan pilot{.proposal = {{}, GaussianMixture(1), 0}};
  TailEstimate estimate;
  // Of the exact rung: what its steps do, what it thinks it leaves out (the mean over the estimate's points), and both together, relative.
  StudySteps steps = {};
  double rung_error = 0.0, model_error = 0.0;
  std::optional<TailEstimate> within_error = {};    // if each point were larger by its own; none where that is nothing
  TwoLevelCosts costs;                              // counted
  double cheap_seconds = 0.0, exact_seconds = 0.0;  // CPU of a sample, the median
  double search_seconds = 0.0, estimate_seconds = 0.0;  // CPU, measured
  Failures failures;                                    // of all points
  SampleStore::Cost earlier;
  std::string leaves_out;  // the exact rung
  bool interrupted = false;

  // At most this share may exceed the limit, and at most that much is shown to: of the points, and if each were larger by what rung and
  // steps may be off by.
  bool met(const Requirement& requirement) const;
  // Points on the exact rung that would show it, about; 0 where more of them would not.
  double points_to_show(const Requirement& requirement) const;
};

// "points-perturbation.db"
std::string store_of_tail(const std::string& rung);
// The stores of a tail study, one per rung: they are there while it is not whole.
std::vector<std::string> stores_of_tail(const TailQuestion& asked);

// plan: with a tail and a requirement. planned: told of the pilot before the budget is spent. Throws OptionRefused,
// StoreRefused, StoreFailed.
TailStudy run_tail_study(const StudyRun& run, const MonteCarloPlan& plan,
                         const std::function<void(const TwoLevelPlan&)>& planned);

}  // namespace boresight
