// The headline's level if one thing were better: with a clearance halved, a group held, a known error taken off, half of a contributor.
//
// What adds up is taken off the history of every member; other things take runs of their own, which the members of the attribution have.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/budget/group_parts.hpp"
#include "boresight_analyses/budget/member_bootstrap.hpp"

namespace boresight {

struct ErrorReduction {
  std::string name, action;
  double before = 0.0, after = 0.0;  // of these members
  std::uint64_t members = 0;
  // Of the gain, at the plan's confidence. Without an upper end where the members are too few for the level's probability: what none of
  // them has shown, no bootstrap over them sees.
  MemberInterval interval = {};
  double gain() const { return before - after; }
};

// What the reductions are made of but for the plan.
struct ReductionParts {
  const BudgetAxes& axes;
  const BudgetRequirement& headline;
  const std::vector<std::string>& joints;
  const BudgetRuns& runs;
  const BudgetEnsemble& ensemble;
  const GroupParts& groups;
  const std::vector<PointingHistory>& totals;  // of the members that did not fail
  const std::vector<std::uint64_t>& members;   // their numbers
  std::uint64_t again;  // members with this number or a higher one have no runs without something
};

// Largest gain first.
std::vector<ErrorReduction> error_reductions(const BudgetPlan& plan, const ReductionParts& parts);

}  // namespace boresight
