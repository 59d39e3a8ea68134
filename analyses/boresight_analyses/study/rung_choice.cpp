#include "boresight_analyses/study/rung_choice.hpp"

#include <algorithm>
#include <cstdio>
#include <tuple>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/scene/geometric_errors.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"

namespace boresight {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

void check_rung_name(const std::string& asked) {
  const std::vector<std::string> names = rung_names();
  if (asked != "auto" && std::find(names.begin(), names.end(), asked) == names.end())
    throw InputError({"command line", 0}, "--rung", "\"" + asked + "\"", "auto, " + listed(names),
                     nearest_name(asked, names));
}

RungChoice most_demanding(const std::vector<RungChoice>& choices) {
  const std::vector<std::string> names = rung_names();  // cheapest first
  const auto demand = [&](const RungChoice& c) {
    // Where nothing deviates nothing was chosen.
    const auto rank = std::find(names.begin(), names.end(), c.name) - names.begin();
    return std::tuple(c.pilot.has_value(), rank, -c.step, -c.tolerance);
  };
  const auto most = std::max_element(choices.begin(), choices.end(),
                                     [&](const RungChoice& a, const RungChoice& b) { return demand(a) < demand(b); });
  RungChoice chosen = *most;
  const auto piloted = std::count_if(choices.begin(), choices.end(), [](const RungChoice& c) { return c.pilot; });
  if (choices.size() > 1 && chosen.pilot)
    chosen.why += "; this is the design that asks for most, of " + std::to_string(piloted) + " tried";
  const bool all_met =
      std::all_of(choices.begin(), choices.end(), [](const RungChoice& c) { return !c.pilot || c.pilot->met; });
  if (chosen.pilot && chosen.pilot->met && !all_met) chosen.why += ", and for another one the accuracy is not shown";
  return chosen;
}

void apply(const RungChoice& choice, RunOptions& options) {
  // The step is one of rk4's; an integrator that was asked for chooses its own.
  if (choice.step > 0.0 && !controls_error(options)) options.step = choice.step;
  // A tolerance without an integrator is that of lanes.
  if (choice.tolerance > 0.0) options.tolerance = choice.tolerance;
  if (!choice.integrator.empty()) options.integrator = choice.integrator;
}

std::string next_rung_up(const std::string& rung, const Mechanism& mechanism) {
  // Without play the others are all one: linear in the errors.
  if (GeometricErrors::serve(mechanism)) return rung_names().back();
  // Envelope and quasistatic are both static answers; what confirms either is a motion with impacts.
  if (rung == "envelope" || rung == "quasistatic") return "perturbation";
  return rung_names().back();
}

RunOptions options_on(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                      const std::vector<Parameters>& motions, RunOptions run) {
  const std::vector<std::string> known = integrator_names(rung);
  if (!run.integrator.empty() && std::find(known.begin(), known.end(), run.integrator) == known.end()) {
    run.integrator.clear();
    run.tolerance = 0.0;
  }
  const bool adaptive = !run.integrator.empty() && run.integrator != "rk4";
  if (!adaptive && run.step == 0.0) run.step = common_step(rung, mechanism, motions, run);
  return run;
}

RungChoice choose_rung(const RungQuestion& question, std::shared_ptr<const Mechanism> mechanism,
                       const std::vector<Parameters>& samples) {
  check_rung_name(question.asked);
  if (question.asked != "auto") {
    RungChoice named{question.asked, "asked for by name"};
    if (question.accuracy) {
      char text[100];
      std::snprintf(text, sizeof text,
                    ": no pilot has compared it with multibody, to hold it against the %.3g %% asked for",
                    100.0 * *question.accuracy);
      named.why += text;
    }
    return named;
  }
  const std::string most_exact = rung_names().back();  // cheapest first, so the last one leaves out least
  if (question.wants_multibody) return {most_exact, "the only rung that has the options given"};
  if (mechanism->clearances() == 0 && !samples.empty() && std::none_of(samples.begin(), samples.end(), has_errors))
    return {most_exact, "no joint has clearance and no error is other than zero: nothing to choose between"};
  if (!question.accuracy)
    return {most_exact, "the rung that leaves out least; give an accuracy to have the cheapest that meets it"};
  PilotOptions options{.accuracy = *question.accuracy,
                       .index = question.index,
                       .statistic = question.statistic,
                       .step = question.step,
                       .integrator = question.integrator,
                       .tolerance = question.tolerance,
                       .integrators = question.integrators,
                       .lanes = question.lanes,
                       .scene_varies = question.scene_varies,
                       .runs = question.runs,
                       .jobs = question.jobs,
                       .progress = question.progress};
  RungChoice choice;
  choice.pilot = run_pilot(std::move(mechanism), samples, options);
  const PilotTrial& chosen = choice.pilot->trials[choice.pilot->chosen];
  choice.name = chosen.rung;
  choice.why = choice.pilot->why;
  choice.step = chosen.step;
  choice.integrator = chosen.integrator;
  choice.tolerance = chosen.tolerance;
  return choice;
}

}  // namespace boresight
