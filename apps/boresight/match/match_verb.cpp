// boresight match STUDY: the values of some parameters at which the pointing error, or another measure, is
// least.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "boresight/rungs/integrator_choice.hpp"
#include "boresight_analyses/matching/design_slopes.hpp"
#include "boresight_analyses/matching/designs_tried.hpp"
#include "boresight_analyses/matching/matching_keys.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/study/design_model.hpp"
#include "command_line/study_input.hpp"
#include "command_line/verb.hpp"
#include "match/match_report.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/scatter_parts.hpp"
#include "results/study_warnings.hpp"
#include "results/tables.hpp"
#include "results/verb_study.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

Json design_json(const MatchingPlan& plan, const std::vector<double>& design) {
  Json json = Json::object();
  for (std::size_t i = 0; i < design.size(); ++i)
    for (const std::string& path : plan.variables[i].paths) json[path] = design[i];
  return json;
}

// What a rung without dynamics answers by zero, whatever the design.
bool asks_how_contacts_move(const MatchingPlan& plan) {
  const auto of_motion = [](const MeasureChoice& m) { return m.measure != Measure::index; };
  return of_motion(plan.objective) || std::any_of(plan.constraints.begin(), plan.constraints.end(),
                                                  [&](const MatchingConstraint& c) { return of_motion(c.measure); });
}

bool is_contact_only(const std::vector<std::string>& paths) {
  for (const std::string& path : paths)
    if (!path.starts_with("clearance.")) return false;
  return true;
}

bool any_scene_varies(const MatchingPlan& plan) {
  for (const DesignVariable& v : plan.variables)
    if (!is_contact_only(v.paths)) return true;
  return plan.inputs && scene_varies(*plan.inputs);
}

// About as many designs as it asks for; descents end sooner.
double designs_asked_for(const MatchingPlan& plan) {
  return plan.evaluations * (1.0 + 0.5 * static_cast<double>(plan.starts().size() + 1)) +
         std::pow(plan.map, std::min<double>(2.0, static_cast<double>(plan.variables.size()))) + 12.0 * plan.front;
}

void write_evaluations(std::ostream& out, const MatchingPlan& plan, const MatchingResult& result) {
  out << "evaluation,stage";
  for (const DesignVariable& v : plan.variables) out << ',' << csv_field(v.name());
  out << ",objective,violation\n";
  for (std::size_t k = 0; k < result.visits.size(); ++k) {
    const MatchingVisit& v = result.visits[k];
    out << k + 1 << ',' << csv_field(v.stage);
    for (const double x : v.design) out << ',' << exact(x);
    out << ',' << exact(v.objective) << ',' << exact(v.violation) << '\n';
  }
}

class MatchVerb : public Verb {
 public:
  std::string name() const override { return "match"; }
  std::string file_kind() const override { return "study"; }
  const KeyTable* study_table() const override { return &match_keys(); }
  std::string summary() const override { return "clearance, load, ... at which the pointing error is least"; }
  std::string example() const override { return "boresight match antenna/match.toml"; }
  std::string next(const Command&, bool) const override {
    return "boresight run MECHANISM with --set PATH=VALUE for each value found: that design's motion";
  }
  void declare_options(CLI::App& app) override { motion_.declare_model(app); }

  int execute(const Command& command) override {
    const Stopwatch watch;
    StudyInput input(command.file, command.settings);
    const Study& study = input.study;
    const std::shared_ptr<const Mechanism>& mechanism = input.mechanism;
    const MatchingPlan plan =
        read_matching_plan(input.root, study, mechanism->description(), input.trial, input.trial_all);
    check_rung_name(command.rung);
    const RunOptions asked = run_options(command.rung, *mechanism);

    nlohmann::json options = motion_.identity();
    if (study.accuracy) options["study_accuracy"] = *study.accuracy;
    const VerbStudy own(command, mechanism, study.index, study.accuracy, asked,
                        identity_of_study(command, *mechanism, plan.sample_text(study), options));
    const OutputDirectory& out = own.out();

    const double designs = designs_asked_for(plan);
    RungChoice choice = own.run().rung_of_designs(designs_tried(plan, *mechanism, designs), "evaluations.db");
    if (asks_how_contacts_move(plan) && integrator_names(choice.name).empty()) {
      if (command.rung != "auto")
        throw InputError({}, "--rung", in_quotes(command.rung),
                         "perturbation, multibody or auto: journals at rest make no impacts and no flights");
      choice = {.name = next_rung_up(choice.name, *mechanism),
                .why = "impacts, flights and peaks are asked for, of which journals at rest know nothing"};
    }
    const std::string upper = next_rung_up(choice.name, *mechanism);
    const auto parameters_of = [mechanism, &plan](std::span<const double> values) {
      return plan.parameters_with(*mechanism, values);
    };
    const double accuracy = command.accuracy ? *command.accuracy : study.accuracy.value_or(0.01);
    DesignsAsked designs_asked{.mechanism = mechanism,
                               .parameters_of = parameters_of,
                               .index = study.index,
                               .run = asked,
                               .corners = median_motions(plan, *mechanism),
                               .scene_varies = any_scene_varies(plan),
                               .accuracy = accuracy,
                               .samples = plan.inputs && plan.objective.over != Over::nominal,
                               .peak_acceleration = asks_peak_acceleration(plan)};
    const DesignModel designs_model = design_model(choice, designs_asked);
    const SampleModel& model = *designs_model.samples;
    std::vector<std::string> names;
    for (const DesignVariable& v : plan.variables) names.push_back(v.name());
    // What designs' values hang on beside rung and step.
    const auto model_text = [&](const SampleModel& m) {
      return fmt::format("{}, accuracy {:g}", m.batch() > 1 ? "lanes" : "runs", accuracy);
    };
    const auto store =
        own.run().open_evaluations("evaluations.db", names, model.rung(), model.step(), model_text(model));
    if (choice.pilot) note_choice(*store, choice);
    const RandomInputs* inputs = plan.inputs ? &*plan.inputs : nullptr;
    DesignEvaluator evaluator(model, inputs, store.get(),
                              {.samples = plan.samples, .seed = plan.seed, .jobs = command.jobs, .interrupted = [] {
                                 return interrupted();
                               }});

    // On the same rung only other random numbers confirm; where nothing scatters there is nothing to confirm
    // with.
    std::unique_ptr<SampleModel> upper_model;
    std::unique_ptr<EvaluationStore> upper_store;
    std::unique_ptr<DesignEvaluator> upper_evaluator;
    if (upper != choice.name || plan.inputs) {
      RungChoice upper_choice{upper, "confirms"};
      upper_model = std::move(design_model(upper_choice, designs_asked).samples);
      upper_store =
          own.run().open_evaluations("confirmation.db", names, upper, upper_model->step(), model_text(*upper_model));
      upper_evaluator =
          std::make_unique<DesignEvaluator>(*upper_model, inputs, upper_store.get(),
                                            DesignEvaluator::Options{.samples = plan.confirm,
                                                                     .seed = plan.seed + kFreshSeed,
                                                                     .jobs = command.jobs,
                                                                     .interrupted = [] { return interrupted(); },
                                                                     .landed = {}});
    }

    if (!command.quiet) {
      tell("{}: {}, {} on the {} rung, {} per design{}\n", mechanism->name(),
           how_many(plan.variables.size(), "variable"), plan.objective.title(study.index), choice.name,
           plan.samples == 1 ? "one run" : fmt::format("{} runs", plan.samples),
           store->size() > 0 ? fmt::format("; {} designs known already", store->size()) : "");
      std::fflush(stdout);
    }
    const std::unique_ptr<Stage> stage = own.run().stage(designs, "designs");
    MatchingOptions how;
    how.accuracy = accuracy;
    how.shown = [&](double value, double beside) { return objective_text(plan, study.index, value, beside); };
    how.interrupted = [] { return interrupted(); };
    how.progress = [&](const MatchingResult& r) {
      std::string estimate = r.visits.back().stage;
      if (!r.design.empty())
        estimate += "; best so far " + objective_text(plan, study.index, r.objective, r.objective) + " at " +
                    design_text(plan, r.design);
      stage->update(std::min(designs, static_cast<double>(r.visits.size())), estimate);
    };
    how.no_slopes = choice.name == "perturbation" ? why_no_slopes(plan) : "slopes are those of the perturbation rung";
    if (how.no_slopes.empty())
      how.slopes = [slopes = DesignSlopes(mechanism, plan, study.index, designs_model.run)](
                       const std::vector<double>& design, std::string& why) { return slopes.at(design, why); };
    const MatchingResult result = run_matching(plan, evaluator, upper_evaluator.get(), upper, how);
    stage->clear();
    MatchStudy matched{.command = command,
                       .study = study,
                       .mechanism = *mechanism,
                       .rung = choice,
                       .plan = plan,
                       .result = result,
                       .warnings = warnings_of(plan, result),
                       .leaves_out = model.leaves_out()};
    const auto add_failed = [&](const DesignEvaluator& runs, const std::string& rung) {
      if (runs.failures().count > 0)
        matched.warnings.push_back(
            fmt::format("{} of {} runs on the {} rung failed", runs.failures().count, runs.runs(), rung) +
            first_failure_text(runs.failures(), "run"));
    };
    add_failed(evaluator, choice.name);
    if (upper_evaluator) add_failed(*upper_evaluator, upper);
    for (const std::string& one : study_warnings(*mechanism, choice.name)) matched.warnings.push_back(one);
    if (!store->damage().empty()) matched.warnings.push_back(store->damage());
    Json summary = summary_of(matched, own, watch, store->earlier());
    add_first_failure(summary, evaluator.failures(), "run");
    write_json(out, "summary.json", summary);
    out.write("evaluations.csv", [&](std::ostream& s) { write_evaluations(s, plan, result); });
    write_report(out, match_report(matched));
    out.publish();
    if (!command.quiet) print(matched, out);
    if (result.interrupted) return kInterrupted;
    if (result.design.empty() || evaluator.failures().count == evaluator.runs())
      return failed(command, "no design could be evaluated" + first_failure_text(evaluator.failures(), "run"));
    return result.feasible && result.converged && result.confirmed() ? kDone : kAnswerIsNo;
  }

 private:
  static constexpr std::uint64_t kFreshSeed = 1'000'003;

  static std::vector<std::string> warnings_of(const MatchingPlan& plan, const MatchingResult& result) {
    std::vector<std::string> warnings;
    if (!result.feasible && !result.design.empty())
      warnings.push_back("no design was found that keeps all constraints; the one given breaks them least");
    if (!result.converged && !result.interrupted)
      warnings.push_back("the descent ended before it came to rest; more evaluations may find better");
    for (const MatchingDescent& d : result.descents)
      if (!d.agrees)
        warnings.push_back(fmt::format("the descent from {} ended at {}, a worse place than the optimum", d.from,
                                       design_text(plan, d.end)));
    for (std::size_t i = 0; i < result.at_bound.size(); ++i)
      if (result.at_bound[i] && !ends_at_nothing(plan.variables[i], result.design[i]))
        warnings.push_back(plan.variables[i].name() + " lies at its bound: better values may lie beyond");
    for (const MatchingConfirmation& c : result.confirmation)
      if (!c.agrees) warnings.push_back("the confirmation disagrees: " + c.sentence);
    return warnings;
  }

  static Json summary_of(const MatchStudy& s, const VerbStudy& own, const Stopwatch& watch,
                         const SampleStore::Cost& earlier) {
    const MatchingResult& r = s.result;
    Json json = own.head(s.study, s.rung, watch, s.warnings, r.interrupted, earlier);
    json["seed"] = s.plan.seed;
    json["optimum"] = design_json(s.plan, r.design);
    json["objective"] = r.design.empty() ? Json() : number_json(r.objective);
    json["objective_of"] = {{"measure", s.plan.objective.key()},
                            {"title", s.plan.objective.title(s.study.index)},
                            {"unit", s.plan.objective.si_unit(s.study.index)},
                            {"low", number_json(r.interval.low)},
                            {"high", number_json(r.interval.high)},
                            {"confidence", r.interval.confidence}};
    json["converged"] = r.converged;
    json["feasible"] = r.feasible;
    json["violation"] = number_json(r.violation);
    json["evaluations"] = r.evaluations;
    json["evaluations_reused"] = r.reused;
    json["samples_per_design"] = s.plan.samples;
    json["algorithm"] = {{"global", r.global}, {"local", r.local}, {"why", r.why}};
    if (!r.as_good_from.empty())
      json["as_good"] = {{"from", design_json(s.plan, r.as_good_from)}, {"to", design_json(s.plan, r.as_good_to)}};
    json["constraints"] = Json::array();
    for (std::size_t k = 0; k < r.constraint_values.size(); ++k)
      json["constraints"].push_back(
          {{"measure", s.plan.constraints[k].measure.key()},
           {"value", number_json(r.constraint_values[k])},
           {"rung", rung_of_optimum(s)},
           {"confirmed", r.confirmation.empty() ? Json() : number_json(r.confirmation.front().constraint_values[k])},
           {"confirmed_rung", r.confirmation.empty() ? Json() : Json(r.confirmation.front().rung)},
           {"at_most", s.plan.constraints[k].at_most},
           {"active", static_cast<bool>(r.active[k])}});
    json["descents"] = Json::array();
    for (const MatchingDescent& d : r.descents)
      json["descents"].push_back({{"from", d.from},
                                  {"start", design_json(s.plan, d.start)},
                                  {"end", design_json(s.plan, d.end)},
                                  {"objective", number_json(d.objective)},
                                  {"evaluations", d.evaluations},
                                  {"converged", d.converged},
                                  {"same_answer", d.agrees}});
    json["front"] = Json::array();
    for (const FrontPoint& p : r.front)
      json["front"].push_back(
          {{"design", design_json(s.plan, p.design)}, {"index", p.index}, {"free_flight_share", p.free_flight_share}});
    if (!r.confirmation.empty()) {
      const MatchingConfirmation& c = r.confirmation.front();
      json["confirmation"] = {{"rung", c.rung},
                              {"seed", c.seed},
                              {"samples", c.samples},
                              {"failed", c.failed},
                              {"value", number_json(c.value)},
                              {"low", number_json(c.interval.low)},
                              {"high", number_json(c.interval.high)},
                              {"agrees", c.agrees},
                              {"went_on", c.went_on},
                              {"sentence", c.sentence}};
    }
    json["files"] = {"summary.json", "evaluations.csv", "evaluations.db", "report.html", "report.json"};
    return json;
  }

  static void print(const MatchStudy& s, const OutputDirectory& out) {
    tell("{}\n", match_sentence(s));
    tell("  {}; {} designs computed, {} reused{}{}\n", search_text(s.result), s.result.evaluations, s.result.reused,
         s.result.why.empty() ? "" : "; ", s.result.why);
    for (const MatchingDescent& d : s.result.descents)
      tell("  from {}: {} -> {}, {}{}\n", d.from, design_text(s.plan, d.start), design_text(s.plan, d.end),
           objective_text(s.plan, s.study.index, d.objective, s.result.objective), d.agrees ? ", the same answer" : "");
    tell_warnings(s.warnings, s.command, s.mechanism);
    if (s.result.interrupted) tell("  interrupted; what was computed is kept, the same command goes on\n");
    tell("  report: {}\n", (out.path() / "report.html").string());
  }

  // What journals at rest do not read, the rung that confirms does.
  RunOptions run_options(const std::string& rung, const Mechanism& mechanism) const {
    if (rung == "auto") return motion_.run_options(mechanism, rung);
    const std::string upper = next_rung_up(rung, mechanism);
    std::vector<std::string> read_above;
    for (const char* option : {"step", "integrator", "tolerance", "formulation", "stabilisation"})
      if (why_unread(option, upper).empty()) read_above.emplace_back(option);
    RunOptions options = motion_.run_options(mechanism, rung, read_above);
    if (integrator_names(rung).empty()) check_run_options(options, upper, mechanism);
    return options;
  }

  MotionOptions motion_;
};

}  // namespace

std::unique_ptr<Verb> make_match_verb() { return std::make_unique<MatchVerb>(); }

}  // namespace boresight::app
