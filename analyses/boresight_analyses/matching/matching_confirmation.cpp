// The optimum put to other random numbers, on the next rung up; where that disagrees a descent goes on there.
#include <algorithm>
#include <cmath>

#include "boresight_analyses/matching/confirmation_sentence.hpp"
#include "boresight_analyses/matching/matching_under_way.hpp"

namespace boresight {

void MatchingUnderWay::confirm_on(DesignEvaluator& confirm, const std::string& rung) {
  MatchingConfirmation c;
  c.rung = rung;
  c.seed = confirm.options().seed;
  c.samples = confirm.options().samples;
  const std::vector<Outcome>& outcomes = confirm.at(result_.design);
  c.value = plan_.objective.of(outcomes);
  c.interval = plan_.objective.interval(outcomes, options_.confidence);
  c.design = result_.design;
  c.objective = c.value;
  c.failed = static_cast<std::size_t>(std::count_if(
      outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.status != Outcome::Status::done; }));
  const double off = std::abs(c.value - result_.objective);
  bool keeps = true;
  for (const MatchingConstraint& k : plan_.constraints) keeps = keeps && excess(k, outcomes) <= options_.accuracy;
  c.agrees = std::isfinite(off) && keeps == result_.feasible &&
             plan_.objective.may_be_alike(evaluator_->at(result_.design), outcomes, options_.confidence,
                                          options_.accuracy * std::abs(c.value));
  c.sentence = confirmation_sentence(c, plan_.constraints, outcomes, options_.accuracy, result_.objective,
                                     result_.feasible, [&](double value) { return shown(value, result_.objective); });
  if (!c.agrees && std::isfinite(off)) {
    // On from there, on the better rung.
    DesignEvaluator* before = evaluator_;
    evaluator_ = &confirm;
    if (options_.slopes) no_slopes_ = "slopes are those of the perturbation rung";
    const MatchingResult cheap = result_;
    result_.design.clear();
    const std::size_t visits_before = result_.visits.size();
    try {
      descend(cheap.design, "the optimum, on " + rung, std::max(8, plan_.evaluations / 3));
      if (result_.design.empty()) result_.design = cheap.design;  // no run there has answered
    } catch (const EvaluationInterrupted&) {
      // What was found before, on its own rung, stands.
      evaluator_ = before;
      result_ = cheap;
      throw;
    }
    c.went_on = result_.design != cheap.design;
    c.design = result_.design;
    c.objective = result_.objective;
    c.sentence += c.went_on ? "; a descent there moved the optimum" : "; a descent there stays where it is";
    // What was as good by the rung before says nothing of this one's.
    find_as_good(visits_before);
    evaluator_ = before;
    result_.descents.back().agrees = true;
    result_.on_confirming_rung = true;
    describe_constraints(confirm);
    result_.interval = plan_.objective.interval(confirm.at(result_.design), options_.confidence);
    result_.evaluations += confirm.computed();
    result_.reused += confirm.reused();
  }
  c.constraint_values = constraints_of(confirm);
  result_.confirmation.push_back(c);
}

std::vector<double> MatchingUnderWay::constraints_of(DesignEvaluator& evaluator) const {
  std::vector<double> values;
  const auto& outcomes = evaluator.at(result_.design);
  for (const MatchingConstraint& c : plan_.constraints) values.push_back(c.measure.of(outcomes));
  return values;
}

void MatchingUnderWay::describe_constraints(DesignEvaluator& evaluator) {
  result_.constraint_values = constraints_of(evaluator);
  result_.active.clear();
  for (std::size_t k = 0; k < plan_.constraints.size(); ++k)
    result_.active.push_back(result_.constraint_values[k] > 0.99 * plan_.constraints[k].at_most);
}

}  // namespace boresight
