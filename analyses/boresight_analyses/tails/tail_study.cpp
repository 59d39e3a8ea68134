#include "boresight_analyses/tails/tail_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "boresight_analyses/runs/counted_cost.hpp"
#include "boresight_analyses/runs/model_samples.hpp"

namespace boresight {
namespace {

// One of the two rungs.
struct Level {
  Level(const StudyRun& run, const std::string& rung, const RandomInputs& inputs)
      : store(run.open_samples("", inputs.names(), store_of_tail(rung))), model(run.model_on(rung, inputs, *store)) {}

  std::unique_ptr<SampleStore> store;
  std::unique_ptr<SampleModel> model;
  std::shared_ptr<std::vector<double>> seconds = std::make_shared<std::vector<double>>();
};

// What a model answered, in the order in which it was asked.
struct Answers {
  std::vector<double> values, model_errors;

  void add(const Outcome& outcome) {
    const bool done = outcome.status == Outcome::Status::done;
    values.push_back(done ? outcome.value : std::numeric_limits<double>::quiet_NaN());
    model_errors.push_back(done ? outcome.model_error : 0.0);
  }
  void clear() {
    values.clear();
    model_errors.clear();
  }
};

// Gives these values to whatever points it is asked for: a method that is begun again asks for the same.
BatchModel once_more(std::vector<double> values) {
  return [values = std::move(values), at = std::size_t{0}](const Points& points) mutable {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(at);
    at += points.size();
    return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(points.size()));
  };
}

double mean_of_done(const Answers& answers) {
  double sum = 0.0, done = 0.0;
  for (std::size_t k = 0; k < answers.values.size(); ++k) {
    if (!std::isfinite(answers.values[k])) continue;
    sum += answers.model_errors[k];
    done += 1.0;
  }
  return done > 0.0 ? sum / done : 0.0;
}

}  // namespace

bool TailStudy::met(const Requirement& requirement) const {
  const double most = 1.0 - requirement.probability;
  return estimate.bounds.high <= most && (!within_error || within_error->bounds.high <= most);
}

double TailStudy::points_to_show(const Requirement& requirement) const {
  const double most = 1.0 - requirement.probability, found = estimate.probability.value;
  if (!(found < most)) return 0.0;
  // Where half of the capital is at stake on every point: see betting_mean.hpp.
  return std::log(2.0 / (1.0 - requirement.confidence)) * estimate.most_weight / (most - found);
}

std::string store_of_tail(const std::string& rung) { return "points-" + rung + ".db"; }

std::vector<std::string> stores_of_tail(const TailQuestion& asked) {
  return {store_of_tail(asked.cheap), store_of_tail(asked.exact)};
}

TailStudy run_tail_study(const StudyRun& run, const MonteCarloPlan& plan,
                         const std::function<void(const TwoLevelPlan&)>& planned) {
  const TailQuestion& asked = *plan.tail;
  const Requirement& requirement = *plan.requirement;
  const int dimensions = static_cast<int>(plan.inputs.size());
  const Level cheap_level(run, asked.cheap, plan.inputs), exact_level(run, asked.exact, plan.inputs);
  TailStudy study;
  study.leaves_out = exact_level.model->leaves_out();
  study.earlier = exact_level.store->earlier();

  ProposalOptions proposal;
  proposal.subset.seed = plan.design.seed;
  // The search is no part of the budget, and how long it takes hangs on how rare the excess turns out to be: as rare as is required to begin
  // with, and twice as long wherever that is over.
  const double levels = std::ceil(std::log(1.0 - requirement.probability) / std::log(proposal.subset.level));
  double points = std::max(levels, 1.0) * proposal.subset.samples + static_cast<double>(asked.pilot);
  std::unique_ptr<Stage> stage = run.stage(points, "points, about");
  double spent = 0.0, found = 0.0, before = 0.0;
  bool searching = true;
  const MethodOptions options{.jobs = run.options().jobs,
                              .progress =
                                  [&](double cpu) {
                                    spent += cpu;
                                    if (!searching) {
                                      stage->update(std::min(spent, asked.budget), "measuring it");
                                      return;
                                    }
                                    if (++found > points) {
                                      before = points;
                                      points *= 2.0;
                                      stage = run.stage(points, "points, about");
                                    }
                                    stage->update(before, found, "finding the excess");
                                  },
                              .interrupted = run.options().interrupted,
                              .failed =
                                  [&](std::uint64_t, const Outcome& outcome) {
                                    // In the order in which they fail: the first that is told of is the one to tell.
                                    study.failures.see(study.failures.count, outcome);
                                  }};
  Answers of_cheap, of_exact;
  const auto keeping = [&](Answers& answers) {
    MethodOptions keeps = options;
    keeps.answered = [&answers](const Outcome& outcome) { answers.add(outcome); };
    return keeps;
  };
  const BatchModel cheap =
      on_normal_space(*cheap_level.model, plan.inputs, keeping(of_cheap), cheap_level.seconds, cheap_level.store.get());
  const BatchModel exact =
      on_normal_space(*exact_level.model, plan.inputs, keeping(of_exact), exact_level.seconds, exact_level.store.get());
  std::function<TailEstimate(const BatchModel&, const BatchModel&)> estimated;
  try {
    const SamplingDesign design(plan.design, dimensions);
    const auto cost_of = [&](const Level& level) {
      return kept_counted_cost(*level.model, *run.mechanism(), plan.inputs, design, *level.store);
    };
    study.costs.cheap = cost_of(cheap_level);
    study.costs.exact = cost_of(exact_level);
    study.pilot = two_level_pilot(cheap, exact, dimensions, requirement.limit, static_cast<std::int64_t>(asked.pilot),
                                  study.costs, asked.budget, proposal);
    study.search_seconds = spent;
    stage->clear();
    if (planned) planned(study.pilot);
    spent = 0.0;
    searching = false;
    stage = run.stage(asked.budget, "s of CPU");
    const TailOptions tail{.confidence = 2.0 * requirement.confidence - 1.0, .seed = plan.design.seed};
    estimated = [&, tail](const BatchModel& on_cheap, const BatchModel& on_exact) {
      const TwoLevelPlan& pilot = study.pilot;
      return pilot.control > 0.0
                 ? two_level_importance_sampling(on_cheap, on_exact, requirement.limit, pilot.proposal.mixture,
                                                 pilot.cheap_points, pilot.exact_points, pilot.control, tail)
                 : importance_sampling(on_exact, requirement.limit, pilot.proposal.mixture, pilot.exact_points, tail);
    };
    of_cheap.clear();
    of_exact.clear();
    study.estimate = estimated(cheap, exact);
  } catch (const MethodInterrupted&) {
    study.interrupted = true;
  }
  stage->clear();
  study.estimate_seconds = spent;
  study.cheap_seconds = median(*cheap_level.seconds);
  study.exact_seconds = median(*exact_level.seconds);
  if (study.interrupted) return study;
  RunOptions top = run.options().run;
  if (exact_level.model->step() > 0.0) top.step = exact_level.model->step();
  study.steps = run.steps_of_scatter({.inputs = plan.inputs,
                                      .statistic = {requirement.probability},
                                      .runs = static_cast<std::uint64_t>(study.estimate.exact_evaluations),
                                      .lanes = exact_level.model->batch() > 1},
                                     top, asked.exact, exact_level.store.get());
  study.interrupted = study.steps.interrupted;
  study.rung_error = mean_of_done(of_exact);
  study.model_error = study.rung_error + (std::isfinite(study.steps.relative) ? study.steps.relative : 0.0);
  if (study.model_error > 0.0)
    study.within_error =
        estimated(once_more(of_cheap.values),
                  once_more(as_large_as_may_be(of_exact.values, of_exact.model_errors, study.steps.relative)));
  return study;
}

}  // namespace boresight
