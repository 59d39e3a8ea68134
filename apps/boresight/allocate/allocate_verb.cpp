// boresight allocate STUDY: fits or tolerances per joint at least cost that meet the pointing requirement.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "allocate/allocate_report.hpp"
#include "allocate/allocate_results.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/allocation/allocation_keys.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/study/design_model.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/scatter_parts.hpp"
#include "results/study_warnings.hpp"
#include "results/tables.hpp"
#include "results/verb_study.hpp"
#include "terminal/columns.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

constexpr std::size_t kInstants = 125;  // of the motion, that the linear deviation keeps

// All gaps at their middle, their least, their largest; errors likewise to one side, as in their middle nothing shows.
std::vector<std::vector<double>> corner_gaps(const AllocationPlan& plan) {
  std::vector<std::vector<double>> corners(3);
  for (const AllocationEntry& entry : plan.entries) {
    std::vector<DistributionPtr> zones;
    for (const AllocationOption& o : entry.options) zones.push_back(o.gap);
    if (entry.is_continuous())
      for (const double tolerance : {entry.curve.lower, entry.curve.upper})
        zones.push_back(entry.zone(tolerance, ZoneLaw::uniform));
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (const DistributionPtr& zone : zones) {
      const double at = entry.is_error || entry.is_continuous() ? zone->highest() : zone->mean();
      least = std::min(least, at);
      largest = std::max(largest, at);
    }
    corners[0].push_back(0.5 * (least + largest));
    corners[1].push_back(least);
    corners[2].push_back(largest);
  }
  return corners;
}

// Of the entries and, as far as it goes, of what scatters beside: the latter are named in the plan.
LinearDeviation linear_deviation(const std::shared_ptr<const Mechanism>& mechanism, AllocationPlan& plan,
                                 std::vector<double> probe, const IndexChoice& index, double& misfit) {
  std::vector<std::vector<ParameterPath>> places;
  for (const AllocationEntry& entry : plan.entries) places.push_back(entry.places);
  std::vector<bool> left_out(places.size(), false);
  std::vector<std::size_t> inputs;
  for (const std::size_t i : plan.inputs_to_be_linear_in()) {
    const RandomParameter& p = plan.inputs->parameters[i];
    // Errors to one side, as entries are: in their middle nothing may show.
    constexpr double kAside = 0.975;
    const bool is_error = p.paths.front().starts_with("error.");
    const double at = is_error ? p.distribution->quantile(kAside) : p.distribution->mean();
    if (!is_error && !(at > 0.0)) continue;
    inputs.push_back(i);
    places.push_back(p.places);
    left_out.push_back(true);
    probe.push_back(at);
  }
  const LinearDeviation all = find_linear_deviation(mechanism, places, probe, index, kInstants, misfit, &left_out);
  std::vector<std::size_t> kept;
  for (std::size_t j = 0; j < places.size(); ++j) {
    if (left_out[j]) continue;
    kept.push_back(j);
    if (j >= plan.entries.size()) plan.linear_inputs.push_back(inputs[j - plan.entries.size()]);
  }
  return all.of_only(kept);
}

// How many entries there are, and of what: "1 joint", "2 errors", "3 joints and errors".
std::string entries_text(const AllocationPlan& plan) {
  const std::size_t count = plan.entries.size();
  const auto errors = static_cast<std::size_t>(
      std::count_if(plan.entries.begin(), plan.entries.end(), [](const auto& e) { return e.is_error; }));
  if (errors == 0 || errors == count) return how_many(count, errors == 0 ? "joint" : "error");
  return fmt::format("{} joints and errors", count);
}

// The confirming rung's outcomes, each sample stored as it lands and never computed twice.
class Confirming {
 public:
  Confirming(const SampleModel& model, const AllocationPlan& plan, EvaluationStore& store, int jobs)
      : model_(model), plan_(plan), store_(store), jobs_(jobs) {}

  std::vector<Outcome> operator()(const std::vector<std::vector<double>>& gaps,
                                  const std::vector<std::vector<double>>& others) {
    std::vector<std::vector<double>> values = gaps, open;
    std::vector<std::size_t> open_at;
    std::vector<Outcome> outcomes(gaps.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (plan_.inputs) {
        std::vector<double> point = others[k];
        plan_.inputs->values(point);
        values[k].insert(values[k].end(), point.begin(), point.end());
      }
      if (const auto* known = store_.find(values[k], 1)) {
        outcomes[k] = known->front();
        ++reused;
        continue;
      }
      open.push_back(values[k]);
      open_at.push_back(k);
    }
    const std::vector<Outcome> computed_now = evaluate_all(model_, open,
                                                           {.jobs = jobs_,
                                                            .interrupted = [] { return interrupted(); },
                                                            .landed =
                                                                [&](std::size_t k, const Outcome& outcome) {
                                                                  ++computed;
                                                                  store_.add(open[k], {outcome});
                                                                }});
    for (std::size_t k = 0; k < open.size(); ++k) outcomes[open_at[k]] = computed_now[k];
    for (const Outcome& outcome : outcomes) failures.see(runs++, outcome);
    return outcomes;
  }

  std::int64_t computed = 0, reused = 0;
  Failures failures;  // of all outcomes handed over, in that order
  std::uint64_t runs = 0;

 private:
  const SampleModel& model_;
  const AllocationPlan& plan_;
  EvaluationStore& store_;
  int jobs_;
};

class AllocateVerb : public Verb {
 public:
  std::string name() const override { return "allocate"; }
  std::string file_kind() const override { return "study"; }
  const KeyTable* study_table() const override { return &allocate_keys(); }
  std::string summary() const override {
    return "fits or tolerances per joint at least cost that meet the requirement";
  }
  std::string example() const override { return "boresight allocate antenna/allocate.toml"; }
  std::string next(const Command&, bool answer_is_no) const override {
    return answer_is_no ? "a wider limit or finer fits in the study, then the same command"
                        : std::string("boresight help budget: the pointing budget with these fits");
  }
  void declare_options(CLI::App& app) override { motion_.declare_model(app); }

  int execute(const Command& command) override {
    const Stopwatch watch;
    StudyInput input(command.file, command.settings);
    const Study& study = input.study;
    const std::shared_ptr<const Mechanism>& mechanism = input.mechanism;
    AllocationPlan plan = read_allocation_plan(input.root, study, mechanism->description(), input.trial);
    check_rung_name(command.rung);
    RungChoice choice = rung_for(command, *mechanism);
    // The search itself is linear; what is followed confirms it.
    const RunOptions asked = motion_.run_options(*mechanism, choice.name);
    const VerbStudy own(command, mechanism, study.index, study.accuracy, asked,
                        identity_of_study(command, *mechanism, plan.sample_text(study), motion_.identity()));
    const OutputDirectory& out = own.out();

    const std::vector<std::vector<double>> gaps = corner_gaps(plan);
    double misfit = 0.0;
    const LinearDeviation deviation = linear_deviation(mechanism, plan, gaps[0], study.index, misfit);

    std::vector<Parameters> corners;
    for (std::vector<double> values : gaps) {
      if (plan.inputs)
        for (const RandomParameter& p : plan.inputs->parameters) values.push_back(p.distribution->quantile(0.5));
      corners.push_back(plan.parameters_with(*mechanism, values));
    }
    const double accuracy = own.run().options().accuracy.value_or(0.05);
    const DesignModel designs = design_model(choice, {.mechanism = mechanism,
                                                      .parameters_of =
                                                          [mechanism, &plan](std::span<const double> values) {
                                                            return plan.parameters_with(*mechanism, values);
                                                          },
                                                      .index = study.index,
                                                      .run = asked,
                                                      .corners = corners,
                                                      .scene_varies = plan.inputs && scene_varies(*plan.inputs),
                                                      .accuracy = accuracy});
    const SampleModel& model = *designs.samples;
    std::vector<std::string> names;
    for (const AllocationEntry& joint : plan.entries) names.push_back(joint.name());
    if (plan.inputs)
      for (const RandomParameter& p : plan.inputs->parameters) names.push_back(p.name());
    const auto store =
        own.run().open_evaluations("confirmation.db", names, model.rung(), model.step(),
                                   fmt::format("{}, accuracy {:g}", model.batch() > 1 ? "lanes" : "runs", accuracy));
    Confirming confirming(model, plan, *store, command.jobs);

    if (!command.quiet) {
      tell("{}: {}, {}\n", mechanism->name(), entries_text(plan),
           plan.is_continuous() ? "cost curves"
           : plan.has_curves()  ? "prices and cost curves"
                                : "fits with prices");
      std::fflush(stdout);
    }
    const std::unique_ptr<Stage> stage = own.run().stage(1.0, "of the allocation");
    AllocationResult result =
        run_allocation(plan, deviation, misfit, std::ref(confirming), choice.name,
                       {.accuracy = accuracy,
                        .interrupted = [] { return interrupted(); },
                        .progress = [&](const std::string& of, double share) { stage->update(share, of); }});
    stage->clear();
    result.evaluations = confirming.computed;
    result.reused = confirming.reused;
    AllocateStudy allocated{.command = command,
                            .study = study,
                            .mechanism = *mechanism,
                            .rung = choice,
                            .plan = plan,
                            .result = result,
                            .warnings = {},
                            .leaves_out = model.leaves_out()};
    allocated.warnings = warnings_of(allocated);
    if (confirming.failures.count > 0)
      allocated.warnings.push_back(
          fmt::format("{} of {} confirming runs failed", confirming.failures.count, confirming.runs) +
          first_failure_text(confirming.failures, "run"));
    for (const std::string& one : study_warnings(*mechanism, choice.name)) allocated.warnings.push_back(one);
    if (!store->damage().empty()) allocated.warnings.push_back(store->damage());
    Json summary = allocate_summary(allocated, own, watch, store->earlier());
    add_first_failure(summary, confirming.failures, "run");
    write_json(out, "summary.json", summary);
    out.write("allocation.csv", [&](std::ostream& s) { write_allocation(s, allocated); });
    write_report(out, allocate_report(allocated));
    out.publish();
    if (!command.quiet) print(allocated, out);
    if (result.interrupted) return kInterrupted;
    return result.feasible ? kDone : kAnswerIsNo;
  }

 private:
  static RungChoice rung_for(const Command& command, const Mechanism& mechanism) {
    if (command.rung == "perturbation" || command.rung == "multibody")
      return {.name = command.rung, .why = "asked for by name; confirms what the linear deviation at rest finds"};
    return {.name = next_rung_up("quasistatic", mechanism),
            .why =
                "the next rung above the quasistatic one, whose linear deviation the search uses; it "
                "confirms the choice"};
  }

  static std::vector<std::string> warnings_of(const AllocateStudy& s) {
    std::vector<std::string> warnings;
    const AllocationResult& r = s.result;
    // Of the quasistatic rung that would not be so: the search is on it.
    if (s.command.rung == "envelope")
      warnings.push_back("--rung " + s.command.rung + " is not used: the search is on the quasistatic rung, and " +
                         s.rung.name + " confirms what it finds");
    if (r.feasible && !r.chosen.finished)
      warnings.push_back("the search ended before it had shown that nothing cheaper meets the requirement");
    const std::size_t told = r.feasible ? r.confirmations.size() - 1 : r.confirmed_by;  // beside the answer
    for (std::size_t k = 0; k < r.confirmations.size(); ++k)
      if (k != told)
        warnings.push_back("round " + std::to_string(k + 1) +
                           " of the confirmation disagreed with the search: " + r.confirmations[k].sentence);
    if (r.misfit > kMostMisfit)
      warnings.push_back(fmt::format("the error is not linear in the gaps: off by {} against the quasistatic rung",
                                     relative_text(r.misfit)));
    for (const Allocation* a : {&r.worst_case, &r.root_sum_square})
      if (r.feasible && a->feasible && !a->meets)
        warnings.push_back("the " + a->judged_by + " allocation is " + standing_of(s, *a));
    return warnings;
  }

  static void print(const AllocateStudy& s, const OutputDirectory& out) {
    tell("{}\n", allocate_sentence(s));
    constexpr std::size_t kName = 24, kOption = 12;  // at least
    const std::size_t names = widest_of(s.result.shares, [](const AllocationShare& share) { return share.joint; });
    std::size_t options = kOption;
    for (std::size_t j = 0; j < s.result.shares.size(); ++j)
      options = std::max(options, columns_in(option_text(s, s.result.chosen, j)));
    for (std::size_t j = 0; j < s.result.shares.size(); ++j) {
      const AllocationShare& share = s.result.shares[j];
      tell("  {} {} price {:<6.4g} {:>5.1f} % of the cost, {:>5.1f} % of the error\n",
           padded(share.joint, std::max(kName, names)), padded(option_text(s, s.result.chosen, j), options),
           share.price, 100.0 * share.cost_share, 100.0 * share.error_share);
    }
    for (const Allocation* a : {&s.result.worst_case, &s.result.root_sum_square})
      if (!a->judged_by.empty())
        tell("  {}: {}{}\n", a->judged_by, a->feasible ? fmt::format("{:.5g}, ", a->price) : "", standing_of(s, *a));
    if (s.result.feasible && std::isfinite(s.result.last_micrometre)) tell("  {}\n", last_micro_sentence(s));
    tell_warnings(s.warnings, s.command, s.mechanism);
    tell("  report: {}\n", (out.path() / "report.html").string());
  }

  MotionOptions motion_;
};

}  // namespace

std::unique_ptr<Verb> make_allocate_verb() { return std::make_unique<AllocateVerb>(); }

}  // namespace boresight::app
