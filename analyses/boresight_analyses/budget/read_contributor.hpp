// [[budget.contributor]]: an error from outside by its class, or a standing error of the mechanism over time.
#pragma once

#include "boresight_analyses/budget/budget_plan.hpp"

namespace boresight {

// `plan`: whose times and [[random]] parameters are read already. Throws InputError.
Contributor read_contributor(Cursor& table, const BudgetPlan& plan, PointingQuantity quantity,
                             const MechanismDescription& mechanism);

}  // namespace boresight
