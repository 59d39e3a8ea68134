// The classical table of one index, in all interpretations: a line per clearance joint, group of parameters, known error and contributor.
//
// Lines of groups that not all members were run without are known by the members of the attribution; how far what the rule makes of them
// would scatter with others is seen by the bootstrap over these.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight_analyses/budget/classical.hpp"
#include "boresight_analyses/budget/group_parts.hpp"
#include "boresight_analyses/budget/member_bootstrap.hpp"

namespace boresight {

struct ClassicalTable {
  ErrorIndex index = ErrorIndex::ape;
  Interpretation interpretation = Interpretation::mixed;
  std::vector<ClassicalLine> lines;
  ClassicalTotal total;
  std::vector<ClassicalTotal> resampled =
      {};                   // with other members of the attribution; empty where no line hangs on them
  std::size_t members = 0;  // those of the attribution that do have such lines

  // At the rule's level of one axis, or of all: BudgetAxes::count().
  double by_rule(std::size_t axis, double probability) const { return level_of(total, axis, probability); }
  MemberInterval rule_interval(std::size_t axis, double probability, double confidence) const;

 private:
  double level_of(const ClassicalTotal& of, std::size_t axis, double probability) const {
    return axis < of.axes.size() ? of.axis_level(axis, probability) : of.radius_by_rule(interpretation, probability);
  }
};

// What lines are made of but for the plan.
struct ClassicalParts {
  const BudgetAxes& axes;
  const std::vector<std::string>&joints, &kinds;  // of the joints with clearance; of groups
  const std::vector<PointingHistory>& alone;      // per joint
  const GroupParts& groups;
};

// In the order of kInterpretations.
std::vector<ClassicalTable> classical_tables(const BudgetPlan& plan, const ClassicalParts& parts, ErrorIndex index,
                                             const Windows& windows);

}  // namespace boresight
