// What the confirmation of an optimum says, in words.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight_analyses/matching/matching.hpp"

namespace boresight {

// How far these outcomes are beyond a limit, relative to it; far where they have no value.
double excess(const MatchingConstraint& constraint, const std::vector<Outcome>& outcomes);

// Of a confirmation whose numbers are there. outcomes: those of its rung. searched: what the search had; feasible: whether it kept all limits.
// shown: a value as a reader is shown it.
std::string confirmation_sentence(const MatchingConfirmation& confirmation,
                                  const std::vector<MatchingConstraint>& constraints,
                                  const std::vector<Outcome>& outcomes, double accuracy, double searched, bool feasible,
                                  const std::function<std::string(double)>& shown);

}  // namespace boresight
