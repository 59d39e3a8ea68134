#include "boresight_analyses/fidelities/fidelity_study.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/runs/counted_cost.hpp"
#include "boresight_analyses/runs/model_samples.hpp"

namespace boresight {
namespace {

struct Level {
  std::string rung;
  std::unique_ptr<SampleStore> store;
  std::unique_ptr<SampleModel> model;
};

std::vector<Level> open_levels(const StudyRun& run, const MonteCarloPlan& plan) {
  std::vector<Level> levels;
  for (const std::string& rung : plan.fidelities->models) {
    Level& level = levels.emplace_back();
    level.rung = rung;
    level.store = run.open_samples("", plan.inputs.names(), store_of_rung(rung));
    level.model = run.model_on(rung, plan.inputs, *level.store);
  }
  return levels;
}

// Throws ComputationError.
FidelityPlan plan_of(const FidelityStudy& study, const MonteCarloPlan& plan) {
  try {
    const FewestSamples fewest = plan.requirement
                                     ? fewest_to_show(plan.requirement->probability, plan.requirement->confidence)
                                     : FewestSamples{};
    return plan_fidelities(study.pilot, plan.fidelities->budget, plan.design.seed, fewest);
  } catch (const std::invalid_argument& refusal) {
    std::string why = std::string("[montecarlo] fidelities: ") + refusal.what();
    if (study.failures.count > 0)
      why += "; " + std::to_string(study.failures.count) + " runs of the pilot failed; the first of them, sample " +
             std::to_string(study.failures.first) + ": " + study.failures.reason;
    throw ComputationError(why);
  }
}

}  // namespace

double FidelityStudy::measured_gain() const {
  const double variance = mean.standard_error * mean.standard_error;
  const double plain = plan.sd[0] * plan.sd[0] * measured_cost[0] / spent;
  return variance > 0.0 ? plain / variance : 0.0;
}

std::string store_of_rung(const std::string& rung) { return "samples-" + rung + ".db"; }

FidelityStudy run_fidelity_study(const StudyRun& run, const MonteCarloPlan& plan,
                                 const std::function<void(const FidelityPlan&)>& planned) {
  const FidelityQuestion& asked = *plan.fidelities;
  std::vector<Level> levels = open_levels(run, plan);
  const SamplingDesign design(plan.design, static_cast<int>(plan.inputs.size()));
  FidelityStudy study;
  study.leaves_out = levels.front().model->leaves_out();
  study.earlier = levels.front().store->earlier();

  const std::unique_ptr<Stage> stage = run.stage(asked.budget, "s of CPU");
  double spent = 0.0;
  std::string doing;
  const MethodOptions options{.jobs = run.options().jobs,
                              .progress =
                                  [&](double cpu) {
                                    spent += cpu;
                                    stage->update(std::min(spent, asked.budget), doing);
                                  },
                              .interrupted = run.options().interrupted};
  const auto samples_of = [&](const Level& level, const NumberRange& range) {
    complete_samples(*level.model, plan.inputs, design, range, *level.store, options);
    StoredValues stored = stored_values(*level.store, range);
    study.spent += stored.spent;
    study.failures.add(stored.failures);
    return stored;
  };
  std::function<IndependentInterval(const std::vector<double>&)> excess_of;  // of the first rung's values
  std::vector<std::vector<double>> values;
  std::vector<double> model_errors;  // of the first rung's
  try {
    for (const Level& level : levels) {
      doing = "pilot on " + level.rung;
      const StoredValues pilot = samples_of(level, {0, asked.pilot});
      study.pilot.values.push_back(pilot.values);
      study.measured_cost.push_back(std::max(pilot.typical_cost, 1e-7));
    }
    for (const Level& level : levels)
      study.pilot.cost.push_back(kept_counted_cost(*level.model, *run.mechanism(), plan.inputs, design, *level.store));
    stage->clear();
    study.plan = plan_of(study, plan);
    if (planned) planned(study.plan);
    for (std::size_t k = 0; k < study.plan.models.size(); ++k) {
      const Level& level = levels[static_cast<std::size_t>(study.plan.models[k])];
      doing = std::to_string(study.plan.samples[k]) + " samples on " + level.rung;
      StoredValues stored =
          samples_of(level, {asked.pilot, asked.pilot + static_cast<std::uint64_t>(study.plan.samples[k])});
      if (k == 0) {
        study.rung_error = stored.model;
        model_errors = std::move(stored.model_errors);
      }
      values.push_back(std::move(stored.values));
    }
    study.mean = estimate_fidelities(study.plan, values, plan.confidence);
    if (plan.requirement) {
      const ExcessPilot excess = excess_pilot(study.pilot, plan.requirement->limit);
      const FidelityPlan weighted = with_excess_weights(study.plan, study.pilot, excess, plan.requirement->limit);
      excess_of = [&values, &plan, excess, weighted](const std::vector<double>& first) {
        std::vector<std::vector<double>> of_all = values;
        of_all.front() = first;
        // Two sides at 2 c - 1 are one side at c each.
        return excess_bounds(weighted, excess_indicators(weighted, of_all, excess.limits),
                             2.0 * plan.requirement->confidence - 1.0);
      };
      study.excess = excess_of(values.front());
    }
  } catch (const MethodInterrupted&) {
    stage->clear();
    study.interrupted = true;
    return study;
  }
  stage->clear();
  RunOptions top = run.options().run;
  if (levels[0].model->step() > 0.0) top.step = levels[0].model->step();
  const ScatterStatistic statistic =
      plan.requirement ? ScatterStatistic{plan.requirement->probability} : ScatterStatistic{};
  study.steps = run.steps_of_scatter({.inputs = plan.inputs,
                                      .statistic = statistic,
                                      .runs = static_cast<std::uint64_t>(study.plan.samples[0]),
                                      .lanes = true},
                                     top, asked.models.front(), levels[0].store.get());
  study.interrupted = study.steps.interrupted;
  study.model_error = study.rung_error + (std::isfinite(study.steps.relative) ? study.steps.relative : 0.0);
  // The cheap rungs' values stay: whatever they are, the estimate is that of the first rung's.
  if (excess_of && study.model_error > 0.0)
    study.excess_within_error = excess_of(as_large_as_may_be(values.front(), model_errors, study.steps.relative));
  return study;
}

}  // namespace boresight
