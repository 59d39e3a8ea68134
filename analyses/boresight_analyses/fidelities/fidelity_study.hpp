// A study on several rungs: a pilot on every one, a forecast of the gain before anything more is spent, samples as the plan
// divides them, and the estimate that is unbiased for the first rung.
//
// Samples 0 to pilot - 1 are the pilot's, the estimate's follow. A store per rung keeps them, the first one also what a sample
// of each was counted at (counted_cost.hpp); the plan follows from the pilot's values and these alone. So a study that goes on
// has the plan it was begun with, and a repeated one has the same.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/fidelities/fidelity_estimate.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/runs/study_run.hpp"
#include "boresight_analyses/study/failures.hpp"

namespace boresight {

struct FidelityStudy {
  FidelityPilot pilot;
  FidelityPlan plan;
  FidelityEstimate mean;
  std::optional<IndependentInterval> excess;  // probability of exceeding the requirement's limit
  double rung_error = 0.0;   // what the first rung thinks it leaves out, relative: mean over its samples
  double model_error = 0.0;  // and its steps with it, where they were measured
  std::optional<IndependentInterval>
      excess_within_error;            // if each sample were larger by its own; none where that is nothing
  double spent = 0.0;                 // CPU seconds of all samples, measured
  std::vector<double> measured_cost;  // CPU seconds of a sample, per rung
  Failures failures;                  // on any rung
  StudySteps steps;
  SampleStore::Cost earlier;
  std::string leaves_out;  // the first rung
  bool interrupted = false;

  // Against the first rung alone for the same CPU: its sample variance over as many samples as that pays.
  double measured_gain() const;
};

// "samples-perturbation.db"
std::string store_of_rung(const std::string& rung);

// plan: with fidelities. planned: told of the plan before the budget is spent. Throws ComputationError where the pilot leaves
// nothing to plan with, OptionRefused, StoreRefused, StoreFailed.
FidelityStudy run_fidelity_study(const StudyRun& run, const MonteCarloPlan& plan,
                                 const std::function<void(const FidelityPlan&)>& planned);

}  // namespace boresight
