#include "boresight_analyses/tails/tail_study.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "boresight_analyses/runs/counted_cost.hpp"
#include "boresight_analyses/runs/model_samples.hpp"

namespace boresight {
namespace {

// One of the two rungs.
struct Level {
  Level(const StudyRun& run, const std::string& rung, const RandomInputs& inputs)
      : store(run.open_samples("", inputs.names(), "points-" + rung + ".db")),
        model(run.model_on(rung, inputs, *store)) {}

  std::unique_ptr<SampleStore> store;
  std::unique_ptr<SampleModel> model;
  std::shared_ptr<std::vector<double>> seconds = std::make_shared<std::vector<double>>();
};

}  // namespace

bool TailStudy::met(const Requirement& requirement) const {
  return estimate.bounds.high <= 1.0 - requirement.probability;
}

double TailStudy::points_to_show(const Requirement& requirement) const {
  const double most = 1.0 - requirement.probability, found = estimate.probability.value;
  if (!(found < most)) return 0.0;
  // Where half of the capital is at stake on every point: see betting_mean.hpp.
  return std::log(2.0 / (1.0 - requirement.confidence)) * estimate.most_weight / (most - found);
}

std::vector<std::string> stores_of_tail(const TailQuestion& asked) {
  return {"points-" + asked.cheap + ".db", "points-" + asked.exact + ".db"};
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
  const BatchModel cheap =
      on_normal_space(*cheap_level.model, plan.inputs, options, cheap_level.seconds, cheap_level.store.get());
  const BatchModel exact =
      on_normal_space(*exact_level.model, plan.inputs, options, exact_level.seconds, exact_level.store.get());
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
    const TwoLevelPlan& pilot = study.pilot;
    study.estimate =
        pilot.control > 0.0
            ? two_level_importance_sampling(cheap, exact, requirement.limit, pilot.proposal.mixture, pilot.cheap_points,
                                            pilot.exact_points, pilot.control, tail)
            : importance_sampling(exact, requirement.limit, pilot.proposal.mixture, pilot.exact_points, tail);
  } catch (const MethodInterrupted&) {
    study.interrupted = true;
  }
  stage->clear();
  study.estimate_seconds = spent;
  study.cheap_seconds = median(*cheap_level.seconds);
  study.exact_seconds = median(*exact_level.seconds);
  return study;
}

}  // namespace boresight
