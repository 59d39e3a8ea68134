// Shares of the headline's mean square from the mean squares and products of the members (budget.hpp says in what sense).
#pragma once

#include <cstdint>
#include <vector>

namespace boresight {

// Of the headline's index.
struct MemberProducts {
  std::vector<double> all, own;               // per member that did not fail
  std::vector<std::vector<double>> external;  // [contributor][member]
  // [group, then known error][member of the attribution with both runs]
  std::vector<std::vector<double>> change;
  // The same: of what adds up, the mechanism's own mean squares of the same members; empty of others.
  std::vector<std::vector<double>> of_same = {};
  std::vector<double> alone;  // [joint]: with the nominal motion; NaN where that joint's run failed
};

// In the order of joints, groups, known errors, external contributors, together; `times`: how often each member counts.
std::vector<double> shares(const MemberProducts& products, const std::vector<std::uint32_t>& times,
                           const std::vector<std::uint32_t>& times_of_attribution);

}  // namespace boresight
