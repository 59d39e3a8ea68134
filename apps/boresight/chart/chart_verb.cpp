// boresight chart FILE: accuracy against speed of every rung, formulation, integrator and step, measured now,
// on this machine.
#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/io/referred_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/chart/chart.hpp"
#include "boresight_analyses/study/study.hpp"
#include "chart/chart_report.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/option_range.hpp"
#include "command_line/verb.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/tables.hpp"
#include "results/verb_study.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

void write_points(std::ostream& out, const ChartResult& result) {
  out << "family,rung,formulation,stabilisation,integrator,step,tolerance,index,error,half_spread,own_"
         "estimate,cpu_seconds,papers,"
         "pareto,refusal\n";
  for (std::size_t k = 0; k < result.points.size(); ++k) {
    const ChartPoint& p = result.points[k];
    const bool done = p.measured.refusal.empty();
    const bool front = std::find(result.front.begin(), result.front.end(), k) != result.front.end();
    const auto number = [&](double value) { return done ? exact(value) : std::string(); };
    out << csv_field(p.family) << ',' << p.setup.rung << ',' << p.setup.formulation << ',' << p.setup.stabilisation
        << ',' << p.setup.integrator << ',' << (p.setup.step > 0.0 ? exact(p.setup.step) : "") << ','
        << (p.setup.tolerance > 0.0 ? exact(p.setup.tolerance) : "") << ',' << number(p.measured.value) << ','
        << number(p.error) << ',' << number(p.measured.half_spread) << ',' << number(p.measured.estimate) << ','
        << number(p.measured.cpu_seconds) << ',' << p.papers << ',' << front << ',' << csv_field(p.measured.refusal)
        << '\n';
  }
}

void write_flight(std::ostream& out, const FreeFlight& flight) {
  out << "family,rung,formulation,stabilisation,integrator,step,tolerance,error_over_clearance,cpu_seconds,"
         "refusal\n";
  for (const FlightPoint& p : flight.points) {
    const bool done = p.refusal.empty();
    out << csv_field(p.family) << ',' << p.setup.rung << ',' << p.setup.formulation << ',' << p.setup.stabilisation
        << ',' << p.setup.integrator << ',' << (p.setup.step > 0.0 ? exact(p.setup.step) : "") << ','
        << (p.setup.tolerance > 0.0 ? exact(p.setup.tolerance) : "") << ',' << (done ? exact(p.error) : "") << ','
        << (done ? exact(p.cpu_seconds) : "") << ',' << csv_field(p.refusal) << '\n';
  }
}

Json point_json(const ChartPoint& p) {
  Json json = {{"way", p.family}, {"fineness", fineness(p.setup)}};
  if (p.measured.refusal.empty()) {
    json["index"] = p.measured.value;
    json["error"] = p.error;
    json["own_estimate"] = p.measured.estimate;
    json["cpu_seconds"] = p.measured.cpu_seconds;
  } else {
    json["refused"] = p.measured.refusal;
  }
  return json;
}

const RungChoice kAllRungs{.name = "all", .why = "the chart compares them"};

std::vector<std::string> warnings_of(const ChartResult& result) {
  std::vector<std::string> warnings;
  for (const std::string& name : result.left_out) warnings.push_back(left_out_sentence(result, name));
  for (const std::string& name : result.flight.left_out)
    warnings.push_back("no time was left for the flight before the first impact of " + name);
  return warnings;
}

Json summary_of(const VerbStudy& own, const ChartResult& result, std::optional<double> accuracy, const Stopwatch& watch,
                const SampleStore::Cost& earlier) {
  Json json = own.head(kAllRungs, watch, warnings_of(result), result.interrupted, earlier);
  json["index"] = result.index;
  const bool referred = !result.reference.refinements.empty();  // an interrupted chart may have none yet
  json["reference"] = {{"value", referred ? Json(result.reference.value) : Json()},
                       {"uncertainty", referred ? Json(result.reference.uncertainty) : Json()},
                       {"refinements", Json::array()}};
  for (const Refinement& r : result.reference.refinements)
    json["reference"]["refinements"].push_back({{"step", r.step}, {"value", r.value}, {"half_spread", r.half_spread}});
  json["machine"] = {{"processor", result.machine.processor},
                     {"cores", result.machine.cores},
                     {"compiler", result.machine.compiler},
                     {"build", result.machine.build},
                     {"load", result.machine.load}};
  if (accuracy) {
    json["accuracy"] = *accuracy;
    const ChartPoint* best = result.cheapest_within(*accuracy);
    json["cheapest_within_accuracy"] = best ? point_json(*best) : Json();
  }
  json["papers"] = result.papers() ? point_json(*result.papers()) : Json();
  json["pareto"] = Json::array();
  for (std::size_t k : result.front) json["pareto"].push_back(point_json(result.points[k]));
  json["points"] = Json::array();
  for (const ChartPoint& p : result.points) json["points"].push_back(point_json(p));
  json["flight"] = {{"first_contact", result.flight.first_contact},
                    {"end", result.flight.end},
                    {"points", result.flight.points.size()}};
  json["files"] = {"summary.json", "chart.csv", "flight.csv", "report.html", "report.json"};
  return json;
}

void print(const Command& command, const Mechanism& mechanism, const ChartResult& result,
           std::optional<double> accuracy, const OutputDirectory& out) {
  tell("{}: accuracy against speed, {}{}\n", mechanism.name(), result.index,
       result.interrupted ? " (interrupted; the same command goes on)" : "");
  if (result.reference.refinements.empty())
    tell("  no reference yet\n");
  else
    tell("  reference {}, known to {}\n", readable(result.reference.value, result.unit),
         readable_error(result.reference.uncertainty));
  tell("  Pareto front:\n");
  for (std::size_t k : result.front) {
    const ChartPoint& p = result.points[k];
    tell("    {:>10}  off by {:<10} {}, {}\n", readable(p.measured.cpu_seconds, "s"), off_text(result, p), p.family,
         fineness(p.setup));
  }
  if (const ChartPoint* papers = result.papers())
    tell("  the setting of Sun, Song and Wang: {}, off by {}\n", readable(papers->measured.cpu_seconds, "s"),
         off_text(result, *papers));
  if (accuracy) {
    const ChartPoint* best = result.cheapest_within(*accuracy);
    tell("  cheapest within {}: {}\n", readable_share(*accuracy),
         best ? best->family + ", " + fineness(best->setup)
         : result.reference.uncertainty > *accuracy
             ? "cannot be told, as the reference is known to " + readable_error(result.reference.uncertainty) + " only"
             : "none");
  }
  std::size_t failed = 0;
  for (const ChartPoint& p : result.points) failed += !p.measured.refusal.empty();
  tell("  {} ways, {} failed; {}\n", result.points.size(), failed, machine_line(result.machine));
  tell_warnings(warnings_of(result), command, mechanism);
  tell("  report: {}\n", (out.path() / "report.html").string());
}

class ChartVerb : public Verb {
 public:
  std::string name() const override { return "chart"; }
  std::string file_kind() const override { return "mechanism or study"; }
  std::string summary() const override {
    return "accuracy against speed: every rung, formulation and integrator, measured now, on this machine";
  }
  std::string example() const override {
    return "boresight chart antenna/mechanism.toml --time \"5 s\" --accuracy \"1 %\"";
  }
  std::string next(const Command& command, bool) const override {
    return "boresight run " + shell_word(mechanism_file_.empty() ? command.file : mechanism_file_) +
           " --accuracy '1 %' takes the cheapest way by itself";
  }
  std::vector<std::string> unused_options() const override { return {"--rung"}; }
  void declare_options(CLI::App& app) override {
    declare_option(app, "--index", index_,
                   "of a mechanism, whose file names none: such as boresight_error.rms; otherwise position_error.max",
                   "QUANTITY.STATISTIC");
    declare_option(app, "--start", start_, "the index leaves out what the motion does before; a study says so itself",
                   "TIME");
    declare_option_with_default(app, "--time", time_, "of CPU in all; ways for which none is left are named", "TIME");
  }

  int execute(const Command& command) override {
    const Stopwatch watch;
    ChartOptions options;
    const std::string asked = index_.empty() ? "position_error.max" : index_;
    options.index = index_named("--index", asked);
    options.total_seconds = quantity_between("--time", time_, {kDuration, "0.1 s", "1e7 s"});
    options.reference_seconds = 0.15 * options.total_seconds;
    std::optional<double> accuracy = command.accuracy;
    std::string mechanism_file = command.file, study_hash;
    Document document = Document::from_file(command.file);
    Cursor root(document);
    std::optional<Study> study;
    if (root.has("mechanism")) {
      study = read_study(root, document.content_hash());
      mechanism_file = mechanism_file_ = study->mechanism_file;
      study_hash = study->content_hash;
      if (!index_.empty())
        throw InputError({"command line", 0}, "--index", in_quotes(index_),
                         "none: a study says itself what is asked, in [index]");
      options.index = study->index;
      if (!accuracy) accuracy = study->accuracy;
    }
    const auto read = [&] {
      return std::make_shared<const Mechanism>(read_mechanism(mechanism_file, command.settings));
    };
    const auto mechanism = study ? read_referred(root.origin("mechanism"), "mechanism", mechanism_file, read) : read();
    if (!start_.empty()) options.index.start = positive_quantity("--start", start_, kDuration);
    if (study)
      check_index(*study, *mechanism);
    else
      check_line_of_sight(options.index, *mechanism, {"command line", 0}, "--index");
    check_start(options.index.start, *mechanism, {"command line", 0}, "--start");
    const VerbStudy own(command, mechanism, options.index, study ? study->accuracy : std::nullopt, {},
                        identity_of(command, mechanism->description().content_hash, study_hash,
                                    {{"index", asked + (start_.empty() ? "" : " from " + start_)}, {"time", time_}}));
    const std::unique_ptr<Stage> stage = own.run().stage(100.0, "%");
    options.progress = [&](double share, const std::string& what) {
      stage->update(100.0 * share, what);
      return !interrupted();
    };
    const OutputDirectory& out = own.out();
    // Times of two machines are not to be compared.
    Unfinished begun = own.run().go_on([] { return kAllRungs; }, this_machine().processor);
    options.kept = begun.results.get();
    const ChartResult result = make_chart(mechanism, mechanism->parameters(), options);

    write_json(out, "summary.json", summary_of(own, result, accuracy, watch, begun.results->earlier()));
    out.write("chart.csv", [&](std::ostream& s) { write_points(s, result); });
    out.write("flight.csv", [&](std::ostream& s) { write_flight(s, result.flight); });
    write_report(out, chart_report(command, *mechanism, result, accuracy));
    out.publish();
    begun.results.reset();
    if (!result.interrupted) own.run().forget(kUnfinished);
    stage->clear();
    if (!command.quiet) print(command, *mechanism, result, accuracy, out);
    if (result.interrupted) return kInterrupted;
    return accuracy && !result.cheapest_within(*accuracy) ? kAnswerIsNo : kDone;
  }

 private:
  std::string index_, time_ = "60 s", start_, mechanism_file_;
};

}  // namespace

std::unique_ptr<Verb> make_chart_verb() { return std::make_unique<ChartVerb>(); }

}  // namespace boresight::app
