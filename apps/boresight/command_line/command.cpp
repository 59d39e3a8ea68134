#include "command_line/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <thread>

#include "boresight/keys/value_fault.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "command_line/option_range.hpp"
#include "command_line/verb.hpp"
#include "terminal/embedding.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

const Origin kCommandLine{"command line", 0};

std::string in_quotes(const std::string& text) { return "\"" + text + "\""; }

// Where a joint is or points, and where a body has its centre: what the ideal motion is made of.
bool changes_drawing(const std::string& path) {
  const auto has = [&](const char* part) { return path.find(part) != std::string::npos; };
  return (path.starts_with("joint.") && (has(".point") || has(".axis") || has(".second_axis"))) ||
         (path.starts_with("body.") && has(".center_of_mass"));
}

}  // namespace

int failed(const Command& command, const std::string& reason) {
  if (const Embedding* host = embedding())
    host->failed(reason);
  else if (command.quiet)
    fmt::print(stderr, "boresight: {}\n", reason);
  return kFailed;
}

double positive_quantity(const std::string& option, const std::string& text, const SiUnit& unit) {
  double value = 0.0;
  try {
    value = parse_quantity(text, unit);
  } catch (const ValueFault& fault) {
    throw InputError(kCommandLine, option, fault.found, fault.expected, fault.nearest);
  }
  if (value <= 0.0) throw InputError(kCommandLine, option, in_quotes(text), "more than 0");
  return value;
}

double quantity_between(const std::string& option, const std::string& text, const PhysicalRange& range) {
  const double value = positive_quantity(option, text, range.unit);
  if (!holds(range, value)) throw InputError(kCommandLine, option, in_quotes(text), in_words(range));
  return value;
}

void CommandOptions::declare(CLI::App& app, const Verb& verb) {
  const std::vector<std::string> unused = verb.unused_options();
  const auto used = [&](const char* name) { return std::find(unused.begin(), unused.end(), name) == unused.end(); };
  app.add_option(verb.operand(), file, verb.operand_is())->required(verb.needs_file())->type_name("");
  if (used("--set"))
    app.add_option(
           "--set", settings,
           "change a value of the mechanism: clearance.F1.radial=0.2mm (any number of times). A joint's point or "
           "axis and a body's centre change the drawing, and with it what the drives are told; a part that is "
           "built otherwise than drawn is an [[error]]: error.NAME=20um")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false)
        ->take_all();
  if (used("--out")) app.add_option("--out", out, "where results go; otherwise results/FILE-VERB")->type_name("DIR");
  if (used("--rung"))
    app.add_option("--rung", rung, "auto, envelope, quasistatic, perturbation or multibody: how much physics")
        ->type_name("NAME")
        ->capture_default_str();
  if (used("--accuracy"))
    app.add_option("--accuracy", accuracy, "wanted of the index, e.g. \"1 %\"; chooses the rung")->type_name("SHARE");
  if (used("--jobs")) app.add_option("--jobs", jobs, "threads; otherwise as many as there are cores")->type_name("N");
  if (used("--quiet")) app.add_flag("--quiet", quiet, "no progress, no summary on the terminal");
  if (used("--json")) app.add_flag("--json", json, verb.json_is());
}

Command CommandOptions::command(const std::string& verb) const {
  Command command;
  command.verb = verb;
  command.file = file;
  command.out = out;
  command.rung = rung;
  command.quiet = quiet || json;
  command.json = json;
  for (const std::string& text : settings) command.settings.push_back(parse_setting(text));
  if (!command.quiet)
    for (const Setting& setting : command.settings)
      if (changes_drawing(setting.path))
        tell(
            "  {} changes the drawing, ideal and built alike; for a part that is built off, see boresight help error\n",
            setting.path);
  if (!accuracy.empty()) command.accuracy = quantity_between("--accuracy", accuracy, {kRatio, "0.0001 %", "100 %"});
  if (jobs && (*jobs < 1 || *jobs > 4096))
    throw InputError(kCommandLine, "--jobs", std::to_string(*jobs), "1 to 4096 threads");
  command.jobs = jobs ? *jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return command;
}

void MotionOptions::declare(CLI::App& app, bool with_poses) {
  keeps_histories_ = true;
  sample_option_ =
      app.add_option("--sample", sample, "spacing of the time series; of a long motion wider, unless given")
          ->type_name("TIME")
          ->capture_default_str();
  declare_model(app);
  if (with_poses)
    app.add_option("--pose", poses, "keep the pose of this body too (any number of times)")
        ->type_name("BODY")
        ->allow_extra_args(false)
        ->take_all();
}

void MotionOptions::declare_model(CLI::App& app) {
  app.add_option("--step", step, "step of the integration; otherwise the rung's own choice")->type_name("TIME");
  app.add_option("--integrator", integrator,
                 "rk4, dopri5, rosenbrock or (multibody) generalized-alpha; otherwise the rung's own, rk4")
      ->type_name("NAME");
  app.add_option("--tolerance", tolerance,
                 "of error control (any integrator but rk4; rosenbrock unless --integrator names another): error of "
                 "one step over the smallest "
                 "clearance, as 1e-3 or \"0.1 %\"; otherwise the rung's own")
      ->type_name("NUMBER");
  app.add_option("--formulation", formulation, "of the equations of motion (multibody): tree or paper; otherwise tree")
      ->type_name("NAME");
  app.add_option("--stabilisation", stabilisation,
                 "of the constraints (multibody): baumgarte or projection; otherwise the formulation's own")
      ->type_name("NAME");
}

void MotionOptions::set_sample_spacing(RunOptions& options, const Mechanism& mechanism, double most_samples) const {
  options.sample_spacing = quantity_between("--sample", sample, {kDuration, "1e-12 s", "1e9 s"});
  constexpr double kMostBytes = 2e9;
  // Of every sample, the boresight body's and each --pose body's history and every clearance's.
  const double bytes_of_sample = sizeof(double) + sizeof(PoseSample) * (1.0 + static_cast<double>(poses.size())) +
                                 sizeof(ClearanceSample) * mechanism.clearances();
  if (sample_option_ == nullptr || sample_option_->count() == 0) {
    constexpr double kOfLongMotion = 2e5;
    const double samples = mechanism.duration() / options.sample_spacing;
    if (samples > most_samples || samples * bytes_of_sample > kMostBytes)
      options.sample_spacing = mechanism.duration() / std::min(kOfLongMotion, kMostBytes / bytes_of_sample);
    return;
  }
  if (mechanism.duration() / options.sample_spacing > most_samples)
    throw InputError(kCommandLine, "--sample",
                     in_quotes(sample) + " for a motion of " + readable(mechanism.duration(), "s"),
                     "at most two million samples in all: a larger --sample, or a shorter motion.duration");
  const double bytes = mechanism.duration() / options.sample_spacing * bytes_of_sample;
  if (bytes > kMostBytes)
    throw InputError(kCommandLine, "--sample",
                     fmt::format("{}, {:.2g} GB of histories", in_quotes(sample), 1e-9 * bytes),
                     "at most 2 GB: a wider spacing, or fewer --pose");
}

RunOptions MotionOptions::run_options(const Mechanism& mechanism, const std::string& rung) const {
  RunOptions options;
  if (!step.empty()) {
    constexpr double kMostSteps = 1e11;
    options.step = quantity_between("--step", step, {kDuration, "1e-12 s", "1e9 s"});
    if (options.step > mechanism.duration())
      throw InputError(kCommandLine, "--step", in_quotes(step),
                       fmt::format("at most the motion's duration, {:g} s", mechanism.duration()));
    if (mechanism.duration() / options.step > kMostSteps)
      throw InputError(kCommandLine, "--step",
                       fmt::format("{}, {:.2g} steps", in_quotes(step), mechanism.duration() / options.step),
                       "at most 1e11 steps in all");
  }
  constexpr double kMostSamples = 2e6;
  if (keeps_histories_)
    set_sample_spacing(options, mechanism, kMostSamples);
  else  // no option of this verb: as fine as by default, and no finer than memory holds
    options.sample_spacing = std::max(1e-3, mechanism.duration() / kMostSamples);
  const std::vector<std::string> known = integrator_names(rung);
  if (!integrator.empty() && rung != "auto" && known.empty())
    throw InputError(kCommandLine, "--integrator", in_quotes(integrator), "none: the " + rung + " rung takes no steps");
  options.integrator = integrator;
  if (!tolerance.empty()) {
    // A pure number may stand alone.
    double number = 0.0;
    options.tolerance = quantity_between(
        "--tolerance", parse_number(tolerance, number) ? fmt::format("{:.17g} %", 100.0 * number) : tolerance,
        {kRatio, "1e-12 %", "100 %"});
    if (!step.empty()) throw InputError(kCommandLine, "--tolerance", in_quotes(tolerance), "this or --step, not both");
    // Alone it asks for error control, and this is the method that every rung with steps has, the lanes included.
    if (integrator.empty()) options.integrator = "rosenbrock";
  }
  options.formulation = formulation;
  options.stabilisation = stabilisation;
  for (const std::string& name : poses) {
    const int body = mechanism.body_index(name);
    if (body < 0) {
      std::vector<std::string> names;
      for (const BodyDescription& b : mechanism.description().bodies) names.push_back(b.name);
      throw InputError(kCommandLine, "--pose", in_quotes(name), "a body of the mechanism", nearest_name(name, names));
    }
    options.pose_bodies.push_back(body);
  }
  check_run_options(options, rung == "auto" ? rung_names().back() : rung, mechanism);
  return options;
}

void check_run_options(const RunOptions& options, const std::string& rung, const Mechanism& mechanism) {
  with_options_checked([&] { check_options(options, rung, mechanism, mechanism.parameters()); });
}

bool MotionOptions::asks_for_multibody() const {
  return !formulation.empty() || !stabilisation.empty() || integrator == "generalized-alpha";
}

std::size_t history_refinement(double duration, double sample_spacing) {
  return static_cast<std::size_t>(std::clamp(std::floor(20000.0 * sample_spacing / duration), 1.0, 10.0));
}

nlohmann::json MotionOptions::model_identity() const {
  return {{"step", step},
          {"integrator", integrator},
          {"tolerance", tolerance},
          {"formulation", formulation},
          {"stabilisation", stabilisation}};
}

std::string MotionOptions::model_text() const {
  std::string text;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) text += std::string(" ") + option + " " + shell_word(value);
  };
  add("--integrator", integrator);
  add("--tolerance", tolerance);
  add("--formulation", formulation);
  add("--stabilisation", stabilisation);
  return text;
}

nlohmann::json MotionOptions::identity() const {
  return {{"step", step},           {"sample", sample},           {"integrator", integrator},
          {"tolerance", tolerance}, {"formulation", formulation}, {"stabilisation", stabilisation},
          {"pose", poses}};
}

IndexChoice index_named(const std::string& option, const std::string& text) {
  const std::size_t dot = text.find('.');
  IndexChoice index{text.substr(0, dot), dot == std::string::npos ? "" : text.substr(dot + 1)};
  try {
    index.of(PointingIndices{});
  } catch (const std::out_of_range&) {
    throw InputError(kCommandLine, option, in_quotes(text), "a quantity and a statistic, like boresight_error.rms");
  }
  return index;
}

nlohmann::json identity_of(const Command& command, const std::string& mechanism_hash, const std::string& study_hash,
                           const nlohmann::json& options) {
  nlohmann::json settings = nlohmann::json::array();
  for (const Setting& setting : command.settings) settings.push_back(setting.path + "=" + setting.value);
  nlohmann::json identity = {{"verb", command.verb},
                             {"mechanism", mechanism_hash},
                             {"settings", settings},
                             {"rung", command.rung},
                             {"options", options}};
  if (!study_hash.empty()) identity["study"] = study_hash;
  if (command.accuracy) identity["accuracy"] = *command.accuracy;
  return identity;
}

}  // namespace boresight::app
