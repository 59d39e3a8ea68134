// boresight run MECHANISM: one motion, its pointing error, its contacts.
#include <fmt/format.h>

#include <iostream>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/rungs/rung.hpp"
#include "exit_status.hpp"
#include "interruption.hpp"
#include "progress.hpp"
#include "readable.hpp"
#include "report/report.hpp"
#include "run_report.hpp"
#include "summary.hpp"
#include "tables.hpp"
#include "verb.hpp"

namespace boresight::app {
namespace {

void print(const Mechanism& mechanism, const RunResult& result, const OutputDirectory& out) {
  fmt::print("{}: {} of motion, {}{}\n", mechanism.name(), readable(result.end_time, "s"), result.integrator,
             result.interrupted ? " (interrupted)" : "");
  const PointingIndices& index = result.index;
  fmt::print("  position error       max {:>10}   RMS {:>10}\n", readable(index.position_error.max, "m"),
             readable(index.position_error.rms, "m"));
  fmt::print("  boresight error      max {:>10}   RMS {:>10}   ({} max)\n",
             readable(index.boresight_error.max, "rad"), readable(index.boresight_error.rms, "rad"),
             readable_arcsec(index.boresight_error.max));
  fmt::print("  line-of-sight error  max {:>10}   RMS {:>10}   ({} max)\n",
             readable(index.line_of_sight_error.max, "rad"), readable(index.line_of_sight_error.rms, "rad"),
             readable_arcsec(index.line_of_sight_error.max));
  for (const ContactSummary& c : result.contact)
    fmt::print("  {}: in contact {} of the time, {} impacts, penetration up to {}, force up to {}\n", c.joint,
               readable_share(c.contact_fraction), c.impacts, readable(c.max_penetration, "m"),
               readable(c.max_force, "N"));
  for (const std::string& warning : result.warnings) fmt::print("  warning: {}\n", warning);
  fmt::print("  report: {}\n", (out.path() / "report.html").string());
}

Json summary_of(const Command& command, const Mechanism& mechanism, const RungChoice& rung,
                const RunResult& result, const Stopwatch& watch, const OutputDirectory& out) {
  Json json = common_summary(command, mechanism, rung, watch, result.warnings, result.interrupted, out);
  json["formulation"] = result.formulation;
  json["integrator"] = result.integrator;
  json["end_time"] = result.end_time;
  json["index"] = index_json(result.index);
  json["contact"] = contact_json(result.contact);
  json["platform_acceleration_max"] = vector_json(result.platform_acceleration_max);
  json["constraint_drift"] = result.constraint_drift;
  json["energy_error"] = result.energy_error;
  json["steps"] = result.cost.steps;
  json["rejected_steps"] = result.cost.rejected_steps;
  json["evaluations"] = result.cost.evaluations;
  json["files"] = {"summary.json", "timeseries.csv", "events.csv", "report.html"};
  return json;
}

class RunVerb : public Verb {
 public:
  std::string name() const override { return "run"; }
  std::string file_kind() const override { return "mechanism"; }
  std::string summary() const override { return "one motion: pose, pointing error, contact states, forces"; }
  std::string example() const override {
    return "boresight run examples/3-rrcpr/3-rrcpr.toml --set clearance.F1.radial=0.2mm --out results/wide";
  }
  void declare_options(CLI::App& app) override { motion_.declare(app, true); }

  int execute(const Command& command) override {
    const Stopwatch watch;
    const auto mechanism = std::make_shared<const Mechanism>(read_mechanism(command.file, command.settings));
    const RungChoice choice = choose_rung(command.rung, command.accuracy);
    RunOptions options = motion_.run_options(*mechanism);
    const OutputDirectory out = OutputDirectory::open(
        command.out, command.verb, command.file,
        identity_of(command, mechanism->description().content_hash, "", motion_.identity()));

    const std::size_t finer = history_refinement(mechanism->duration(), options.sample_spacing);
    options.sample_spacing /= static_cast<double>(finer);
    Progress progress(command.quiet, mechanism->duration(), "s of motion");
    options.progress = [&](const RunProgress& p) {
      progress.update(p.t, "position error so far " + readable(p.position_error_max_so_far, "m"));
      return !interrupted();
    };
    const std::unique_ptr<Rung> rung = make_rung(choice.name, mechanism);
    const RunResult result =
        with_options_checked(options, [&] { return rung->run(mechanism->parameters(), options); });

    write_json(out, "summary.json", summary_of(command, *mechanism, choice, result, watch, out));
    out.write("timeseries.csv", [&](std::ostream& s) { write_timeseries(s, *mechanism, result, finer); });
    out.write("events.csv", [&](std::ostream& s) { write_events(s, *mechanism, result); });
    out.write("report.html", [&](std::ostream& s) {
      report::write_html(s, run_report(command, *mechanism, choice, rung->leaves_out(), result));
    });
    progress.clear();
    if (!command.quiet) print(*mechanism, result, out);
    return result.interrupted ? kInterrupted : kDone;
  }

 private:
  MotionOptions motion_;
};

}  // namespace

std::unique_ptr<Verb> make_run_verb() { return std::make_unique<RunVerb>(); }

}  // namespace boresight::app
