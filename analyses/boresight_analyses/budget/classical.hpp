// The classical table: contributors by their moments, added up by rule (ECSS-E-ST-60-10C, 5.2; Annex A.2).
//
//   means add linearly; those that may come with either sign add to the size of the others' sum
//   standard deviations linearly within a group of correlated contributors, and groups (and those
//   that belong to none) by the root of the sum of squares, or by their coefficients where they are correlated
//   one axis:   |mean| + n_P sd
//   half cone:  sd sqrt(-2 ln(1 - P)), sd the root mean square of the axes', as if there were no mean; of the ensemble
//               interpretation, whose means are those of maxima, the root of the sum of the axes' levels squared
//
// The rules hold for Gaussian errors without a mean across. Whether they did is only seen against a simulation.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/budget/contributor.hpp"
#include "boresight_analyses/budget/member_bootstrap.hpp"

namespace boresight {

struct ClassicalLine {
  std::string name, kind, group;
  std::vector<Moments> axes;
  std::optional<Mat3> factor = {};  // B with B B^T the covariance of its axes; none: they are independent
  std::optional<Draws> draws = {};  // of a contributor; what has none is independent of all but its group
  bool either_sign = false;         // its means are sizes (AxesMoments)
  bool of_all_members = true;       // of a group: known of every member, not of some of them alone
};

struct ClassicalTotal {
  std::vector<Moments> axes;
  Mat3 covariance = Mat3::Zero();  // of the axes, the squares of their deviations on its diagonal

  double axis_level(std::size_t axis, double probability) const;
  double radius_by_rule(Interpretation interpretation, double probability) const;  // of two axes or three
  double radius_integrated(double probability) const;  // the Gaussian with these moments, mean and all (half_cone.hpp)
};
ClassicalTotal total_of(std::span<const ClassicalLine> lines);

// How a level by rule stands against what was simulated. in_doubt: other members may tell otherwise.
enum class RuleStanding { fair, unsafe, wasteful, in_doubt };
const char* to_string(RuleStanding standing);
inline constexpr double kUnsafeBelow = 0.98, kWastefulAbove = 1.2;  // times the simulated level
RuleStanding standing_of(double by_rule, double simulated);

// A level as the members seen have it, and where it may lie with others.
struct LevelOfMembers {
  double value = 0.0;
  MemberInterval interval = {};
};
// The rule over the simulation, from the least to the largest that the two intervals leave; the largest is infinite where they leave no bound.
MemberInterval rule_over_simulated(const MemberInterval& by_rule, const MemberInterval& simulated);
// Only as far as the members leave no doubt. Unsafe or wasteful: for every ratio that they leave. Fair: as the levels seen are, and by none of
// these ratios off by a fifth (kWastefulAbove) to either side; that a rule is not 2 % too low takes more members than any budget has. What is
// both below `nothing`, which rounding alone makes, is fair.
RuleStanding standing_of(const LevelOfMembers& by_rule, const LevelOfMembers& simulated, double nothing);

}  // namespace boresight
