// boresight sweep STUDY: the same motion over a grid of parameters.
#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/study/study.hpp"
#include "boresight_analyses/sweep/sweep.hpp"
#include "boresight_analyses/sweep/sweep_keys.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "report_parts/step_error_parts.hpp"
#include "results/assumed.hpp"
#include "results/motion_claims.hpp"
#include "results/report_files.hpp"
#include "results/scatter_parts.hpp"
#include "results/tables.hpp"
#include "results/verb_study.hpp"
#include "sweep/sweep_report.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

// Histories are for the overlaid charts; beyond this many points nobody could read them, and they would fill
// the memory.
constexpr std::size_t kMostPointsWithHistories = 8;

Json point_json(const Study& study, const SweepPlan& plan, const SweepPoint& p) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < plan.axes.size(); ++i)
    for (const std::string& path : plan.axes[i].parameters) parameters[path] = p.values[i];
  Json json = {{"parameters", parameters}, {"status", to_string(p.status)}};
  if (p.status == SweepPoint::Status::failed) json["failure"] = p.failure;
  if (p.status == SweepPoint::Status::done) {
    json["index"] = index_json(p.result.index);
    json["contact"] = contact_json(p.result.contact);
    json["platform_acceleration_max"] = vector_json(p.result.platform_acceleration_max);
    json["constraint_drift"] = p.result.constraint_drift;
    json["error_estimate"] = {{"model", number_json(p.result.error.model_of(study.index.kind()))},
                              {"of", study.index.quantity + "." + study.index.statistic},
                              {"basis", p.result.error.basis}};
    json["warnings"] = p.result.warnings;
    json["cpu_seconds"] = p.result.cost.cpu_seconds;
  }
  return json;
}

void write_sweep(std::ostream& out, const Study& study, const SweepPlan& plan, const Mechanism& mechanism,
                 const SweepResult& result) {
  std::string header = "point";
  for (const SweepAxis& axis : plan.axes)
    for (const std::string& path : axis.parameters) header += "," + csv_field(path);
  for (const QuantityName& quantity : quantity_names())
    for (const StatisticName& statistic : statistic_names())
      header += fmt::format(",{}.{}", quantity.name, statistic.name);
  header += ",acceleration_max_x,acceleration_max_y,acceleration_max_z,constraint_drift";
  for (int c = 0; c < mechanism.clearances(); ++c)
    for (const char* name : {"contact_fraction", "impacts", "max_penetration", "max_force", "max_impact_speed",
                             "impact_speed_above_validity"})
      header += "," + csv_field(joint_of_clearance(mechanism, c) + "." + name);
  out << header << ",status,model_error\n";

  for (std::size_t k = 0; k < result.points.size(); ++k) {
    const SweepPoint& p = result.points[k];
    std::string row = std::to_string(k + 1);
    const bool done = p.status == SweepPoint::Status::done;
    // A point that was not done has no numbers, rather than zeros.
    const auto add = [&](double value) { row += "," + (done ? exact(value) : std::string()); };
    for (std::size_t i = 0; i < plan.axes.size(); ++i)
      for (std::size_t n = 0; n < plan.axes[i].parameters.size(); ++n) row += "," + exact(p.values[i]);
    for (const QuantityName& quantity : quantity_names())
      for (const StatisticName& statistic : statistic_names())
        if (quantity.kind == PointingQuantity::line_of_sight_error && !p.result.index.has_line_of_sight)
          row += ",";  // without a target there is none
        else
          add(p.result.index.*quantity.statistics.*statistic.value);
    for (int a = 0; a < 3; ++a) add(p.result.platform_acceleration_max[a]);
    add(p.result.constraint_drift);
    for (int c = 0; c < mechanism.clearances(); ++c) {
      const ContactSummary s = done ? p.result.contact[static_cast<std::size_t>(c)] : ContactSummary{};
      add(s.contact_fraction);
      add(static_cast<double>(s.impacts));
      add(s.max_penetration);
      add(s.max_force);
      add(s.max_impact_speed);
      add(static_cast<double>(s.impact_speed_above_validity));
    }
    row += ',' + csv_field(to_string(p.status));
    add(p.result.error.model_of(study.index.kind()));
    out << row << '\n';
  }
}

void print(const Command& command, const Study& study, const SweepPlan& plan, const Mechanism& mechanism,
           const SweepResult& result, const OutputDirectory& out) {
  tell("{}: {} points{}; index: {}\n", mechanism.name(), result.points.size(),
       result.interrupted ? " (interrupted; the same command goes on)" : "", study.index.title());
  constexpr std::size_t kShown = 20;
  for (std::size_t k = 0; k < std::min(kShown, result.points.size()); ++k) {
    const SweepPoint& p = result.points[k];
    if (p.status == SweepPoint::Status::done)
      tell("  {}: index {}, position error max {}, RMS {}\n", point_name(plan, p, true),
           readable(study.index.of(p.result.index), study.index.si_unit()),
           readable(p.result.index.position_error.max, "m"), readable(p.result.index.position_error.rms, "m"));
    else
      tell("  {}: {}{}\n", point_name(plan, p, true), to_string(p.status), p.failure.empty() ? "" : ": " + p.failure);
  }
  if (result.points.size() > kShown) tell("  and {} more in sweep.csv\n", result.points.size() - kShown);
  tell_warnings(told_of_points(plan, result), command, mechanism);
  tell("  report: {}\n", (out.path() / "report.html").string());
}

class SweepVerb : public Verb {
 public:
  std::string name() const override { return "sweep"; }
  std::string file_kind() const override { return "study"; }
  const KeyTable* study_table() const override { return &sweep_keys(); }
  std::string summary() const override { return "the index over a grid of parameters"; }
  std::string example() const override { return "boresight sweep antenna/sweep.toml"; }
  std::string next(const Command&, bool) const override {
    return "boresight help sensitivity: which parameter's scatter matters";
  }
  void declare_options(CLI::App& app) override { motion_.declare(app, false); }

  int execute(const Command& command) override {
    const Stopwatch watch;
    StudyInput input(command.file, command.settings);
    const Study& study = input.study;
    const std::shared_ptr<const Mechanism>& mechanism = input.mechanism;
    const SweepPlan plan = read_sweep_plan(input.root, mechanism->description(), input.trial, input.trial_all);
    check_rung_name(command.rung);
    SweepOptions options;
    options.run = motion_.run_options(*mechanism, command.rung);
    options.run.start = study.index.start;
    options.jobs = command.jobs;
    const VerbStudy own(
        command, mechanism, study.index, study.accuracy, options.run,
        identity_of(command, mechanism->description().content_hash, study.content_hash, motion_.identity()));
    const OutputDirectory& out = own.out();
    const bool histories = plan.points() <= kMostPointsWithHistories;
    options.run.sample_spacing =
        histories ? options.run.sample_spacing /
                        static_cast<double>(history_refinement(mechanism->duration(), options.run.sample_spacing))
                  : 0.0;
    options.run.events = histories;

    Unfinished begun = own.run().go_on([&] {
      const std::vector<Parameters> tried = tried_points(plan, *mechanism);
      RungChoice chosen = own.run().choose_rung({.wants_multibody = motion_.asks_for_multibody(), .integrators = true},
                                                kPilotTrials, tried);
      if (chosen.pilot && tried.size() < plan.points())
        chosen.why += fmt::format("; tried at {} of {} points", tried.size(), plan.points());
      return chosen;
    });
    const RungChoice& choice = begun.rung;
    apply(choice, options.run);
    options.kept = begun.results.get();

    const std::unique_ptr<Stage> stage = own.run().stage(static_cast<double>(plan.points()), "points");
    options.progress = [&](const SweepProgress& p) {
      stage->update(p.done, "largest position error so far " + readable(p.position_error_max_so_far, "m"));
      return !interrupted();
    };
    const std::unique_ptr<Rung> rung = make_rung(choice.name, mechanism);
    SweepResult result = run_sweep(*rung, *mechanism, plan, options);
    for (std::size_t k = 0; k < result.points.size(); ++k)
      if (SweepPoint& p = result.points[k]; p.status == SweepPoint::Status::done) {
        add_range_warnings(*mechanism, plan.parameters_at(*mechanism, k), p.result);
        if (const ModelErrorSaid said = model_error_said(p.result, study.index, mechanism->characteristic_length());
            !said.warning.empty())
          p.result.warnings.push_back(said.warning);
      }

    write_json(out, "summary.json", summary_of(own, study, choice, plan, result, watch, begun.results->earlier()));
    out.write("sweep.csv", [&](std::ostream& s) { write_sweep(s, study, plan, *mechanism, result); });
    write_report(out, sweep_report(command, study, *mechanism, choice, rung->leaves_out(), plan, result));
    out.publish();
    begun.results.reset();
    if (!result.interrupted) own.run().forget(kUnfinished);
    stage->clear();
    if (!command.quiet) print(command, study, plan, *mechanism, result, out);
    if (result.interrupted) return kInterrupted;
    if (result.failed == 0) return kDone;
    const auto first = std::find_if(result.points.begin(), result.points.end(),
                                    [](const SweepPoint& p) { return p.status == SweepPoint::Status::failed; });
    return failed(command,
                  fmt::format("{} of {} points failed, the first: {}", result.failed, plan.points(), first->failure));
  }

 private:
  // The grid's corners, where every axis is at its smallest or its largest value, whatever order they are listed in; of many axes two opposite
  // ones. And some between them, the middle first of all: an error that is swept through zero, or a load, hides a rung's own error at the ends.
  static std::vector<Parameters> tried_points(const SweepPlan& plan, const Mechanism& mechanism) {
    constexpr std::size_t kMostAxes = 3, kMostBetween = 3;
    std::vector<double> least, largest;
    for (const SweepAxis& axis : plan.axes) {
      const auto [low, high] = std::minmax_element(axis.values.begin(), axis.values.end());
      least.push_back(*low);
      largest.push_back(*high);
    }
    std::vector<Parameters> tried;
    std::vector<std::size_t> between;
    for (std::size_t k = 0; k < plan.points(); ++k) {
      const std::vector<double> values = plan.values_at(k);
      std::size_t lowest = 0, highest = 0, either = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        lowest += values[i] == least[i];
        highest += values[i] == largest[i];
        either += values[i] == least[i] || values[i] == largest[i];
      }
      const bool corner = either == values.size();
      if (corner && (values.size() <= kMostAxes || lowest == values.size() || highest == values.size()))
        tried.push_back(plan.parameters_at(mechanism, k));
      else
        between.push_back(k);
    }
    const std::size_t more = std::min(kMostBetween, between.size());
    for (std::size_t i = 0; i < more; ++i)
      tried.push_back(plan.parameters_at(mechanism, between[(2 * i + 1) * between.size() / (2 * more)]));
    return tried;
  }

  static Json summary_of(const VerbStudy& own, const Study& study, const RungChoice& choice, const SweepPlan& plan,
                         const SweepResult& result, const Stopwatch& watch, const SampleStore::Cost& earlier) {
    std::vector<std::string> warnings;
    for (const SweepPoint& p : result.points)
      if (p.status == SweepPoint::Status::failed) warnings.push_back(point_name(plan, p, true) + ": " + p.failure);
    for (const std::string& warning : told_of_points(plan, result)) warnings.push_back(warning);
    Json json = own.head(study, choice, watch, warnings, result.interrupted, earlier);
    json["index"] = {
        {"quantity", study.index.quantity}, {"statistic", study.index.statistic}, {"values", Json::array()}};
    json["points"] = Json::array();
    for (const SweepPoint& p : result.points) {
      json["points"].push_back(point_json(study, plan, p));
      json["index"]["values"].push_back(p.status == SweepPoint::Status::done ? Json(study.index.of(p.result.index))
                                                                             : Json());
    }
    json["failed"] = result.failed;
    json["files"] = {"summary.json", "sweep.csv", "report.html", "report.json"};
    return json;
  }

  MotionOptions motion_;
};

}  // namespace

std::unique_ptr<Verb> make_sweep_verb() { return std::make_unique<SweepVerb>(); }

}  // namespace boresight::app
