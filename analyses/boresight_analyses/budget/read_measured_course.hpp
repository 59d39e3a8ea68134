// The measured course of a [[budget.contributor]]:
//
//   measured = { file = "floor.csv", time = "t", columns = ["x", "y"], unit = "arcsec", ends = "repeated", begin = "anywhere" }
#pragma once

#include <memory>

#include "boresight/io/cursor.hpp"
#include "boresight_analyses/budget/budget_plan.hpp"

namespace boresight {

// On the plan's grid. `axes`: of the columns, in their order. `si_unit`: of the index. Throws InputError.
std::shared_ptr<const MeasuredCourse> read_measured_course(Cursor& contributor, const BudgetPlan& plan,
                                                           const std::vector<std::size_t>& axes,
                                                           const std::string& si_unit);

}  // namespace boresight
