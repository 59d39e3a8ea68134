// How a motion is followed: the options of every verb that follows one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "boresight/keys/units.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "command_line/command.hpp"
#include "command_line/option_range.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

void refuse_longer_than_motion(const char* option, const std::string& text, double time, const Mechanism& mechanism) {
  if (time > mechanism.duration())
    throw InputError(kCommandLine, option, in_quotes(text),
                     fmt::format("at most the motion's duration, {:g} s", mechanism.duration()));
}

// A pure number may stand alone.
double share_of_clearance(const std::string& text) {
  double number = 0.0;
  const bool pure = parse_number(text, number);
  try {
    return quantity_between("--tolerance", pure ? fmt::format("{:.17g} %", 100.0 * number) : text,
                            {kRatio, "1e-12 %", "100 %"});
  } catch (const InputError& error) {
    throw InputError(error.origin, error.key, pure ? in_quotes(text) : error.found, error.expected, error.nearest);
  }
}

}  // namespace

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
                 "rk4, dopri5, rosenbrock or (multibody) generalized-alpha; otherwise the rung's own choice: rk4, or "
                 "rosenbrock "
                 "where rk4's steps do not follow the motion")
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
  refuse_longer_than_motion("--sample", sample, options.sample_spacing, mechanism);
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

void MotionOptions::refuse_unread(const std::string& rung, const std::vector<std::string>& read_besides) const {
  if (rung == "auto") return;  // that chooses by them
  for (const auto& [option, text] : {std::pair{"step", &step},
                                     {"integrator", &integrator},
                                     {"tolerance", &tolerance},
                                     {"formulation", &formulation},
                                     {"stabilisation", &stabilisation}}) {
    if (text->empty() || std::find(read_besides.begin(), read_besides.end(), option) != read_besides.end()) continue;
    if (const std::string why = why_unread(option, rung); !why.empty())
      throw InputError(kCommandLine, std::string("--") + option, in_quotes(*text), "none: " + why);
  }
}

RunOptions MotionOptions::run_options(const Mechanism& mechanism, const std::string& rung,
                                      const std::vector<std::string>& read_besides) const {
  refuse_unread(rung, read_besides);
  RunOptions options;
  if (!step.empty()) {
    constexpr double kMostSteps = 1e11;
    options.step = quantity_between("--step", step, {kDuration, "1e-12 s", "1e9 s"});
    refuse_longer_than_motion("--step", step, options.step, mechanism);
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
  options.integrator = integrator;
  if (!tolerance.empty()) {
    options.tolerance = share_of_clearance(tolerance);
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

std::string MotionOptions::model_text(const std::string& rung) const {
  std::string text;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty() && why_unread(option, rung).empty())
      text += std::string(" --") + option + " " + shell_word(value);
  };
  add("integrator", integrator);
  add("tolerance", tolerance);
  add("formulation", formulation);
  add("stabilisation", stabilisation);
  return text;
}

nlohmann::json MotionOptions::identity() const {
  return {{"step", step},           {"sample", sample},           {"integrator", integrator},
          {"tolerance", tolerance}, {"formulation", formulation}, {"stabilisation", stabilisation},
          {"pose", poses}};
}

}  // namespace boresight::app
