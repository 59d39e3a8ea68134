// boresight montecarlo STUDY: the distribution of the index over parameters that scatter.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>

#include "boresight_analyses/montecarlo/montecarlo.hpp"
#include "boresight_analyses/montecarlo/montecarlo_keys.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "command_line/montecarlo_study.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "montecarlo/montecarlo_report.hpp"
#include "montecarlo/montecarlo_summary.hpp"
#include "montecarlo/montecarlo_terminal.hpp"
#include "montecarlo/several_rungs.hpp"
#include "results/report_files.hpp"
#include "results/scatter_parts.hpp"
#include "results/stored_samples.hpp"
#include "results/study_warnings.hpp"
#include "results/summary.hpp"
#include "results/verb_study.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

// What the report tells of single samples: failed ones first, the others spread evenly; and what the rung thinks of its own error, on average.
class SamplesReadBack {
 public:
  explicit SamplesReadBack(const SampleStore& store) : store_(store) {}

  void see(const SampleRecord& record) {
    if (every_ == 0) every_ = store_.count() / kMostShown + 1;
    shown_.failures.see(record.number, record.outcome);
    if (record.outcome.status == Outcome::Status::failed) {
      if (shown_.failed.size() < kMostFailedShown) shown_.failed.push_back(record);
      return;
    }
    done_ += 1.0;
    model_error_ += record.outcome.model_error;
    if (model_errors_.size() <= record.number) model_errors_.resize(record.number + 1, 0.0);
    model_errors_[record.number] = record.outcome.model_error;
    if (record.number % every_ == 0) shown_.done.push_back(record);
  }

  const ShownSamples& shown() const { return shown_; }
  double mean_model_error() const { return done_ > 0.0 ? model_error_ / done_ : 0.0; }
  const std::vector<double>& model_errors() const { return model_errors_; }  // by number; 0 where not known

 private:
  const SampleStore& store_;
  std::uint64_t every_ = 0;
  ShownSamples shown_;
  double done_ = 0.0, model_error_ = 0.0;
  std::vector<double> model_errors_;
};

class MonteCarloVerb : public Verb {
 public:
  std::string name() const override { return "montecarlo"; }
  std::string file_kind() const override { return "study"; }
  const KeyTable* study_table() const override { return &montecarlo_keys(); }
  std::string summary() const override { return "the index's distribution, with confidence intervals"; }
  std::string example() const override { return "boresight montecarlo antenna/montecarlo.toml"; }
  std::string next(const Command&, bool answer_is_no) const override {
    const std::filesystem::path folder = last_summary().parent_path();
    const std::vector<std::filesystem::path> stores = stored_samples(folder);  // none of a tail
    if (answer_is_no || stores.empty())
      return "boresight help sensitivity: which parameter to tighten; boresight help allocate: which fits would do";
    return "boresight export " + shell_word(folder.string()) + ": every sample as CSV" +
           (stores.size() > 1 ? ", a table for each rung" : "");
  }
  void declare_options(CLI::App& app) override {
    motion_.declare_model(app);
    resumption_.declare(app);
  }

  int execute(const Command& command) override {
    const std::unique_ptr<Ranks> ranks = Ranks::join();
    const bool first = ranks->rank() == 0;
    const Stopwatch watch;
    MonteCarloQuestion question;
    RunOptions run;
    try {
      question = read_montecarlo_question(command.file, command.settings);
      check_rung_name(command.rung);
      if (command.rung != "auto" && (question.plan.fidelities || question.plan.tail))
        throw InputError({"command line", 0}, "--rung", in_quotes(command.rung), "none: the study names its rungs");
      run = motion_.run_options(*question.mechanism, command.rung);
    } catch (const InputError&) {
      if (first) throw;
      throw SilentExit{kBadInput};  // rank 0 says it
    }
    const nlohmann::json identity = identity_for(command, question);
    if (question.plan.fidelities || question.plan.tail) {
      if (!first) return kDone;  // one rank does it all
      const VerbStudy own(command, question.mechanism, question.study.index, question.study.accuracy, run, identity);
      if (!resumption_.from.empty())
        throw InputError({"command line", 0}, "--from", in_quotes(resumption_.from),
                         "none: a study on several rungs goes on in its own folder");
      const SeveralRungs several{command, question, own, watch};
      return question.plan.fidelities ? run_fidelities(several) : run_tail(several);
    }

    // Rank 0 owns the folder, finds the rung, and tells the others both.
    std::string told;
    std::unique_ptr<VerbStudy> own;
    std::unique_ptr<SampleStore> store;
    RungChoice choice;
    if (first) {
      own = std::make_unique<VerbStudy>(command, question.mechanism, question.study.index, question.study.accuracy, run,
                                        identity);
      store = open_store(*own, question);
      choice = rung_for(own->run(), question, *store);
      told = nlohmann::json{{"folder", own->out().path().string()},
                            {"rung", choice.name},
                            {"step", choice.step},
                            {"integrator", choice.integrator},
                            {"tolerance", choice.tolerance}}
                 .dump();
    }
    ranks->broadcast(told);
    const nlohmann::json heard = nlohmann::json::parse(told);

    RunOptions model_options = run;
    apply({.name = heard["rung"],
           .why = "",
           .step = heard["step"],
           .integrator = heard["integrator"],
           .tolerance = heard["tolerance"]},
          model_options);
    StudyRunOptions asked = run_options_of(command, question.study.index, question.study.accuracy, run);
    asked.identity = identity.dump();
    const StudyRun on_any_rank(question.mechanism, asked);
    const std::unique_ptr<SampleModel> sampled =
        on_any_rank.model_of_scatter(heard["rung"], question.plan.inputs, model_options);
    const SampleModel& model = *sampled;
    MonteCarloOptions options{.folder = heard["folder"].get<std::string>(),
                              .facts = on_any_rank.facts(),
                              .jobs = command.jobs,
                              .progress = {},
                              .interrupted = [] { return interrupted(); }};
    if (!first) {
      run_montecarlo(model, question.plan, nullptr, *ranks, options);
      return kDone;
    }
    store->use_rung(model.rung(), model.step());
    if (!command.quiet) announce(question, choice, asked.accuracy.has_value(), store->count(), ranks->size());
    const std::unique_ptr<Stage> stage = own->run().stage(static_cast<double>(question.plan.samples), "samples");
    options.progress = [&](const MonteCarloProgress& p) { show(*stage, p, question); };
    const std::uint64_t begun_with = store->count();
    SamplesReadBack read_back(*store);
    options.read_back = [&](const SampleRecord& record) { read_back.see(record); };
    const Stopwatch sampling;
    MonteCarloResult result = run_montecarlo(model, question.plan, store.get(), *ranks, options);
    stage->clear();
    const std::string stuck = no_run_done(result.ended == Ended::interrupted || result.ended == Ended::time, begun_with,
                                          store->count(), sampling.wall_seconds());
    // Last, as it keeps nothing before it ends: the samples get on in however short a time a process has.
    StudySteps steps{kNotMeasured, "not measured: the study was interrupted before"};
    if (result.ended != Ended::interrupted)
      steps = own->run().steps_of_scatter({.inputs = question.plan.inputs,
                                           .statistic = asked_of_scatter(question.plan),
                                           .runs = question.plan.samples,
                                           .lanes = true},
                                          model_options, model.rung(), store.get());
    if (steps.interrupted) result.ended = Ended::interrupted;
    return write_results(command, question, choice, model, *store, steps, result, read_back, watch, *own, stuck);
  }

 private:
  nlohmann::json identity_for(const Command& command, const MonteCarloQuestion& question) const {
    nlohmann::json options = motion_.model_identity();
    if (question.study.accuracy) options["study_accuracy"] = *question.study.accuracy;
    return identity_of_study(command, *question.mechanism, question.plan.sample_text(question.study), options);
  }

  std::unique_ptr<SampleStore> open_store(const VerbStudy& own, const MonteCarloQuestion& question) const {
    std::unique_ptr<SampleStore> store = own.open_samples("", question.plan.inputs.names(), resumption_);
    merge_shards(*store, own.out().path());
    if (store->fact("mechanism").empty())
      store->note({{"mechanism", question.mechanism->name()},
                   {"mechanism_hash", question.mechanism->description().content_hash},
                   {"index", question.study.index.quantity + "." + question.study.index.statistic},
                   {"unit", question.study.index.si_unit()},
                   {"seed", std::to_string(question.plan.design.seed)},
                   {"inputs", question.plan.inputs.text},
                   {"design", question.plan.design.text()}});
    return store;
  }

  // A study keeps its rung: the one it was begun with is the one it goes on with.
  static RungChoice rung_for(const StudyRun& own, const MonteCarloQuestion& question, SampleStore& store) {
    if (const std::optional<RungChoice> begun_with = stored_choice(store)) return *begun_with;
    const RunOptions& run = own.options().run;
    RungChoice choice = own.choose_rung_of_scatter({.inputs = question.plan.inputs,
                                                    .statistic = asked_of_scatter(question.plan),
                                                    .runs = question.plan.samples,
                                                    .lanes = true,
                                                    .integrators = true});
    // A pilot has chosen the step too. Lanes choose each sample's steps by its error; what else runs with rk4 takes one
    // step for all samples.
    const bool lanes =
        choice.name == "perturbation" && LaneSampleModel::serve(*question.mechanism, question.study.index, run);
    if (!choice.pilot && !lanes && run.step == 0.0)
      choice.step = own.common_step_of_scatter(choice.name, question.plan.inputs, run, store);
    note_choice(store, choice);
    if (choice.pilot) {
      store.note("pilot_reference_error", fmt::format("{:.17g}", choice.pilot->reference_error));
      store.note("pilot_pairs", std::to_string(choice.pilot->pairs));
      for (const PilotResult::ErrorOfStatistic& e : choice.pilot->errors)
        store.note(fmt::format("pilot_error_{:g}", e.probability), fmt::format("{:.17g}", e.error));
    }
    return choice;
  }

  // The quantile that a requirement is about, or else the one that a reader looks at first.
  static ScatterStatistic asked_of_scatter(const MonteCarloPlan& plan) {
    if (plan.requirement) return {plan.requirement->probability};
    for (const Headline& h : headlines())
      if (headline_of(plan) == h.name) return {h.probability};
    return {};
  }

  int write_results(const Command& command, const MonteCarloQuestion& question, const RungChoice& choice,
                    const SampleModel& model, SampleStore& store, const StudySteps& steps,
                    const MonteCarloResult& result, const SamplesReadBack& read_back, const Stopwatch& watch,
                    const VerbStudy& own, const std::string& stuck) const {
    const OutputDirectory& out = own.out();
    ModelError error;
    const ShownSamples& shown = read_back.shown();
    error.rung = read_back.mean_model_error();
    error.rung_of_sample = read_back.model_errors();
    error.rung_why = "the rung's own estimate of what it leaves out, mean over the samples";
    error.discretisation = steps.relative;
    error.discretisation_why = steps.why;
    for (const Headline& h : headlines())
      if (const std::string found = store.fact(fmt::format("pilot_error_{:g}", h.probability)); !found.empty())
        // The mean's error says nothing of the standard deviation's.
        error.rung_of[h.name] = std::string(h.name) == "sd" ? kNotMeasured : std::stod(found);
    if (!error.rung_of.empty())
      error.rung_why = fmt::format(
          "measured by the pilot: this way against multibody at half its step over {} paired samples, with 95 % "
          "confidence, what "
          "the steps do and what that reference is off by itself included",
          store.fact("pilot_pairs"));
    const Estimates estimates = estimate(result.values, question.plan, error, judged(question.plan, result, store));
    MonteCarloStudy study{.command = command,
                          .study = question.study,
                          .mechanism = *question.mechanism,
                          .rung = choice,
                          .plan = question.plan,
                          .result = result,
                          .estimates = estimates,
                          .shown = shown,
                          .warnings = warnings_of(question, result, estimates, shown.failures),
                          .leaves_out = model.leaves_out(),
                          .replay = replay_command(command, choice, model)};
    for (const std::string& one : study_warnings(*question.mechanism, choice.name)) study.warnings.push_back(one);
    if (!stuck.empty()) study.warnings.push_back(stuck);
    if (!store.damage().empty()) study.warnings.push_back(store.damage());
    write_json(out, "summary.json", montecarlo_summary(study, watch, own, store));
    write_report(out, montecarlo_report(study));
    out.publish();
    if (!command.quiet) print(study, out);
    if (result.ended == Ended::interrupted) return kInterrupted;
    if (estimates.failed == estimates.samples && estimates.samples > 0)
      return failed(command, "all samples failed" + first_failure_text(shown.failures, "sample"));
    return estimates.requirement && !estimates.requirement->met ? kAnswerIsNo : status_with_accuracy(choice, kDone);
  }

  // How the requirement is judged; and that it was, for those who look again.
  static std::optional<Judgement> judged(const MonteCarloPlan& plan, const MonteCarloResult& result,
                                         SampleStore& store) {
    if (!plan.requirement) return std::nullopt;
    if (result.ended == Ended::interrupted)
      return Judgement{Judgement::By::nothing, plan.requirement->confidence, "not judged: interrupted"};
    return look(store, question_of(*plan.requirement), asked_share_of(plan), looked_at_of(plan), result.values.size());
  }

  static std::vector<std::string> warnings_of(const MonteCarloQuestion& question, const MonteCarloResult& result,
                                              const Estimates& estimates, const Failures& failures) {
    std::vector<std::string> warnings;
    const MonteCarloPlan& plan = question.plan;
    const SamplingDesign design(plan.design, static_cast<int>(plan.inputs.size()));
    if (const std::string warning = design.warning(result.values.size()); !warning.empty() && !result.values.empty())
      warnings.push_back(warning);
    if (result.ended == Ended::time)
      warnings.push_back(fmt::format("stopped after {} with {} of {} samples; the same command goes on",
                                     readable(plan.stop.seconds, "s"), result.values.size(), plan.samples));
    if (result.ended == Ended::width)
      warnings.push_back(fmt::format(
          "stopped at {} samples as the interval of {} was narrow enough: it allows for being looked at several "
          "times, those of the other estimates do not",
          result.values.size(), plan.stop.of));
    if (estimates.failed > 0)
      warnings.push_back(
          fmt::format("{} of {} samples failed; they count as bad in every bound, and mean and standard deviation "
                      "leave them out",
                      estimates.failed, estimates.samples) +
          first_failure_text(failures, "sample"));
    if (plan.requirement && static_cast<std::int64_t>(result.values.size()) < estimates.requirement->fewest_samples)
      warnings.push_back(fmt::format("the requirement cannot be shown with {} samples, whatever they give: it takes {}",
                                     result.values.size(), estimates.requirement->fewest_samples));
    return warnings;
  }

  std::string replay_command(const Command& command, const RungChoice& choice, const SampleModel& model) const {
    std::string text = "boresight run " + shell_word(command.file);
    for (const Setting& setting : command.settings) text += " --set " + shell_word(setting.path + "=" + setting.value);
    text += " --rung " + model.rung();
    if (model.step() > 0.0 && why_unread("step", model.rung()).empty())
      text += fmt::format(" --step \"{:.17g} s\"", model.step());
    if (model.batch() > 1) text += " --integrator rosenbrock";  // the lanes' method; its steps are not the same
    if (!choice.integrator.empty() && motion_.integrator.empty())
      text += fmt::format(" --integrator {} --tolerance {:g}", choice.integrator, choice.tolerance);
    text += motion_.model_text(model.rung());
    return text + " --sample-number";
  }

  MotionOptions motion_;
  Resumption resumption_;
};

}  // namespace

std::unique_ptr<Verb> make_montecarlo_verb() { return std::make_unique<MonteCarloVerb>(); }

}  // namespace boresight::app
