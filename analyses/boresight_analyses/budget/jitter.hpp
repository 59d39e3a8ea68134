// Jitter by exposure time: what RPE comes to over windows from two samples of the histories to an observation.
#pragma once

#include <vector>

#include "boresight_analyses/budget/budget_plan.hpp"
#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

struct JitterCurve {
  BudgetRequirement asked;              // axis, interpretation and probability; its limit and exposure mean nothing
  std::vector<double> exposure;         // ascending [s]
  std::vector<ReportedInterval> level;  // at the plan's confidence
};

inline constexpr std::size_t kMembersOfCurve = 200;  // at most

// One for each axis, interpretation and probability that a requirement by exposure time has. `totals`: histories of the members, of which
// the first ones stand for all. `axes`: of the error.
std::vector<JitterCurve> jitter_curves(const BudgetPlan& plan, const std::vector<PointingHistory>& totals,
                                       std::size_t axes);

}  // namespace boresight
