// What the standing errors of a budget do over its histories: its contributors that are errors, and the errors that are known.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/budget/budget_plan.hpp"

namespace boresight {

// Fills in ErrorCourse::by_course and by_value of the plan's contributors, BudgetPlan::known and BudgetPlan::by_parameter. Gives a sentence for each known error
// whose part cannot be told: it then stays within the other lines. Throws ComputationError where a contributor's error has no
// column of influence: the mechanism cannot take it up, or freedoms are left that nothing drives.
std::vector<std::string> follow_errors(BudgetPlan& plan, const Mechanism& mechanism, PointingQuantity quantity);

}  // namespace boresight
