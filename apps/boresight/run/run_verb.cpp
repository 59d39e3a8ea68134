// boresight run MECHANISM: one motion, its pointing error, its contacts.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/perturbation/predictability.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/stepping/measured_error.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/montecarlo_study.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "report_parts/mechanism_view.hpp"
#include "report_parts/step_error_parts.hpp"
#include "results/assumed.hpp"
#include "results/motion_claims.hpp"
#include "results/report_files.hpp"
#include "results/scatter_parts.hpp"
#include "results/tables.hpp"
#include "results/verb_study.hpp"
#include "run/accuracy_asked.hpp"
#include "run/error_lines.hpp"
#include "run/nonlinear_section.hpp"
#include "run/parts_section.hpp"
#include "run/run_report.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

constexpr double kOfAnother =
    1.0;  // of an index that is printed beside the one asked for: what its rung leaves out is all of it

// What --compare hands on to rungs other than the one asked for: run_other().
const std::vector<std::string> kReadByOthers = {"step", "formulation", "stabilisation"};

// "heun", "one static balance an instant": without the word that summary.json has for no integrator.
std::string how_it_goes(const std::string& integrator) {
  const std::string none = "none: ";
  return integrator.starts_with(none) ? integrator.substr(none.size()) : integrator;
}

void print(const Command& command, const Mechanism& mechanism, const RungChoice& choice, const RunResult& result,
           const std::vector<Compared>& others, const std::optional<AxesComparison>& axes,
           const std::optional<Predictability>& predictability, const MeasuredError& measured,
           const std::optional<RunParts>& parts, const IndexChoice& wanted,
           const std::optional<AccuracyAsked>& accuracy, const OutputDirectory& out) {
  tell("{}: {} of motion, {} rung, {}{}\n", mechanism.name(), readable(result.end_time, "s"), result.rung,
       how_it_goes(result.integrator), result.interrupted ? " (interrupted)" : "");
  if (choice.pilot) tell("  rung: {}\n", choice.why);
  const double size = mechanism.characteristic_length();
  for (const std::string& line : error_lines(result, measured, size)) tell("  {}\n", line);
  if (result.start > 0.0) tell("  from {} on\n", readable(result.start, "s"));
  for (std::size_t k = 0; k < result.contact.size(); ++k) {
    const ContactSummary& c = result.contact[k];
    const std::string uncertainty = force_error_text(measured, result, k);
    tell("  {}: in contact {} of the time, {}, penetration up to {}, contact forces up to {}{}\n", c.joint,
         readable_share(c.contact_fraction), how_many(c.impacts, "impact"), readable(c.max_penetration, "m"),
         readable(c.max_force, "N"), uncertainty.empty() ? "" : " " + uncertainty);
  }
  if (parts)
    for (const std::string& line : parts_lines(*parts)) tell("  {}\n", line);
  // A warning says the same with what to do about it.
  if (const ModelErrorSaid said = model_error_said(result, wanted, size);
      !result.interrupted && said.warning.empty() && !said.sentence.empty())
    tell("  {}\n", said.sentence);
  if (!result.interrupted) tell("  {}\n", step_error_sentence(measured, result.index, wanted, size));
  if (accuracy) tell("  {}\n", accuracy_sentence(*accuracy, wanted));
  if (predictability && predictability->parted) tell("  {}\n", predictability_sentence(*predictability));
  for (const Compared& other : others) {
    if (!other.refusal.empty())
      tell("  {:<12} {}\n", other.rung, other.refusal);
    else
      tell("  {:<12} position error max {:>10} RMS {:>10}, boresight max {:>10}, {} of CPU\n", other.rung,
           readable(other.result.index.position_error.max, "m"), readable(other.result.index.position_error.rms, "m"),
           readable(other.result.index.boresight_error.max, "rad"), readable(other.result.cost.cpu_seconds, "s"));
  }
  if (axes && !axes->free && axes->tells && axes->free_boresight > 1e-6) tell("  note: {}\n", axes->sentence);
  tell_warnings(result.warnings, command, mechanism);
  tell("  report: {}\n", (out.path() / "report.html").string());
}

// What the rung leaves out, of every quantity that there is.
Json model_errors_json(const RunResult& result) {
  Json json;
  for (const QuantityName& quantity : quantity_names())
    if (quantity.kind != PointingQuantity::line_of_sight_error || result.index.has_line_of_sight)
      json[quantity.name] = result.error.model_of(quantity.kind);
  return json;
}

Json summary_of(const Command& command, const Mechanism& mechanism, const RungChoice& rung, const RunResult& result,
                const std::vector<Compared>& others, const std::optional<AxesComparison>& axes,
                const std::optional<Predictability>& predictability, const MeasuredError& measured,
                const IndexChoice& wanted, const Stopwatch& watch, bool cut_short, const OutputDirectory& out) {
  Json json = common_summary(command, mechanism, rung, watch, result.warnings, cut_short, out);
  json["formulation"] = result.formulation;
  json["integrator"] = result.integrator;
  json["start"] = result.start;
  json["settled_from"] = result.settled_from;
  json["end_time"] = result.end_time;
  json["index"] = index_json(result.index);
  json["contact"] = contact_json(result.contact);
  json["platform_acceleration_max"] = vector_json(result.platform_acceleration_max);
  json["constraint_drift"] = result.constraint_drift;
  if (result.rung == "multibody") json["energy_error"] = result.energy_error;  // no other rung keeps track
  json["error_estimate"] = {{"model", result.error.model_of(wanted.kind())},
                            {"model_of_each", model_errors_json(result)},
                            {"discretisation", number_json(result.error.discretisation)},
                            {"of", wanted.quantity + "." + wanted.statistic},
                            {"basis", result.error.basis},
                            {"steps", step_error_json(measured)}};
  if (axes)
    json["axes"] = {
        {"tilt_computed", axes->free},
        {"boresight_error_at_rest", {{"parallel", axes->parallel_boresight}, {"free", axes->free_boresight}}},
        {"position_error_at_rest", {{"parallel", axes->parallel_position}, {"free", axes->free_position}}}};
  for (const Compared& other : others) {
    Json& entry = json["compared"][other.rung];
    if (other.refusal.empty())
      entry = {{"index", index_json(other.result.index)}, {"cpu_seconds", other.result.cost.cpu_seconds}};
    else
      entry = {{"refused", other.refusal}};
  }
  if (predictability) json["predictability"] = predictability_json(*predictability);
  json["steps"] = result.cost.steps;
  json["rejected_steps"] = result.cost.rejected_steps;
  json["evaluations"] = result.cost.evaluations;
  json["files"] = {"summary.json", "timeseries.csv", "events.csv", "report.html", "report.json"};
  return json;
}

class RunVerb : public Verb {
 public:
  std::string name() const override { return "run"; }
  std::string file_kind() const override { return "mechanism"; }
  std::string summary() const override { return "one motion: pose, pointing error, contact states, forces"; }
  std::string example() const override {
    return "boresight run antenna/mechanism.toml --set clearance.elevation.radial=0.06mm --out results/wide";
  }
  std::string next(const Command& command, bool answer_is_no) const override {
    return answer_is_no ? "boresight chart " + shell_word(command.file) + " shows what accuracy can be had here"
                        : "boresight help montecarlo: how the error scatters; --compare: what simpler rungs give";
  }
  void declare_options(CLI::App& app) override {
    motion_.declare(app, true);
    declare_flag(app, "--compare", compare_, "run the other rungs too and lay them over this one");
    declare_option(app, "--sample-number", sample_number_,
                   "FILE is a Monte Carlo study: run this one of its samples (from 0) and report on it", "K");
    declare_option(app, "--nonlinear", nonlinear_,
                   "the drive's period: adds Poincaré sections, phase portraits and the largest Lyapunov exponent",
                   "PERIOD");
    declare_option(app, "--start", start_, "indices, contact counts and peaks leave out what the motion does before",
                   "TIME");
    declare_option_with_default(
        app, "--step-error", step_error_,
        "what the steps do to the indices, by further runs: auto where these take less than 10 s of CPU, on, off",
        "WHEN");
    declare_option(app, "--index", index_,
                   "the index that --accuracy is about, such as boresight_error.rms; otherwise position_error.max",
                   "QUANTITY.STATISTIC");
  }

  int execute(const Command& asked) override {
    const Stopwatch watch;
    const Command command = sample_number_.empty() ? asked : replay_of(asked);
    const auto mechanism = std::make_shared<const Mechanism>(
        replayed_ ? *replayed_ : Mechanism(read_mechanism(command.file, command.settings)));
    check_rung_name(command.rung);
    RunOptions options =
        motion_.run_options(*mechanism, command.rung, compare_ ? kReadByOthers : std::vector<std::string>());
    check_step_error();
    IndexChoice index = index_named("--index", index_.empty() ? "position_error.max" : index_);
    index.start = options.start = start_.empty() ? replayed_start_ : positive_quantity("--start", start_, kDuration);
    check_line_of_sight(index, *mechanism, {"command line", 0}, "--index");
    check_start(index.start, *mechanism, {"command line", 0}, "--start");
    Json identity = motion_.identity();
    if (index.start > 0.0) identity["start"] = index.start;
    double period = 0.0;
    if (!nonlinear_.empty()) {
      period = positive_quantity("--nonlinear", nonlinear_, kDuration);
      check_period(*mechanism, period);
      options.sample_spacing = spacing_on_period(options.sample_spacing, period);
      identity["nonlinear"] = nonlinear_;
    }
    const OutputDirectory out =
        OutputDirectory::open(command.out, command.verb, command.file, replayed_as_,
                              identity_of(command, mechanism->description().content_hash, "", identity));

    const std::size_t finer = history_refinement(mechanism->duration(), options.sample_spacing);
    options.sample_spacing /= static_cast<double>(finer);
    options.frame_spacing = view_frame_spacing(*mechanism);
    Progress progress(command.quiet, mechanism->duration(), "s of motion");
    options.progress = [&](const RunProgress& p) {
      progress.update(p.t, "position error so far " + readable(p.position_error_max_so_far, "m"));
      return !interrupted();
    };
    const RungChoice choice = StudyRun(mechanism, run_options_of(command, index, {}, options))
                                  .choose_rung({.wants_multibody = motion_.asks_for_multibody(), .integrators = true},
                                               kPilotTrials, {mechanism->parameters()});
    apply(choice, options);

    const std::unique_ptr<Rung> rung = make_rung(choice.name, mechanism);
    RunResult result = rung->run(mechanism->parameters(), options);
    refuse_absurd(*mechanism, mechanism->parameters(), result);
    add_range_warnings(*mechanism, mechanism->parameters(), result);
    std::vector<Compared> others;
    std::optional<AxesComparison> axes;
    std::optional<Predictability> predictability;
    MeasuredError measured;
    std::optional<RunParts> parts;
    bool cut_short = result.interrupted;
    try {
      if (!cut_short) parts = run_parts(*mechanism, result);
      if (parts) result.warnings.insert(result.warnings.end(), parts->overrun.begin(), parts->overrun.end());
      if (compare_ && !cut_short)
        for (const std::string& name : rung_names())
          if (name != choice.name)
            others.push_back(run_other(name, mechanism, options, motion_.run_options(*mechanism, "auto").step));
      if (std::string left_out; !cut_short) {
        axes = compare_axes(*mechanism, left_out);
        if (!left_out.empty()) result.warnings.push_back(left_out);
      }
      // Rungs without steps have no trajectory to lose.
      if (!integrator_names(choice.name).empty() && mechanism->clearances() > 0 && !cut_short)
        predictability = measure_predictability(mechanism, mechanism->parameters());
      if (!cut_short) measured = step_error(*rung, mechanism->parameters(), options, result, progress);
      cut_short = cut_short || interrupted();
      if (measured.measured) result.error.discretisation = relative_step_error(measured, result.index, index);
      if (const std::string warning = steps_mislead(measured, result.index, index, mechanism->characteristic_length(),
                                                    mechanism->clearances() > 0 || has_errors(mechanism->parameters()));
          !warning.empty())
        result.warnings.push_back(warning);
      if (const ModelErrorSaid said = model_error_said(result, index, mechanism->characteristic_length());
          !cut_short && !said.warning.empty())
        result.warnings.push_back(said.warning);
      // Of the others that are printed, where they are not worth printing.
      for (const char* quantity : {"position_error", "orientation_error", "boresight_error"}) {
        const IndexChoice other{quantity, index.statistic};
        const ModelErrorSaid said = model_error_said(result, other, mechanism->characteristic_length());
        if (quantity != index.quantity && !cut_short && !said.warning.empty() &&
            result.error.model_of(other.kind()) > kOfAnother)
          result.warnings.push_back(said.warning);
      }
    } catch (const Interrupted&) {  // the motion itself is there, and is kept
      cut_short = interrupted();
    }
    if (cut_short && !result.interrupted)
      result.warnings.push_back(
          "interrupted after the motion: what compares it, or measures its steps, is not all there");

    Json summary = summary_of(command, *mechanism, choice, result, others, axes, predictability, measured, index, watch,
                              cut_short, out);
    report::Document document =
        run_report(command, *mechanism, choice, rung->leaves_out(), result, others, axes, predictability, measured,
                   step_error_sentence(measured, result.index, index, mechanism->characteristic_length()));
    for (const std::string& warning : material_warnings(assumed_by(command, *mechanism)))
      document.warnings.push_back(warning);
    const auto accuracy = cut_short ? std::optional<AccuracyAsked>{} : accuracy_asked(command, choice, result, index);
    if (accuracy) summary["accuracy"] = accuracy_json(*accuracy);
    if (parts) {
      summary["parts"] = parts_json(*parts);
      summary["files"].push_back("parts.csv");
      out.write("parts.csv", [&](std::ostream& s) { write_parts(s, *parts, result, finer); });
      document.sections.insert(document.sections.begin() + 1, parts_section(*parts, *mechanism, result));
    }
    if (period > 0.0) {
      const NonlinearAnalysis nonlinear = analyse_nonlinear(*mechanism, result, period);
      summary["nonlinear"] = nonlinear_json(nonlinear);
      summary["files"].push_back("poincare.csv");
      out.write("poincare.csv", [&](std::ostream& s) { write_section(s, nonlinear); });
      document.sections.insert(document.sections.begin() + 1, nonlinear_section(nonlinear, *mechanism));
    }
    write_json(out, "summary.json", summary);
    out.write("timeseries.csv", [&](std::ostream& s) { write_timeseries(s, *mechanism, result, finer); });
    out.write("events.csv", [&](std::ostream& s) { write_events(s, *mechanism, result); });
    write_report(out, document);
    out.publish();
    progress.clear();
    if (!command.quiet)
      print(command, *mechanism, choice, result, others, axes, predictability, measured, parts, index, accuracy, out);
    if (cut_short) return kInterrupted;
    return accuracy && !accuracy->met() ? kAnswerIsNo : status_with_accuracy(choice, kDone);
  }

 private:
  // One sample of a Monte Carlo study is its mechanism with the sample's values set.
  Command replay_of(const Command& asked) {
    double number = 0.0;
    if (!parse_number(sample_number_, number) || number < 0.0 || number != std::floor(number) || number > 1e15)
      throw InputError({"command line", 0}, "--sample-number", in_quotes(sample_number_), "a sample's number, from 0");
    if (!index_.empty())
      throw InputError({"command line", 0}, "--index", in_quotes(index_),
                       "none: a study says itself what is asked, in [index]");
    const MonteCarloQuestion question = read_montecarlo_question(asked.file, asked.settings);
    if (!question.plan.tail && !question.plan.fidelities && number >= static_cast<double>(question.plan.samples))
      throw InputError(
          {"command line", 0}, "--sample-number", in_quotes(sample_number_),
          fmt::format("one of the study's {} samples, from 0 to {}", question.plan.samples, question.plan.samples - 1));
    Command command = asked;
    command.file = question.study.mechanism_file;
    replayed_as_ = std::filesystem::path(asked.file).stem().string() + "-sample-" + sample_number_;
    for (const Setting& setting : question.settings_of_sample(static_cast<std::uint64_t>(number)))
      command.settings.push_back(setting);
    // Its numbers, and not another drawing: a body's mass that is elsewhere leaves the body where it is.
    Parameters parameters = question.mechanism->parameters();
    const std::vector<double> values = question.values_of_sample(static_cast<std::uint64_t>(number));
    for (std::size_t i = 0; i < values.size(); ++i)
      for (const ParameterPath& place : question.plan.inputs.parameters[i].places) place.set(parameters, values[i]);
    replayed_ = question.mechanism->with(std::move(parameters));
    if (!command.accuracy && asked.rung == "auto") command.accuracy = question.study.accuracy;
    index_ = question.study.index.quantity + "." + question.study.index.statistic;
    replayed_start_ = question.study.index.start;
    return command;
  }

  // A rung that cannot follow the motion says why, and the others go on.
  static Compared run_other(const std::string& name, const std::shared_ptr<const Mechanism>& mechanism,
                            RunOptions options, double step) {
    Compared other{.rung = name, .result = {}, .refusal = ""};
    options.step = step;
    if (name != "multibody") options.formulation = options.stabilisation = "";
    options.integrator = "";
    options.tolerance = 0.0;
    options.pose_bodies.clear();
    options.frame_spacing = 0.0;
    try {
      other.result = make_rung(name, mechanism)->run(mechanism->parameters(), options);
    } catch (const ComputationError& failure) {
      other.refusal = failure.what();
    }
    if (other.result.interrupted) throw Interrupted{};  // a part of a motion compares to nothing
    return other;
  }

  void check_step_error() const {
    for (const char* known : {"auto", "on", "off"})
      if (step_error_ == known) return;
    throw InputError({"command line", 0}, "--step-error", in_quotes(step_error_), "auto, on or off");
  }

  MeasuredError step_error(const Rung& rung, const Parameters& parameters, const RunOptions& options,
                           const RunResult& result, Progress& progress) const {
    if (step_error_ == "off") {
      MeasuredError off;
      off.why_not = "--step-error off";
      return off;
    }
    MeasureErrorOptions how;
    if (step_error_ == "on") how.most_seconds = 0.0;
    how.advance = [&] {
      progress.update(result.end_time, "measuring what the steps do");
      return !interrupted();
    };
    return measure_discretisation(rung, parameters, options, result, how);
  }

  MotionOptions motion_;
  std::string step_error_ = "auto";
  bool compare_ = false;
  std::string index_, nonlinear_, start_;
  double replayed_start_ = 0.0;  // of a study's index [s]
  std::optional<Mechanism> replayed_;
  std::string sample_number_, replayed_as_;
};

}  // namespace

std::unique_ptr<Verb> make_run_verb() { return std::make_unique<RunVerb>(); }

}  // namespace boresight::app
