// The tree of a budget: parts that hold contributors, the mechanism's own error, and other parts; what is allocated to each, and what each
// comes to, rolled up from all that it holds.
//
// Rolled up is simulated: the errors of a part add up in time, member by member, and its level is that of the sum, in the index, axis,
// interpretation and probability that the budget is about. Beside it the level by the classical rule. Whether the allocations of the parts
// within a part are within its own is seen by root sum of squares, as of independent errors, and by their sum, as of the worst.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/budget/budget_plan.hpp"
#include "boresight_analyses/budget/classical.hpp"
#include "boresight_analyses/budget/ensemble.hpp"
#include "boresight_analyses/budget/line_kinds.hpp"

namespace boresight {

struct SubBudget {
  std::string name, within;        // within: ""; the whole
  int depth = 0;                   // 0 of those in the whole
  std::vector<std::string> holds;  // contributors, and "mechanism", of all parts within it too
  double allocated = 0.0;          // 0: nothing
  std::string unit = "";           // in which the study writes it
  ReportedInterval level = {};
  double by_rule = 0.0;
  EnsembleInTime::Compliance compliance =
      {};                        // with what is allocated; where it holds the mechanism, of `within_error` too
  bool kept_by_members = false;  // it would be, were the model without fault
  double model_error = 0.0;      // of rung and steps, relative, the largest of a member; 0 without the mechanism
  EnsembleInTime::Compliance within_error = {};  // if each member were larger by its own
  Judgement judgement = {};
  // Allocations of the parts directly within it; 0: none.
  double parts_root_sum_square = 0.0, parts_sum = 0.0;
};

// In the order of the tree, a part before those within it. `lines`: of the classical table of the headline. `judgements`: of the plan's parts; each
// as a first look where there are none. of_steps: what these may be off by, relative to the largest value of a motion.
std::vector<SubBudget> sub_budgets(const BudgetPlan& plan, const BudgetEnsemble& ensemble, double of_steps,
                                   const BudgetAxes& axes, const std::vector<ClassicalLine>& lines,
                                   const std::vector<Judgement>& judgements);

// The question that an allocation asks of the plan's members.
std::string question_of(const BudgetPlan& plan, const BudgetAxes& axes, const BudgetPart& part);

}  // namespace boresight
