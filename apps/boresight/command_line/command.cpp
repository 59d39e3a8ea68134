#include "command_line/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "boresight/mechanism/error.hpp"
#include "command_line/option_range.hpp"
#include "command_line/verb.hpp"
#include "terminal/embedding.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

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
  if (used("--out")) app.add_option("--out", out, verb.out_is())->type_name("DIR");
  if (used("--rung"))
    app.add_option("--rung", rung, "auto, envelope, quasistatic, perturbation or multibody: how much physics")
        ->type_name("NAME")
        ->capture_default_str();
  if (used("--accuracy"))
    app.add_option("--accuracy", accuracy,
                   "wanted of the index, e.g. \"1 %\"; chooses the rung where --rung names none")
        ->type_name("SHARE");
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
  command.jobs = jobs.empty() ? static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))
                              : static_cast<int>(whole_number("--jobs", jobs, 1, 4096));
  return command;
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
