// boresight sensitivity STUDY: which parameter's scatter makes the index scatter.
#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "boresight_analyses/sensitivity/exact_slopes.hpp"
#include "boresight_analyses/sensitivity/sensitivity_keys.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/scatter_parts.hpp"
#include "results/study_warnings.hpp"
#include "results/tables.hpp"
#include "results/verb_study.hpp"
#include "sensitivity/sensitivity_report.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

constexpr std::size_t kMostOfPlot = 2000;  // points of a scatter plot

void write_local(std::ostream& out, const LocalResult& local) {
  out << "parameter,unit,median,sd,low,high,index_at_low,index_at_high";
  for (const char* name : {"half", "quarter", "eighth"}) out << ",step_" << name << ",derivative_" << name;
  out << ",meaningful,exact,exact_agrees\n";
  for (const LocalSensitivity& p : local.parameters) {
    out << csv_field(p.name) << ',' << csv_field(p.told_unit);
    for (const double v : {p.median, p.sd, p.low, p.high, p.at_low, p.at_high}) out << ',' << exact(v);
    for (std::size_t k = 0; k < p.step.size(); ++k) out << ',' << exact(p.step[k]) << ',' << exact(p.derivative[k]);
    out << ',' << (p.meaningful ? "true" : "false") << ',' << exact(p.exact) << ','
        << (p.exact_agrees ? "true" : "false") << '\n';
  }
}

class SensitivityVerb : public Verb {
 public:
  std::string name() const override { return "sensitivity"; }
  std::string file_kind() const override { return "study"; }
  const KeyTable* study_table() const override { return &sensitivity_keys(); }
  std::string summary() const override {
    return "which parameter's scatter matters: Sobol' indices, screening, Shapley effects, tornado";
  }
  std::string example() const override { return "boresight sensitivity antenna/sensitivity.toml"; }
  std::string next(const Command&, bool) const override {
    return "boresight help allocate: which fits meet a requirement at least cost";
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
    const SensitivityPlan plan = read_sensitivity_plan(input.root, study, mechanism->description(), input.trial);
    check_rung_name(command.rung);
    RunOptions run = motion_.run_options(*mechanism, command.rung);

    nlohmann::json options = motion_.model_identity();
    if (study.accuracy) options["study_accuracy"] = *study.accuracy;
    const VerbStudy own(command, mechanism, study.index, study.accuracy, run,
                        identity_of_study(command, *mechanism, plan.text(study), options));
    const std::unique_ptr<SampleStore> opened = own.open_samples(plan.text(study), plan.inputs.names(), resumption_);
    SampleStore& store = *opened;
    const RungChoice choice = rung_for(own.run(), plan, store);
    apply(choice, run);
    const std::unique_ptr<SampleModel> sampled = own.run().model_of_scatter(choice.name, plan.inputs, run);
    const SampleModel& model = *sampled;
    store.use_rung(model.rung(), model.step());

    if (!command.quiet) {
      tell("{}: {} ({} of {}; {})\n", mechanism->name(), how_many(plan.runs(), "run"), how_many(plan.rows, "row"),
           plan.runs_per_row(), plan.design.text());
      if (plan.method == SensitivityMethod::sobol && plan.groups.size() > kManyGroups)
        tell("  {} parameters or groups: method = \"morris\" finds those that matter with some 32 samples of {} runs\n",
             plan.groups.size(), plan.groups.size() + 1);
      std::fflush(stdout);
    }
    const std::unique_ptr<Stage> stage = own.run().stage(static_cast<double>(plan.runs()), "runs");
    SensitivityOptions options_of_runs{
        .jobs = command.jobs, .progress = {}, .interrupted = [] { return interrupted(); }};
    options_of_runs.progress = [&](const SensitivityProgress& p) {
      stage->update(static_cast<double>(p.begun_with), static_cast<double>(p.done),
                    "mean of the index " + readable(p.mean_so_far, study.index.si_unit()) +
                        (p.failed > 0 ? fmt::format(", {} failed", p.failed) : ""));
    };
    const std::uint64_t begun_with = store.count();
    const Stopwatch computing;
    const bool whole = compute_sensitivity_runs(model, plan, store, options_of_runs);
    const std::string stuck = no_run_done(!whole, begun_with, store.count(), computing.wall_seconds());
    std::unique_ptr<MethodResult> found;
    LocalResult local;
    local.interrupted = true;
    if (whole) {
      found = method_result(study, plan, store);
      local = local_sensitivity(model, plan.inputs, command.jobs, [] { return interrupted(); });
      if (!local.interrupted && choice.name == "perturbation")
        add_exact_slopes(mechanism, plan.inputs, study.index, run, local);
    }
    stage->clear();

    SensitivityStudy result{.command = command,
                            .study = study,
                            .mechanism = *mechanism,
                            .rung = choice,
                            .plan = plan,
                            .result = found.get(),
                            .local = local,
                            .shown = {},
                            .interrupted = !whole || local.interrupted,
                            .warnings = {},
                            .leaves_out = model.leaves_out(),
                            .failures = {}};
    const std::uint64_t every = plan.runs_per_row() * (plan.rows / kMostOfPlot + 1);
    store.read(plan.runs(), [&](const SampleRecord& r) {
      result.failures.see(r.number, r.outcome);
      if (r.number % every == 0 && r.outcome.status == Outcome::Status::done) result.shown.push_back(r);
    });
    result.warnings = warnings_of(result);
    for (const std::string& one : study_warnings(*mechanism, choice.name)) result.warnings.push_back(one);
    if (!stuck.empty()) result.warnings.push_back(stuck);
    if (!store.damage().empty()) result.warnings.push_back(store.damage());
    write(result, own, watch, store.earlier());
    if (!command.quiet) print(result, own.out());
    if (result.interrupted) return kInterrupted;
    if (found == nullptr)
      return failed(command, "too many runs failed to tell what matters" + first_failure_text(result.failures, "run"));
    return status_with_accuracy(choice, kDone);
  }

 private:
  // With the step that all runs share.
  static RungChoice rung_for(const StudyRun& own, const SensitivityPlan& plan, SampleStore& store) {
    const bool begun = !store.rungs().empty();
    RungChoice choice =
        own.rung_of_scatter({.inputs = plan.inputs, .runs = plan.runs(), .lanes = true, .integrators = true}, store);
    if (begun || choice.pilot) return choice;
    const RunOptions& run = own.options().run;
    const bool lanes =
        choice.name == "perturbation" && LaneSampleModel::serve(*own.mechanism(), own.options().index, run);
    if (!lanes && choice.step == 0.0 && run.step == 0.0)
      choice.step = own.common_step_of_scatter(choice.name, plan.inputs, run, store);
    return choice;
  }

  // Each by itself where they are few. Where the index turns there is no slope to warn of; the table says so.
  static void add_slope_warnings(const LocalResult& local, std::vector<std::string>& warnings) {
    constexpr std::size_t kFew = 5;
    std::vector<std::string> rough;
    for (const LocalSensitivity& p : local.parameters) {
      if (!p.meaningful && !p.turns) rough.push_back(p.name + ": " + p.why_not);
      if (std::isfinite(p.exact) && !p.exact_agrees) warnings.push_back(p.name + ": " + p.exact_note);
    }
    if (rough.size() > kFew)
      warnings.push_back(fmt::format("no slope for {} of {} parameters; the first is {}", rough.size(),
                                     local.parameters.size(), rough.front()));
    else
      for (const std::string& one : rough) warnings.push_back("no slope for " + one);
  }

  static std::vector<std::string> warnings_of(const SensitivityStudy& s) {
    std::vector<std::string> warnings;
    if (s.result != nullptr) {
      warnings = s.result->warnings();
      const RowCounts counts = s.result->counts();
      if (counts.failed_runs > 0)
        warnings.push_back(
            fmt::format("{} of {} runs failed; the {} rows that they belong to are left out, so the results speak of "
                        "the parameters' range without them",
                        counts.failed_runs, s.plan.runs(), counts.failed_rows) +
            first_failure_text(s.failures, "run"));
    } else if (s.failures.count > 0) {
      warnings.push_back(
          fmt::format("{} of {} runs failed: too many to tell what matters", s.failures.count, s.plan.runs()) +
          first_failure_text(s.failures, "run"));
    }
    add_slope_warnings(s.local, warnings);
    return warnings;
  }

  static void write(const SensitivityStudy& s, const VerbStudy& own, const Stopwatch& watch,
                    const SampleStore::Cost& earlier) {
    const OutputDirectory& out = own.out();
    Json json = own.head(s.study, s.rung, watch, s.warnings, s.interrupted, earlier);
    json["seed"] = s.plan.design.seed;
    json["method"] = to_string(s.plan.method);
    json["design"] = s.plan.design.text();
    json["samples"] = s.plan.rows;
    json["runs"] = s.plan.runs();
    json["index"] = {{"quantity", s.study.index.quantity},
                     {"statistic", s.study.index.statistic},
                     {"unit", s.study.index.si_unit()}};
    add_first_failure(json, s.failures, "run");
    std::vector<std::string> files = {"summary.json", "samples.db", "report.html", "report.json"};
    if (s.result != nullptr) {
      s.result->add_to(json);
      json["failed"] = s.result->counts().failed_runs;
      json["failed_rows"] = s.result->counts().failed_rows;
      out.write(s.result->table_name(), [&](std::ostream& stream) { s.result->write_table(stream); });
      files.push_back(s.result->table_name());
    }
    if (!s.local.interrupted) {
      json["local"]["at_medians"] = number_json(s.local.at_medians);
      for (const LocalSensitivity& p : s.local.parameters) {
        Json steps = Json::array();
        for (std::size_t k = 0; k < p.step.size(); ++k)
          steps.push_back({{"step", number_json(p.step[k])}, {"derivative", number_json(p.derivative[k])}});
        json["local"][p.name] = {{"unit", p.told_unit},
                                 {"median", p.median},
                                 {"low", p.low},
                                 {"high", p.high},
                                 {"at_low", number_json(p.at_low)},
                                 {"at_high", number_json(p.at_high)},
                                 {"meaningful", p.meaningful},
                                 {"derivative", p.meaningful ? number_json(p.derivative.back()) : Json()},
                                 {"differences", steps}};
        if (!p.meaningful) json["local"][p.name]["why_not"] = p.why_not;
        if (std::isfinite(p.exact)) {
          json["local"][p.name]["exact_derivative"] = p.exact;
          json["local"][p.name]["exact_agrees"] = p.exact_agrees;
        }
        if (!p.exact_note.empty()) json["local"][p.name]["exact_note"] = p.exact_note;
      }
      out.write("local.csv", [&](std::ostream& stream) { write_local(stream, s.local); });
      files.emplace_back("local.csv");
    }
    json["files"] = files;
    write_json(out, "summary.json", json);
    write_report(out, sensitivity_report(s));
    out.publish();
  }

  static void print(const SensitivityStudy& s, const OutputDirectory& out) {
    if (s.interrupted) tell("  interrupted; the same command goes on\n");
    if (s.result != nullptr) s.result->print(s.rung.name);
    tell_warnings(s.warnings, s.command, s.mechanism);
    tell("  report: {}\n", (out.path() / "report.html").string());
  }

  MotionOptions motion_;
  Resumption resumption_;
};

}  // namespace

std::unique_ptr<Verb> make_sensitivity_verb() { return std::make_unique<SensitivityVerb>(); }

}  // namespace boresight::app
