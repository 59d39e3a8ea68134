// boresight calibrate STUDY: contact parameters and standing errors from measured pointing data.
#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <ostream>

#include "boresight/io/content_hash.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/io/referred_file.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight_analyses/calibration/calibration_keys.hpp"
#include "boresight_analyses/calibration/calibration_plan.hpp"
#include "boresight_analyses/calibration/posterior.hpp"
#include "boresight_analyses/calibration/rig.hpp"
#include "calibrate/asked_rig.hpp"
#include "calibrate/calibrate_report.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/verb.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/study_warnings.hpp"
#include "results/summary.hpp"
#include "results/verb_study.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

class CalibrateVerb : public Verb {
 public:
  std::string name() const override { return "calibrate"; }
  std::string file_kind() const override { return "study"; }
  const KeyTable* study_table() const override { return &calibrate_keys(); }
  std::string summary() const override { return "contact parameters and standing errors from measured pointing data"; }
  std::string example() const override {
    return "boresight calibrate antenna/calibrate.toml --make-data \"1 %\"\n  boresight calibrate "
           "antenna/calibrate.toml";
  }
  std::string next(const Command& command, bool answer_is_no) const override {
    return answer_is_no ? std::string("boresight help calibrate.candidate: which further test would tell more")
           : asked_.noise.empty()
               ? "in the [budget] table of a study: posterior = \"" +
                     std::filesystem::absolute(last_summary().parent_path() / "posterior.toml").string() + "\""
               : "boresight calibrate " + shell_word(command.file);
  }
  std::vector<std::string> unused_options() const override { return {"--rung", "--accuracy"}; }
  void declare_options(CLI::App& app) override {
    declare_option(
        app, "--make-data", asked_.noise,
        "write the study's data files anew from the multibody rung, with this noise: a share of the readings "
        "(\"1 %\"), or an angle or a length (\"1 arcsec\"); files that it did not write are left as they are, "
        "with status 2",
        "TEXT");
    declare_option(app, "--make-offset", asked_.offset,
                   "of --make-data: a hidden mounting offset on every displacement, such as \"5 um\"", "TEXT");
    declare_option(app, "--make-seed", asked_.seed, "of --make-data: of the noise", "UINT");
    declare_option(
        app, "--make-channels", asked_.channels,
        "of --make-data: which channels, such as \"bx,by,bz\"; left out: dx, dy, dz, rx, ry, rz, or with a noise "
        "in a unit bx, by, bz or dx, dy, dz",
        "TEXT");
    declare_option(app, "--make-samples", asked_.samples,
                   "of --make-data: how many readings, at equal times; left out: one a millisecond", "UINT");
  }

  int execute(const Command& command) override {
    const Stopwatch watch;
    asked_.refuse_without_noise();
    Document document = Document::from_file(command.file);
    Cursor root(document);
    const Study study = read_study(root, document.content_hash());
    const auto mechanism_with = [&](const std::vector<Setting>& more) {
      std::vector<Setting> settings = command.settings;
      settings.insert(settings.end(), more.begin(), more.end());
      return read_referred(root.origin("mechanism"), "mechanism", study.mechanism_file, [&] {
        return std::make_shared<const Mechanism>(read_mechanism(study.mechanism_file, settings));
      });
    };
    const auto mechanism = mechanism_with({});
    const CalibrationPlan plan = read_calibration_plan(root, study, mechanism->description());
    if (!asked_.noise.empty()) return make_data(command, plan, mechanism_with);
    CalibrationProblem problem = calibration_problem(plan, mechanism_with);
    CalibrationOptions options;
    options.jobs = command.jobs;
    options.confidence = plan.confidence;
    options.starts = plan.starts;
    options.seed = plan.seed;
    options.noise = plan.noise;
    options.corrections = plan.corrections;
    options.profile = plan.profile;
    options.discrepancy = plan.discrepancy;
    options.draws = plan.draws;
    options.laws = plan.laws;
    for (const PlannedRun& c : plan.candidates) options.candidates.push_back({c.name, mechanism_with(c.settings)});
    ContentHash data;
    for (const CalibrationRun& run : problem.runs) data.add(exact_text_of(run.data));
    const VerbStudy own(command, mechanism, study.index, study.accuracy, {},
                        identity_of(command, mechanism->description().content_hash, study.content_hash,
                                    {{"data", data.hexadecimal()}}));
    const OutputDirectory& out = own.out();
    // A fit that fails is told of in the results, and once is enough: Ceres says it on the terminal as well.
    FLAGS_minloglevel = google::GLOG_FATAL;
    std::unique_ptr<Stage> stage = own.run().stage(1.0, "");
    bool draws = false;
    options.progress = [&](const std::string& of, double share, const std::string& estimate) {
      if (!draws && of == kDrawsStage) {  // with a clock of their own
        draws = true;
        stage->clear();
        stage = own.run().stage(1.0, "");
      }
      stage->update(share, of + (estimate.empty() ? "" : ": " + estimate));
      return !interrupted();
    };
    RungChoice rung;
    rung.name = problem.follows_play() ? "perturbation" : "multibody";
    rung.why = !problem.follows_play() ? "no play is followed; the joints of the built mechanism are closed exactly"
               : plan.corrections > 0
                   ? "the fit needs exact derivatives, which it has; what it leaves out is corrected by multibody"
                   : "the fit needs exact derivatives, which it has";
    Unfinished begun = own.run().go_on([&] { return rung; });
    problem.kept = begun.results.get();
    CalibrationResult result = calibrate(problem, options);
    for (const std::string& one : study_warnings(*mechanism, rung.name)) result.warnings.push_back(one);
    stage->clear();
    const CalibrationStudy whole{command, study, *mechanism, rung, plan, problem, result};
    if (result.interrupted && result.inference.parameters.empty()) {
      if (begun.results->size() == 0) throw Interrupted{};
      if (!command.quiet) tell("  interrupted; what was computed is kept, the same command goes on\n");
      return kInterrupted;
    }
    write_json(out, "summary.json", summary_of(whole, own, watch, begun.results->earlier()));
    if (!result.inference.parameters.empty()) {
      out.write("posterior.toml", [&](std::ostream& s) {
        if (result.interrupted)
          s << "# The calibration was interrupted: these are the values and errors where it stood, not those of its "
               "data.\n"
               "interrupted = true\n\n";
        s << (result.draws ? posterior_toml(*result.draws, problem, "posterior.csv")
                           : posterior_toml(problem, result.inference));
      });
      if (result.draws) out.write("posterior.csv", [&](std::ostream& s) { s << csv_of(*result.draws); });
      write_report(out, calibrate_report(whole));
    }
    out.publish();
    begun.results.reset();
    if (!result.interrupted) own.run().forget(kUnfinished);
    if (!command.quiet) print(whole, out);
    if (result.interrupted) return kInterrupted;
    const bool all = std::all_of(result.inference.parameters.begin(), result.inference.parameters.end(),
                                 [](const ParameterEstimate& e) { return e.identifiable; });
    const bool drawn = !plan.draws || (result.draws && result.draws->settled);
    return all && result.fit.converged && drawn ? kDone : kAnswerIsNo;
  }

 private:
  template <typename MechanismWith>
  int make_data(const Command& command, const CalibrationPlan& plan, const MechanismWith& mechanism_with) const {
    const SyntheticRig rig = asked_.rig();
    for (const PlannedRun& planned : plan.runs)
      if (!planned.sensors.empty())
        throw InputError(planned.origin, "calibrate.run.sensor", "sensors of a run, with --make-data",
                         "data = \"run.csv\", the file that it writes");
    for (const PlannedRun& planned : plan.runs) check_that_data_may_be_written(planned.data);
    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
      const auto mechanism = mechanism_with(plan.runs[r].settings);
      const std::vector<double> times = sample_times(rig, mechanism->duration());
      const MatX clean = multibody_readings(mechanism, mechanism->parameters(), times, rig.channels);
      write_atomically(plan.runs[r].data, synthetic_csv_of(with_rig_errors(rig, times, clean, static_cast<int>(r))));
      if (!command.quiet) tell("wrote {}\n", plan.runs[r].data);
    }
    if (command.json) std::cout << made_data(plan, rig).dump(2) << "\n";
    return kDone;
  }

  Json made_data(const CalibrationPlan& plan, const SyntheticRig& rig) const {
    Json files = Json::array();
    for (const PlannedRun& planned : plan.runs) files.push_back(planned.data);
    return {{"verb", "calibrate"},   {"version", BORESIGHT_VERSION},
            {"made_data", files},    {"noise", rig.deviation > 0.0 ? rig.deviation : rig.noise},
            {"offset", rig.bias[0]}, {"seed", rig.seed}};
  }

  static Json summary_of(const CalibrationStudy& s, const VerbStudy& own, const Stopwatch& watch,
                         const SampleStore::Cost& earlier) {
    const CalibrationResult& r = s.result;
    Json json = own.head(s.study, s.rung, watch, r.warnings, r.interrupted, earlier);
    json["seed"] = s.plan.seed;
    json["data"] = Json::array();
    for (const CalibrationRun& run : s.problem.runs) {
      if (run.data.file_of.empty()) json["data"].push_back(run.data.file);
      std::string last;
      for (const std::string& file : run.data.file_of)
        if (std::exchange(last, file) != file) json["data"].push_back(file);
    }
    json["objective"] = number(r.fit.cost);
    json["converged"] = r.fit.converged;
    json["reason"] = r.fit.reason;
    json["evaluations"] = r.evaluations;
    for (const char* key :
         {"optimum", "standard_error", "standard_error_of_data", "interval", "correlation", "identifiable"})
      json[key] = Json::object();
    const auto& parameters = r.inference.parameters;
    for (std::size_t a = 0; a < parameters.size(); ++a) {
      const ParameterEstimate& e = parameters[a];
      json["optimum"][e.name] = e.identifiable ? number(e.value) : Json();
      json["standard_error"][e.name] = e.identifiable ? number(e.standard_error) : Json();
      json["standard_error_of_data"][e.name] = e.identifiable && !e.by_prior ? number(e.data_error) : Json();
      json["interval"][e.name] =
          e.identifiable ? Json{{"low", number(e.low)}, {"high", number(e.high)}, {"confidence", s.plan.confidence}}
                         : Json();
      for (const Profile& p : r.profiles)
        if (e.identifiable && p.parameter == static_cast<int>(a))
          json["interval"][e.name]["profile"] = {{"low", number(p.low)}, {"high", number(p.high)}};
      for (std::size_t b = 0; b < parameters.size(); ++b)
        json["correlation"][e.name][parameters[b].name] =
            number(r.inference.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
      json["identifiable"][e.name] = {{"value", e.identifiable}, {"by_prior", e.by_prior}, {"reason", e.reason}};
    }
    json["combinations"] = combinations_of(s);
    json["verdict"] = r.verdict;
    json["model_error"] = model_error_of(s);
    json["residuals"] = {{"values", r.inference.values},
                         {"unknowns", r.inference.unknowns},
                         {"variance_factor", number(r.inference.variance_factor)},
                         {"autocorrelation", number(r.inference.autocorrelation)},
                         {"lags", r.inference.lags}};
    Json sigma = Json::object();
    for (std::size_t c = 0; c < s.problem.channels.size(); ++c)
      sigma[channel_names()[s.problem.channels[c]].name] = s.problem.sigma[static_cast<Eigen::Index>(c)];
    json["noise"] = sigma;
    json["multibody"] = {{"residual_rms", r.confirmation >= 0.0 ? number(r.confirmation) : Json()}};
    json["hold_out"] = r.hold_out ? Json{{"values", r.hold_out->values}, {"rms", number(r.hold_out->rms)}} : Json();
    json["laws"] = Json::array();
    for (const LawScore& l : r.laws)
      json["laws"].push_back({{"law", l.law},
                              {"cost", number(l.cost)},
                              {"parameters", l.parameters},
                              {"effective_values", number(l.effective_values)},
                              {"aic", number(l.aic)},
                              {"difference", number(l.difference)}});
    json["next_tests"] = Json::array();
    for (const NextTest& t : r.next_tests)
      json["next_tests"].push_back(
          {{"name", t.name}, {"d_gain", number(t.d_gain)}, {"a_ratio", number(t.a_ratio)}, {"refusal", t.refusal}});
    json["posterior"] = draws_of(r);
    json["files"] = parameters.empty() ? Json{"summary.json"}
                                       : Json{"summary.json", "posterior.toml", "report.html", "report.json"};
    if (r.draws) json["files"].push_back("posterior.csv");
    return json;
  }

  static Json draws_of(const CalibrationResult& r) {
    if (!r.draws) return Json();
    Json quantities = Json::object();
    for (const DrawnQuantity& q : r.draws->quantities)
      quantities[q.name] = {{"mean", number(q.mean)},         {"standard_deviation", number(q.deviation)},
                            {"low", number(q.low)},           {"median", number(q.median)},
                            {"high", number(q.high)},         {"r_hat", number(q.r_hat)},
                            {"bulk_ess", number(q.bulk_ess)}, {"tail_ess", number(q.tail_ess)}};
    return {{"draws", r.draws->values.rows()},
            {"settled", r.draws->settled},
            {"says", r.draws->says},
            {"quantities", quantities},
            {"temperatures", r.draws->beta},
            {"acceptance", r.draws->acceptance},
            {"swaps_rejected", r.draws->swap_rejection},
            {"barrier", number(r.draws->barrier)},
            {"restarts", r.draws->restarts},
            {"evaluations", r.draws->evaluations}};
  }

  static Json model_error_of(const CalibrationStudy& s) {
    if (!s.result.model_error) return Json();
    const CalibrationModelError& e = *s.result.model_error;
    Json suspects = Json::array();
    for (const SuspectFound& found : e.suspects) {
      Json adds = Json::object();
      for (int p = 0; p < s.problem.parameter_count(); ++p) {
        const FittedParameter& parameter = s.problem.parameters[static_cast<std::size_t>(p)];
        adds[parameter.path] = number(found.adds[p] * parameter.slope(s.result.fit.globals.u[p]));
      }
      suspects.push_back({{"name", found.name},
                          {"says", found.says},
                          {"deviation", number(found.deviation)},
                          {"unit", found.unit == "%" ? "1" : found.unit},
                          {"found", number(found.mean)},
                          {"error", number(found.error)},
                          {"gain", number(found.gain)},
                          {"adds", adds}});
    }
    return {{"jump", number(e.jump)}, {"jump_gain", number(e.jump_gain)},
            {"optima", e.optima},     {"disagreement", number(e.disagreement)},
            {"groups", e.groups},     {"suspects", suspects}};
  }

  // Of standing errors that the data cannot tell apart.
  static Json combinations_of(const CalibrationStudy& s) {
    Json groups = Json::array();
    for (const ConfusedErrors& group : s.result.inference.confused) {
      Json names = Json::array(), known = Json::array();
      for (const int p : group.parameters) names.push_back(s.problem.parameters[static_cast<std::size_t>(p)].path);
      for (const KnownCombination& c : group.known) {
        Json terms = Json::object();
        for (const auto& [p, coefficient] : c.terms)
          terms[s.problem.parameters[static_cast<std::size_t>(p)].path] = number(coefficient);
        known.push_back({{"terms", terms},
                         {"unit", c.told_unit},
                         {"value", number(c.value)},
                         {"standard_error", number(c.standard_error)},
                         {"low", number(c.low)},
                         {"high", number(c.high)}});
      }
      groups.push_back({{"errors", names},
                        {"known", known},
                        {"hidden", group.hidden},
                        {"says", in_words(group, s.problem.parameters)}});
    }
    return groups;
  }

  static void print(const CalibrationStudy& s, const OutputDirectory& out) {
    tell("{}: {}, {}; {}\n", s.mechanism.name(), how_many(s.problem.runs.size(), "run"),
         how_many(static_cast<std::size_t>(s.result.inference.values), "value"), s.result.fit.reason);
    for (const ParameterEstimate& e : s.result.inference.parameters)
      if (const DisplayUnit unit = unit_of_estimate(e); e.identifiable)
        tell("  {}: {} ± {} ({:.5g} to {:.5g}{}{}){}\n", e.name, readable_as(e.value, e.si_unit, e.written_unit),
             readable_as(e.standard_error, e.si_unit, e.written_unit), e.low * unit.per_si, e.high * unit.per_si,
             unit.name.empty() ? "" : " ", unit.name, e.by_prior ? ", assumed, not told by the data" : "");
      else
        tell("  {}: not identifiable: {}\n", e.name, e.reason);
    for (const ConfusedErrors& group : s.result.inference.confused)
      for (const KnownCombination& c : group.known) {
        const std::string written = written_unit_of(c, s.problem);
        tell("  {}: {} ± {}\n", in_words(c, s.problem.parameters), readable_as(c.value, c.si_unit, written),
             readable_as(c.standard_error, c.si_unit, written));
      }
    for (const std::string& sentence : s.result.verdict) tell("  {}\n", sentence);
    if (!s.result.next_tests.empty()) tell("  next test: {}\n", s.result.next_tests.front().name);
    tell_warnings(s.result.warnings, s.command, s.mechanism);
    if (s.result.interrupted)
      tell("  interrupted: the posterior is that of a fit that had not ended; the same command goes on\n");
    if (s.result.inference.parameters.empty()) return;
    tell("  posterior: {}\n  report: {}\n", (out.path() / "posterior.toml").string(),
         (out.path() / "report.html").string());
  }

  AskedRig asked_;
};

}  // namespace

std::unique_ptr<Verb> make_calibrate_verb() { return std::make_unique<CalibrateVerb>(); }

}  // namespace boresight::app
