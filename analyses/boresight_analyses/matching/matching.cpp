#include "boresight_analyses/matching/matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight_analyses/matching/confirmation_sentence.hpp"
#include "boresight_analyses/matching/matching_under_way.hpp"

namespace boresight {
namespace {

// A descent begins with steps this large, as a share of the ranges: impacts make the objective rough at a
// small scale.
constexpr double kFirstStep = 0.2;

}  // namespace

MatchingResult MatchingUnderWay::run(DesignEvaluator* confirm, const std::string& rung) {
  try {
    search();
    if (result_.design.empty()) return result_;  // no design answered, and the failures say why
    draw_map();
    take_from_map();
    judge_descents();
    seek_front();
    if (confirm != nullptr) confirm_on(*confirm, rung);
  } catch (const EvaluationInterrupted&) {
    result_.interrupted = true;
    result_.converged = false;
    if (result_.design.empty()) best_of_visits();
  }
  if (!result_.design.empty()) describe(*evaluator_);
  return result_;
}

std::vector<double> MatchingUnderWay::design_at(std::span<const double> x) const {
  std::vector<double> design;
  for (std::size_t i = 0; i < x.size(); ++i) design.push_back(plan_.variables[i].from_search(x[i]));
  return design;
}

std::vector<double> MatchingUnderWay::place_of(const std::vector<double>& design) const {
  std::vector<double> x;
  for (std::size_t i = 0; i < design.size(); ++i) x.push_back(plan_.variables[i].to_search(design[i]));
  return x;
}

MatchingVisit MatchingUnderWay::visit(const std::vector<double>& design) {
  const std::vector<Outcome>& outcomes = evaluator_->at(design);
  MatchingVisit v{.design = design, .objective = plan_.objective.of(outcomes), .violation = 0.0, .stage = stage_};
  for (const MatchingConstraint& c : plan_.constraints) v.violation = std::max(v.violation, excess(c, outcomes));
  if (std::isfinite(v.objective)) largest_ = std::max(largest_, std::abs(v.objective));
  result_.visits.push_back(v);
  result_.evaluations = evaluator_->computed();
  result_.reused = evaluator_->reused();
  if (options_.progress) options_.progress(result_);
  return v;
}

MinimisationProblem MatchingUnderWay::problem(const MeasureChoice* objective, const MatchingConstraint* further) {
  MinimisationProblem p;
  for (const DesignVariable& v : plan_.variables) {
    p.lower.push_back(v.to_search(v.from));
    p.upper.push_back(v.to_search(v.to));
  }
  p.objective = [this, objective](std::span<const double> x, std::span<double> gradient) {
    const MatchingVisit v = visit(design_at(x));
    if (!gradient.empty()) slopes_at(x, v.design, gradient);
    const double value = objective ? objective->of(evaluator_->at(v.design)) : v.objective;
    // Before any design has answered nothing is known of how large answers are.
    constexpr double kNoneYet = 1e3;
    return std::isfinite(value) ? value : largest_ > 0.0 ? 10.0 * largest_ : kNoneYet;
  };
  for (const MatchingConstraint& c : plan_.constraints)
    p.constraints.push_back(
        [this, &c](std::span<const double> x, std::span<double>) { return excess(c, evaluator_->at(design_at(x))); });
  if (further)
    p.constraints.push_back([this, further](std::span<const double> x, std::span<double>) {
      return excess(*further, evaluator_->at(design_at(x)));
    });
  return p;
}

void MatchingUnderWay::slopes_at(std::span<const double> x, const std::vector<double>& design,
                                 std::span<double> gradient) {
  const std::optional<std::vector<double>> slopes = options_.slopes(design, no_slopes_);
  if (!slopes) throw NoSlopes{};
  for (std::size_t i = 0; i < x.size(); ++i) gradient[i] = (*slopes)[i] * plan_.variables[i].slope_of_search(x[i]);
}

MinimisationOptions MatchingUnderWay::search_options(bool global, int evaluations) const {
  return {.global = global ? plan_.global : "none",
          .local = global ? "none" : plan_.local,
          .global_evaluations = evaluations,
          .local_evaluations = evaluations,
          .tolerance = plan_.tolerance,
          .constraint_tolerance = 1e-6,
          .initial_step = kFirstStep,
          .seed = plan_.seed,
          .interrupted = options_.interrupted};
}

Minimum MatchingUnderWay::descend(const std::vector<double>& from, const std::string& name, int evaluations) {
  stage_ = "descent from " + name;
  MinimisationProblem p = problem(nullptr, nullptr);
  p.start = place_of(from);
  MinimisationOptions o = search_options(false, evaluations);
  Minimum m;
  p.gradients = options_.slopes && no_slopes_.empty() && (plan_.local == "auto" || plan_.wants_gradients());
  if (!p.gradients && plan_.wants_gradients()) o.local = "auto";
  try {
    m = minimise(p, o);
  } catch (const NoSlopes&) {
    p.gradients = false;
    o.local = "auto";
    m = minimise(p, o);
  }
  if (m.interrupted) throw EvaluationInterrupted{};
  result_.descents.push_back({name, from, design_at(m.x), m.objective, m.evaluations, m.converged, false, m.local});
  result_.local = m.local;
  take(m);
  return m;
}

void MatchingUnderWay::take(const Minimum& m) {
  const bool answered = std::isfinite(plan_.objective.of(evaluator_->at(design_at(m.x))));
  const bool better = answered && (result_.design.empty() || m.violation < result_.violation ||
                                   (m.violation == result_.violation && m.objective < result_.objective));
  if (better) {
    result_.design = design_at(m.x);
    result_.objective = m.objective;
    result_.violation = m.violation;
    result_.converged = m.converged;
    result_.feasible = m.violation <= 1e-6;
  }
}

std::string MatchingUnderWay::shown(double value, double beside) const {
  if (options_.shown) return options_.shown(value, beside);
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

void MatchingUnderWay::search() {
  if (plan_.local == "none") result_.local = "none";
  const std::vector<std::vector<double>> starts = plan_.starts();
  if (plan_.global != "none") {
    stage_ = "search of the box";
    MinimisationProblem p = problem(nullptr, nullptr);
    p.start = place_of(starts.front());
    const Minimum m = minimise(p, search_options(true, plan_.evaluations));
    if (m.interrupted) throw EvaluationInterrupted{};
    result_.global = m.global;
    result_.why = m.why.substr(0, m.why.find("; the descent"));
    if (plan_.local == "none")
      take(m);  // it is the whole search, and knows whether it was exhausted
    else
      descend(design_at(m.x), "the box", plan_.evaluations);
  } else {
    result_.global = "none";
    result_.why = "no search of the whole box was asked for";
  }
  for (std::size_t k = 0; k < starts.size(); ++k)
    descend(starts[k], "start " + std::to_string(k + 1), plan_.evaluations);
  // Any place seen on the way counts, the corners of the search included.
  best_of_visits();
  if (result_.local == "none") return;
  result_.why += "; then " + result_.local;
  if (result_.local == "slsqp" || result_.local == "mma") {
    result_.why += ", which goes by gradients: every motion on the way had exact slopes to its end";
    return;
  }
  result_.why +=
      result_.local == "bobyqa" ? ", which models the objective by a quadratic" : ", which needs no gradients";
  result_.why += ": " + (no_slopes_.empty() ? options_.no_slopes : no_slopes_);
}

void MatchingUnderWay::best_of_visits() {
  for (const MatchingVisit& v : result_.visits) {
    if (!std::isfinite(v.objective)) continue;
    const bool keeps = v.violation <= 1e-6;
    const bool better = result_.design.empty() || (keeps && !result_.feasible) ||
                        (keeps && v.objective < result_.objective) ||
                        (!keeps && !result_.feasible && v.violation < result_.violation);
    if (!better) continue;
    result_.design = v.design;
    result_.objective = v.objective;
    result_.violation = v.violation;
    result_.feasible = keeps;
  }
}

void MatchingUnderWay::describe(DesignEvaluator& evaluator) {
  for (std::size_t i = 0; i < plan_.variables.size(); ++i) {
    const DesignVariable& v = plan_.variables[i];
    const double low = v.to_search(v.from), high = v.to_search(v.to), at = v.to_search(result_.design[i]);
    const double margin = 1e-3 * (high - low);
    result_.at_bound.push_back(at < low + margin || at > high - margin);
  }
  if (result_.on_confirming_rung) return;
  describe_constraints(evaluator);
  result_.interval = plan_.objective.interval(evaluator.at(result_.design), options_.confidence);
}

MatchingResult run_matching(const MatchingPlan& plan, DesignEvaluator& evaluator, DesignEvaluator* confirm,
                            const std::string& confirming_rung, const MatchingOptions& options) {
  return MatchingUnderWay(plan, evaluator, options).run(confirm, confirming_rung);
}

}  // namespace boresight
