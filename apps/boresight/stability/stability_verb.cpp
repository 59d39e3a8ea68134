// boresight stability MECHANISM: where the methods fail, measured on this mechanism beside theory.
#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/stability/stability.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/summary.hpp"
#include "results/tables.hpp"
#include "stability/stability_report.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

// Infinity has no number in JSON or CSV.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

void write_limits(std::ostream& out, const StabilityResult& result) {
  out << "method,motion,alpha_over_beta,theory,measured\n";
  for (const AxisLimit& l : result.limits)
    out << csv_field(l.method) << ',' << l.axis << ",," << exact(l.theory) << ',' << exact(l.measured) << '\n';
  for (const BaumgarteLimit& l : result.baumgarte.limits)
    out << "RK4,Baumgarte," << exact(l.zeta) << ',' << exact(l.theory) << ',' << exact(l.measured) << '\n';
}

void write_growth(std::ostream& out, const StabilityResult& result) {
  out << "method,frequency,step,growth\n";
  for (const GrowthMap& map : result.growth)
    for (std::size_t i = 0; i < map.step.size(); ++i)
      for (std::size_t k = 0; k < map.frequency.size(); ++k)
        out << csv_field(map.method) << ',' << exact(map.frequency[k]) << ',' << exact(map.step[i]) << ','
            << exact(map.growth[i][k]) << '\n';
}

void write_baumgarte(std::ostream& out, const BaumgarteMap& map) {
  out << "alpha_h,beta_h,measured,theory\n";
  for (std::size_t i = 0; i < map.measured.size(); ++i)
    for (std::size_t k = 0; k < map.alpha_h.size(); ++k)
      out << exact(map.alpha_h[k]) << ',' << exact(map.beta_h[i]) << ',' << exact(map.measured[i][k]) << ','
          << exact(map.theory[i][k]) << '\n';
}

void write_steps(std::ostream& out, const StepMap& map) {
  out << "frequency,step,error,outcome\n";
  for (std::size_t i = 0; i < map.step.size(); ++i)
    for (std::size_t k = 0; k < map.frequency.size(); ++k) {
      const double error = map.error[i][k];
      out << exact(map.frequency[k]) << ',' << exact(map.step[i]) << ',' << (std::isfinite(error) ? exact(error) : "")
          << ','
          << (std::isinf(error)   ? "stopped"
              : std::isnan(error) ? "not tried"
                                  : "done")
          << '\n';
    }
}

void write_cases(std::ostream& out, const StabilityResult& result) {
  out << "case,happens,program,standing,measured\n";
  for (const FailureCase& c : result.cases)
    out << csv_field(c.name) << ',' << csv_field(c.happens) << ',' << csv_field(c.program) << ','
        << to_string(c.standing) << ',' << csv_field(c.measured) << '\n';
}

void write_horizon(std::ostream& out, const StabilityResult& result) {
  out << "difference,t,distance\n";
  for (const Separation& s : result.separations)
    for (std::size_t k = 0; k < s.time.size(); ++k)
      out << exact(s.start) << ',' << exact(s.time[k]) << ',' << exact(s.distance[k]) << '\n';
}

Json settling_json(const Settling& s) {
  return {{"method", s.method},
          {"completed", s.completed},
          {"steps", s.steps},
          {"rejected_steps", s.rejected},
          {"evaluations", s.evaluations},
          {"contacts", s.contacts},
          {"settled_at", s.settled_at >= 0.0 ? Json(s.settled_at) : Json()},
          {"mean_step_times_frequency", s.mean_step_settled},
          {"largest_step_times_frequency", s.largest_step_settled}};
}

Json summary_of(const Command& command, const Mechanism& mechanism, const StabilityResult& result,
                const Stopwatch& watch, const OutputDirectory& out) {
  Json json = common_summary(command, mechanism, {.name = "several", .why = "each part says which"}, watch,
                             result.warnings, result.interrupted, out);
  json["largest_difference_from_theory"] = finite(result.largest_difference());
  json["limits"] = Json::array();
  for (const AxisLimit& l : result.limits)
    json["limits"].push_back(
        {{"method", l.method}, {"motion", l.axis}, {"theory", l.theory}, {"measured", finite(l.measured)}});
  json["baumgarte"] = {{"joint", result.baumgarte.joint},
                       {"map_largest_difference", result.baumgarte.largest_difference},
                       {"limits", Json::array()}};
  for (const BaumgarteLimit& l : result.baumgarte.limits)
    json["baumgarte"]["limits"].push_back(
        {{"alpha_over_beta", l.zeta}, {"theory", l.theory}, {"measured", finite(l.measured)}});
  json["settled"] = Json::array();
  for (const SettledStep& s : result.settled)
    json["settled"].push_back(
        {{"frequency", s.frequency}, {"explicit", settling_json(s.pair)}, {"l_stable", settling_json(s.l_stable)}});
  json["steps"] = {{"rung", result.steps.rung}, {"index", result.steps.index}, {"columns", Json::array()}};
  for (std::size_t k = 0; k < result.steps.frequency.size(); ++k)
    json["steps"]["columns"].push_back(
        {{"frequency", result.steps.frequency[k]},
         {"smallest_step_stopped", result.steps.refused_above[k] > 0.0 ? Json(result.steps.refused_above[k]) : Json()},
         {"scatter", finite(result.steps.scatter[k])}});
  json["horizon"] = Json::array();
  for (const Separation& s : result.separations)
    json["horizon"].push_back({{"difference", s.start},
                               {"horizon", s.horizon >= 0.0 ? Json(s.horizon) : Json()},
                               {"rms_difference", s.rms_difference},
                               {"max_difference", s.max_difference}});
  json["cases"] = Json::array();
  for (const FailureCase& c : result.cases)
    json["cases"].push_back({{"case", c.name},
                             {"happens", c.happens},
                             {"program", c.program},
                             {"standing", to_string(c.standing)},
                             {"measured", c.measured}});
  json["files"] = {"summary.json", "limits.csv", "growth.csv",  "steps.csv",  "baumgarte.csv",
                   "horizon.csv",  "cases.csv",  "report.html", "report.json"};
  return json;
}

void print(const Command& command, const Mechanism& mechanism, const StabilityResult& result,
           const OutputDirectory& out) {
  tell("{}: where the methods fail{}\n", mechanism.name(), result.interrupted ? " (interrupted)" : "");
  for (const AxisLimit& l : result.limits)
    if (l.method == "RK4")
      tell("  RK4, {:<10} step limit {:.5g} measured, {:.5g} in theory\n", l.axis + ":", l.measured, l.theory);
  if (!result.baumgarte.limits.empty())
    tell("  Baumgarte: {} limits on the drift of {}; {}\n", result.baumgarte.limits.size(), result.baumgarte.joint,
         std::isinf(result.largest_difference())
             ? std::string("not all limits are where theory has them, nor near")
             : fmt::format("all limits within {} of theory", relative_text(result.largest_difference())));
  for (const FailureCase& c : result.cases) tell("  {:<8} {}: {}\n", to_string(c.standing), c.name, c.measured);
  tell_warnings(result.warnings, command, mechanism);
  tell("  report: {}\n", (out.path() / "report.html").string());
}

class StabilityVerb : public Verb {
 public:
  std::string name() const override { return "stability"; }
  std::string file_kind() const override { return "mechanism"; }
  std::string summary() const override {
    return "where the methods fail: maps over step, contact frequency and gains, and every known case";
  }
  std::string example() const override { return "boresight stability antenna/mechanism.toml"; }
  std::string next(const Command& command, bool) const override {
    return "boresight chart " + shell_word(command.file) + ": how accurate and how fast the methods are";
  }
  std::vector<std::string> unused_options() const override { return {"--rung", "--accuracy"}; }

  int execute(const Command& command) override {
    const Stopwatch watch;
    const auto mechanism = std::make_shared<const Mechanism>(read_mechanism(command.file, command.settings));
    const OutputDirectory out =
        OutputDirectory::open(command.out, command.verb, command.file,
                              identity_of(command, mechanism->description().content_hash, "", Json::object()));
    Progress progress(command.quiet, 100.0, "%");
    StabilityOptions options;
    options.progress = [&](double share, const std::string& what) {
      progress.update(100.0 * share, what);
      return !interrupted();
    };
    options.reread = trial_of(command.file, command.settings);
    const StabilityResult result = find_stability(mechanism, options);

    write_json(out, "summary.json", summary_of(command, *mechanism, result, watch, out));
    out.write("limits.csv", [&](std::ostream& s) { write_limits(s, result); });
    out.write("growth.csv", [&](std::ostream& s) { write_growth(s, result); });
    out.write("steps.csv", [&](std::ostream& s) { write_steps(s, result.steps); });
    out.write("baumgarte.csv", [&](std::ostream& s) { write_baumgarte(s, result.baumgarte); });
    out.write("horizon.csv", [&](std::ostream& s) { write_horizon(s, result); });
    out.write("cases.csv", [&](std::ostream& s) { write_cases(s, result); });
    write_report(out, stability_report(command, *mechanism, result));
    out.publish();
    progress.clear();
    if (!command.quiet) print(command, *mechanism, result, out);
    if (result.interrupted) return kInterrupted;
    return as_foreseen(result) ? kDone : kAnswerIsNo;
  }
};

}  // namespace

std::unique_ptr<Verb> make_stability_verb() { return std::make_unique<StabilityVerb>(); }

}  // namespace boresight::app
