// boresight budget STUDY: the pointing budget, from simulated histories and by the classical table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight_analyses/budget/budget_keys.hpp"
#include "boresight_analyses/budget/follow_errors.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/runs/stored_runs.hpp"
#include "budget/budget_parts.hpp"
#include "budget/budget_report.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "report_parts/report_parts.hpp"
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

struct RunsSeen {
  Failures failures;
  double largest = 0.0;  // of the quantity over every step of the members' runs
  double missed = 0.0;   // the largest share of a run's maximum that its sampled history has not; 0 if it begins late
  double model_error = 0.0;  // mean
};

RunsSeen runs_seen(const SampleStore& store, const BudgetRuns& runs, const BudgetPlan& plan, double rounding) {
  RunsSeen seen;
  double done = 0.0;
  store.read(runs.drawn(runs.rows()), [&](const SampleRecord& r) {
    seen.failures.see(r.number, r.outcome);
    if (r.outcome.status == Outcome::Status::failed) return;
    done += 1.0;
    seen.model_error += r.outcome.model_error;
    seen.largest = std::max(seen.largest, r.outcome.value);
    if (plan.start > 0.0 || r.outcome.value < rounding) return;
    double sampled = 0.0;
    for (const Vec3& e : sampled_history(store, r.number, plan).error) sampled = std::max(sampled, e.norm());
    seen.missed = std::max(seen.missed, 1.0 - sampled / r.outcome.value);
  });
  seen.model_error /= std::max(1.0, done);
  return seen;
}

// Where the members are too few for an upper end, the gain may be any more.
std::string gain_text(const BudgetStudy& s, const ErrorReduction& r) {
  if (!std::isfinite(r.interval.low)) return "";
  const std::string low = (r.gain() < 0.0 ? "takes off " : "") + budget_value(s, r.interval.low);
  return std::isfinite(r.interval.high)
             ? fmt::format(" ({} to {})", low, budget_value(s, r.interval.high))
             : fmt::format(" ({} at least; {} members are too few to say at most)", low, r.members);
}

class BudgetVerb : public Verb {
 public:
  std::string name() const override { return "budget"; }
  std::string file_kind() const override { return "study"; }
  const KeyTable* study_table() const override { return &budget_keys(); }
  std::string summary() const override { return "pointing budget: APE, MPE, RPE, PDE, PRE; ensemble, temporal, mixed"; }
  std::string example() const override { return "boresight budget antenna/budget.toml"; }
  std::string next(const Command&, bool answer_is_no) const override {
    return answer_is_no
               ? "tighten what takes off most, or raise members, then the same command: known runs are not repeated"
               : std::string(
                     "other requirements or windows need no new runs: change the study, give the command again");
  }
  void declare_options(CLI::App& app) override {
    motion_.declare_model(app);
    resumption_.declare(app);
  }

  int execute(const Command& command) override {
    const Stopwatch watch;
    StudyInput input(command.file, command.settings);
    const Study& study = input.study;
    const std::shared_ptr<const Mechanism>& mechanism = input.mechanism;
    BudgetPlan plan = read_budget_plan(input.root, study, mechanism->description(), mechanism->duration(), input.trial);
    check_rung_name(command.rung);
    RunOptions run = motion_.run_options(*mechanism, command.rung);
    const std::vector<std::string> untold = follow_errors(plan, *mechanism, study.index.kind());

    const std::string text = plan.sample_text(study);
    nlohmann::json options = motion_.model_identity();
    if (study.accuracy) options["study_accuracy"] = *study.accuracy;
    const VerbStudy own(command, mechanism, study.index, study.accuracy, run,
                        identity_of_study(command, *mechanism, text, options));
    const std::unique_ptr<SampleStore> opened = own.open_samples(text, plan.inputs.names(), resumption_);
    SampleStore& store = *opened;
    const BudgetRuns runs(plan, *mechanism);
    // Levels of a budget are quantiles over the members.
    RungChoice choice = own.run().rung_of_scatter(
        {.inputs = plan.inputs, .statistic = {0.95}, .runs = runs.count(), .integrators = true}, store);
    // Rungs that follow what deviates have nothing to follow.
    if (mechanism->clearances() == 0 && plan.inputs.size() == 0 && !has_errors(mechanism->parameters()))
      choice = {.name = "multibody",
                .why = "the mechanism itself deviates by nothing: the budget is that of its contributors, on any rung"};
    apply(choice, run);
    const bool takes_steps = !integrator_names(choice.name).empty();
    if (takes_steps && run.step == 0.0 && (run.integrator.empty() || run.integrator == "rk4"))
      run.step = own.run().common_step_of_scatter(choice.name, plan.inputs, run, store);
    run = options_on(choice.name, mechanism, pilot_samples(plan.inputs, *mechanism), run);
    const BudgetModel model(choice.name, mechanism, plan, runs, {study.index.quantity, "max", plan.start}, run,
                            scene_varies(plan.inputs));
    store.use_rung(model.rung(), model.step());
    note_origin(store, study, *mechanism, plan);
    const std::uint64_t begun_with = store.count();
    const Stopwatch computing;
    bool whole = compute(command, study, *mechanism, plan, runs, model, own.run(), store);
    const std::string stuck = no_run_done(!whole, begun_with, store.count(), computing.wall_seconds());
    // Last, as it keeps nothing before it ends.
    StudySteps steps{kNotMeasured, "not measured: the study was interrupted before"};
    if (whole)
      steps = own.run().steps_of_scatter({.inputs = plan.inputs, .statistic = {0.95}, .runs = runs.count()}, run,
                                         choice.name, &store);
    whole = whole && !steps.interrupted;

    std::optional<Budget> budget;
    if (whole)
      budget = budget_of(plan, runs, *mechanism, study.index.kind(), store,
                         look_at_requirements(plan, BudgetAxes(study.index.kind()), store), steps.relative);
    BudgetStudy result{.command = command,
                       .study = study,
                       .mechanism = *mechanism,
                       .rung = choice,
                       .plan = plan,
                       .runs = runs,
                       .budget = budget,
                       .warnings = {},
                       .leaves_out = model.leaves_out(),
                       .step = model.step()};
    const RunsSeen seen = runs_seen(store, runs, plan, rounding_of(*mechanism, study.index.si_unit()));
    result.model_error = seen.model_error;
    result.steps = steps;
    if (budget) result.warnings = warnings_of(result, seen);
    result.warnings.insert(result.warnings.end(), untold.begin(), untold.end());
    for (const std::string& one : study_warnings(*mechanism, choice.name)) result.warnings.push_back(one);
    if (!stuck.empty()) result.warnings.push_back(stuck);
    if (!store.damage().empty()) result.warnings.push_back(store.damage());
    write(result, seen, own, watch, store.earlier());
    if (!command.quiet) print(result, own.out());
    if (!budget) return kInterrupted;
    return budget->met() ? status_with_accuracy(choice, kDone) : kAnswerIsNo;
  }

 private:
  static void note_origin(SampleStore& store, const Study& study, const Mechanism& mechanism, const BudgetPlan& plan) {
    if (!store.fact("mechanism").empty()) return;
    store.note({{"mechanism", mechanism.name()},
                {"mechanism_hash", mechanism.description().content_hash},
                {"index", study.index.quantity + ".max"},
                {"unit", study.index.si_unit()},
                {"seed", std::to_string(plan.seed)}});
  }

  // Returns false if it was interrupted.
  static bool compute(const Command& command, const Study& study, const Mechanism& mechanism, const BudgetPlan& plan,
                      const BudgetRuns& runs, const BudgetModel& model, const StudyRun& run, SampleStore& store) {
    const std::vector<NumberRange> missing = runs.missing(store);
    std::uint64_t begun_with = runs.count(), done = 0;
    for (const NumberRange& range : missing) begun_with -= range.size();
    done = begun_with;
    if (!command.quiet) {
      tell("{}: {} on the {} rung, {} ({} with {} held and {} halved){}\n", mechanism.name(),
           how_many(plan.members, "member"), model.rung(), how_many(runs.count(), "run"),
           how_many(runs.attribution(), "member"), how_many(runs.groups(), "group"),
           how_many(runs.joints(), "clearance"),
           begun_with > 0 ? fmt::format(", {} of them stored already", begun_with) : "");
      std::fflush(stdout);
    }
    const std::unique_ptr<Stage> stage = run.stage(static_cast<double>(runs.count()), "runs");
    double largest = 0.0;
    std::uint64_t failed = 0;
    const auto landed = [&](std::span<const SampleRecord> records) {
      for (const SampleRecord& r : records) {
        ++done;
        if (r.outcome.status == Outcome::Status::failed) ++failed;
        if (r.outcome.value > largest) largest = r.outcome.value;
      }
      stage->update(static_cast<double>(begun_with), static_cast<double>(done),
                    "largest " + study.index.quantity_title() + " so far " +
                        readable_as(largest, study.index.si_unit(), plan.written_unit()) +
                        (failed > 0 ? fmt::format(", {} failed", failed) : ""));
    };
    const bool whole = store_runs(
        model, plan.inputs.size(), [&](std::uint64_t number, std::span<double> values) { runs.values(number, values); },
        missing, store, {.jobs = command.jobs, .landed = landed, .interrupted = [] { return interrupted(); }});
    stage->clear();
    return whole;
  }

  static std::vector<std::string> warnings_of(const BudgetStudy& s, const RunsSeen& seen) {
    const Budget& b = *s.budget;
    std::vector<std::string> warnings;
    if (seen.failures.count > 0)
      warnings.push_back(
          fmt::format("{} of {} runs failed; a member whose own run failed counts as bad in every answer",
                      seen.failures.count, s.runs.count()) +
          first_failure_text(seen.failures, "run"));
    if (seen.largest < rounding_of(s.mechanism, s.study.index.si_unit()) && s.runs.joints() > 0)
      warnings.push_back("the clearances make no " + s.study.index.quantity_title() +
                         " beyond rounding: where journal and sleeve axes are kept parallel they turn nothing; axes = "
                         "\"free\" lets them tilt");
    constexpr double kMuchMissed = 0.01;
    if (seen.missed > kMuchMissed)
      warnings.push_back(
          fmt::format("the sampled histories miss up to {} of a run's largest error; a finer `sampling` finds it",
                      readable_share(seen.missed)));
    for (const RequirementAnswer& r : b.requirements)
      if (!r.compliance.met && b.members < r.compliance.fewest)
        warnings.push_back(fmt::format("{} cannot be shown with {} members, whatever they give: it takes {}",
                                       requirement_title(s, r.asked), b.members, r.compliance.fewest));
    for (const RequirementAnswer& r : b.requirements)
      if (r.rule_says_met() && r.margin() < 0.0)
        warnings.push_back(fmt::format("{}: the classical rule would have said met", requirement_title(s, r.asked)));
    for (const auto& more : {tree_warnings(s, b), spectra_warnings(s, b), courses_warnings(s)})
      warnings.insert(warnings.end(), more.begin(), more.end());
    return warnings;
  }

  static Json sources_json(const BudgetStudy& s) {
    Json json;
    for (const BudgetSource& source : budget_sources(s)) {
      json[source.letter] = {{"what", source.what},
                             {"study", s.study.file},
                             {"study_hash", s.study.content_hash},
                             {"mechanism_hash", s.mechanism.description().content_hash},
                             {"seed", s.plan.seed}};
      if (source.runs.empty()) continue;
      json[source.letter]["store"] = "samples.db";
      json[source.letter]["runs"] = source.runs;
      json[source.letter]["rung"] = s.rung.name;
      json[source.letter]["step"] = s.step;
    }
    return json;
  }

  static void write(const BudgetStudy& s, const RunsSeen& seen, const VerbStudy& own, const Stopwatch& watch,
                    const SampleStore::Cost& earlier) {
    const OutputDirectory& out = own.out();
    Json json = own.head(s.study, s.rung, watch, s.warnings, !s.budget, earlier);
    json["seed"] = s.plan.seed;
    json["index"] = {{"quantity", s.study.index.quantity}, {"unit", s.study.index.si_unit()}};
    json["windows"] = {{"window", s.plan.windows.window},
                       {"separation", s.plan.windows.separation},
                       {"observation", s.plan.windows.observation},
                       {"revisit", s.plan.windows.revisit},
                       {"sampling", s.plan.sampling},
                       {"start", s.plan.start}};
    std::vector<std::string> files = {"summary.json", "samples.db", "report.html", "report.json"};
    add_first_failure(json, seen.failures, "run");
    if (s.budget) {
      json.update(budget_json(s, *s.budget));
      json["error"] = {
          {"rung", seen.model_error}, {"discretisation", number_json(s.steps.relative)}, {"sampling", seen.missed}};
      json["error"]["discretisation_why"] = s.steps.why;
      out.write("levels.csv", [&](std::ostream& stream) { write_levels(stream, s, *s.budget); });
      out.write("classical.csv", [&](std::ostream& stream) { write_classical(stream, s, *s.budget); });
      out.write("contributions.csv", [&](std::ostream& stream) { write_contributions(stream, *s.budget); });
      for (const char* file : {"levels.csv", "classical.csv", "contributions.csv"}) files.emplace_back(file);
      if (!s.budget->spectral.empty()) {
        out.write("spectra.csv", [&](std::ostream& stream) { write_spectra(stream, s, *s.budget); });
        files.emplace_back("spectra.csv");
      }
    }
    json["sources"] = sources_json(s);
    json["files"] = files;
    write_json(out, "summary.json", json);
    write_report(out, budget_report(s));
    out.publish();
  }

  static void print(const BudgetStudy& s, const OutputDirectory& out) {
    if (!s.budget) {
      tell("  interrupted; the same command goes on\n");
    } else {
      const Budget& b = *s.budget;
      if (b.requirements.empty()) tell("  {}\n", budget_verdict(s));
      for (const RequirementAnswer& r : b.requirements) {
        const std::string doubt = rule_doubt(s, r.level);
        tell("  {}; by the classical rule {}, {}{}\n", requirement_sentence(s, r),
             budget_value(s, r.level.by_rule, r.asked.unit), to_string(r.level.standing),
             doubt.empty() ? "" : ": " + doubt);
      }
      const std::size_t widest = widest_of(b.reductions, [](const ErrorReduction& r) { return r.name; });
      for (const ErrorReduction& r : b.reductions)
        tell("  {}  {:<20} {} {}{}\n", padded(r.name, widest), r.action, r.gain() < 0.0 ? "adds" : "takes off",
             budget_value(s, std::abs(r.gain())), gain_text(s, r));
    }
    tell_warnings(s.warnings, s.command, s.mechanism);
    tell("  report: {}\n", (out.path() / "report.html").string());
  }

  MotionOptions motion_;
  Resumption resumption_;
};

}  // namespace

std::unique_ptr<Verb> make_budget_verb() { return std::make_unique<BudgetVerb>(); }

}  // namespace boresight::app
