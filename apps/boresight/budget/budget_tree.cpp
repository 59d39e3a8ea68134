// The tree of sub-budgets: what is allocated to each part, and what it comes to.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "budget/budget_parts.hpp"

namespace boresight::app {
namespace {

std::string answer_of(const SubBudget& p) {
  if (p.allocated == 0.0) return "rolled up only";
  if (p.compliance.met) return "kept";
  if (p.kept_by_members)
    return "not shown to be kept: rung and steps may be off by up to " + readable_error(p.model_error) +
           " of a member's mechanism";
  return p.level.value > p.allocated ? "not kept" : "not shown to be kept";
}

std::string of_parts(const BudgetStudy& s, const SubBudget& p) {
  if (p.parts_sum == 0.0) return "";
  std::string text =
      fmt::format("{} by root sum of squares, {} added up", budget_value(s, p.parts_root_sum_square, p.unit),
                  budget_value(s, p.parts_sum, p.unit));
  if (p.allocated == 0.0) return text;
  if (p.parts_root_sum_square > p.allocated) return text + ": more than this";
  return text + (p.parts_sum > p.allocated ? ": within this if they are independent" : ": within this");
}

}  // namespace

report::Section tree_section(const BudgetStudy& s, const Budget& b) {
  report::Table table{
      .title = "Sub-budgets",
      .caption = fmt::format(
          "Level: of the sum of all that a part holds, added in time in every member. Of the parts within it: what is "
          "allocated to "
          "them together. Kept only where the members show it at {} confidence. Sources: {}, of the rule {}.",
          percent(b.headline.confidence), kFromMembers, kFromClasses),
      .columns = {{"Part"},
                  {"Holds"},
                  {"Allocated"},
                  {"Level"},
                  {"Interval"},
                  {"Left"},
                  {"Answer"},
                  {"Classical rule"},
                  {"Parts within it"}}};
  for (const SubBudget& p : b.parts) {
    std::string holds;
    for (const std::string& name : p.holds) holds += (holds.empty() ? "" : ", ") + name;
    std::string indent;
    for (int k = 0; k < p.depth; ++k) indent += "– ";
    table.rows.push_back({indent + p.name, holds, p.allocated > 0.0 ? budget_limit(s, p.allocated, p.unit) : "",
                          budget_value(s, p.level.value, p.unit), interval_text(s, p.level, p.unit),
                          p.allocated > 0.0 ? budget_value(s, p.allocated - p.level.value, p.unit) : "", answer_of(p),
                          budget_value(s, p.by_rule, p.unit), of_parts(s, p)});
  }
  return {.id = "parts",
          .title = "The tree of the budget",
          .intro = level_title(s.axes(), b.headline.index, b.headline.axis, b.headline.interpretation,
                               b.headline.probability) +
                   ".",
          .items = {std::move(table)}};
}

Json tree_json(const Budget& b) {
  Json json = Json::array();
  for (const SubBudget& p : b.parts) {
    Json one = {{"name", p.name}, {"within", p.within}, {"holds", p.holds}};
    one.update(interval_json(p.level));
    one["by_rule"] = p.by_rule;
    if (p.allocated > 0.0) {
      one["allocated"] = p.allocated;
      one["kept"] = p.compliance.met;
      one["kept_by_members"] = p.kept_by_members;
      if (p.model_error > 0.0) {
        one["model_error"] = p.model_error;
        one["share_within_model_error"] = p.within_error.share;
      }
      one["shown"] = p.compliance.shown;
      one["shown_confidence"] = p.judgement.confidence;
      if (!p.judgement.why.empty()) one["judged"] = p.judgement.why;
    }
    if (p.parts_sum > 0.0) {
      one["parts_root_sum_square"] = p.parts_root_sum_square;
      one["parts_sum"] = p.parts_sum;
    }
    json.push_back(std::move(one));
  }
  return json;
}

std::vector<std::string> tree_warnings(const BudgetStudy& s, const Budget& b) {
  std::vector<std::string> out;
  for (const SubBudget& p : b.parts) {
    if (p.allocated > 0.0 && !p.compliance.met)
      out.push_back(fmt::format("the part {} comes to {} of {} allocated: {}", p.name,
                                budget_value(s, p.level.value, p.unit), budget_limit(s, p.allocated, p.unit),
                                answer_of(p)));
    if (p.allocated > 0.0 && p.parts_root_sum_square > p.allocated)
      out.push_back(fmt::format("what is allocated within {} is {} by root sum of squares, more than its own {}",
                                p.name, budget_value(s, p.parts_root_sum_square, p.unit),
                                budget_limit(s, p.allocated, p.unit)));
  }
  return out;
}

}  // namespace boresight::app
