// How contributors, and the axes of one, depend on each other; and the frame that a contributor is given in.
#pragma once

#include "boresight/io/cursor.hpp"
#include "boresight_analyses/budget/budget_plan.hpp"

namespace boresight {

// The [[budget.correlation]] tables, into a plan whose contributors are read already. Throws InputError.
void read_correlations(Cursor& budget, BudgetPlan& plan);

// frame and axis_correlation of a contributor's table. Throws InputError.
void read_frame(Cursor& contributor, const BudgetAxes& axes, Contributor& c);

}  // namespace boresight
