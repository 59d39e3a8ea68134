// The [[budget.part]] tables: sub-budgets.
#pragma once

#include "boresight/io/cursor.hpp"
#include "boresight_analyses/budget/budget_plan.hpp"

namespace boresight {

// Into a plan whose contributors are read already. `unit`: of the index. Throws InputError.
void read_parts(Cursor& budget, BudgetPlan& plan, const SiUnit& unit);

}  // namespace boresight
