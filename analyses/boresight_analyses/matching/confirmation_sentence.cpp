#include "boresight_analyses/matching/confirmation_sentence.hpp"

#include <cmath>
#include <cstdio>

namespace boresight {
namespace {

std::string limits_broken(const std::vector<MatchingConstraint>& constraints, const std::vector<Outcome>& outcomes,
                          double accuracy) {
  std::string broken;
  for (const MatchingConstraint& k : constraints) {
    const double beyond = excess(k, outcomes);
    if (!(beyond > accuracy) || !std::isfinite(k.measure.of(outcomes))) continue;
    char text[80];
    std::snprintf(text, sizeof text, "%s%s is %.3g %% beyond its limit there", broken.empty() ? ", and " : ", ",
                  k.measure.key().c_str(), 100.0 * beyond);
    broken += text;
  }
  return broken;
}

}  // namespace

double excess(const MatchingConstraint& constraint, const std::vector<Outcome>& outcomes) {
  constexpr double kFailedExcess = 1e3;
  const double value = constraint.measure.of(outcomes);
  return std::isfinite(value) ? value / constraint.at_most - 1.0 : kFailedExcess;
}

std::string confirmation_sentence(const MatchingConfirmation& c, const std::vector<MatchingConstraint>& constraints,
                                  const std::vector<Outcome>& outcomes, double accuracy, double searched, bool feasible,
                                  const std::function<std::string(double)>& shown) {
  const std::string by = c.rung + " with seed " + std::to_string(c.seed);
  if (!std::isfinite(c.value))
    return by + " has no value to hold against the search's " + shown(searched) + ", as " + std::to_string(c.failed) +
           " of its " + std::to_string(c.samples) + (c.samples == 1 ? " run failed" : " runs failed") +
           ": the optimum is not confirmed";
  const std::string both = by + " gives " + shown(c.value) + " where the search had " + shown(searched) + ": ";
  if (c.agrees) return both + "within what samples and accuracy leave open";
  return both + "they disagree" + (feasible ? limits_broken(constraints, outcomes, accuracy) : "");
}

}  // namespace boresight
