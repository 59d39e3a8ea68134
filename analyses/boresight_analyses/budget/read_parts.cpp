#include "boresight_analyses/budget/read_parts.hpp"

#include <algorithm>
#include <set>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/budget_keys.hpp"

namespace boresight {
namespace {

std::vector<std::size_t> read_contributors(Cursor& table, const BudgetPlan& plan, std::set<std::size_t>& taken) {
  std::vector<std::string> known;
  for (const Contributor& c : plan.contributors) known.push_back(c.name);
  std::vector<std::size_t> out;
  for (const std::string& name : table.has("contributors") ? table.texts("contributors") : std::vector<std::string>{}) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end())
      table.fail_found("contributors", "\"" + name + "\"", "the name of a contributor", nearest_name(name, known));
    const auto place = static_cast<std::size_t>(at - known.begin());
    if (!taken.insert(place).second)
      table.fail_found("contributors", "\"" + name + "\" a second time", "each contributor in one part");
    out.push_back(place);
  }
  return out;
}

}  // namespace

void read_parts(Cursor& budget, BudgetPlan& plan, const SiUnit& unit) {
  std::vector<Cursor> tables = budget.tables("part");
  std::set<std::size_t> taken;
  std::vector<std::string> names;
  bool mechanism = false;
  for (Cursor& table : tables) {
    table.only(budget_part_keys());
    BudgetPart part;
    part.name = table.text("name");
    if (std::find(names.begin(), names.end(), part.name) != names.end())
      table.fail_found("name", "\"" + part.name + "\" a second time", "each part once");
    names.push_back(part.name);
    part.within = table.text("within", "");
    part.contributors = read_contributors(table, plan, taken);
    part.mechanism = table.boolean("mechanism");
    if (part.mechanism && mechanism) table.fail_found("mechanism", "true a second time", "the mechanism in one part");
    mechanism = mechanism || part.mechanism;
    if (table.has("allocated")) {
      part.allocated = table.quantity("allocated", unit);
      part.unit = table.unit_as_written("allocated");
    }
    table.finish();
    plan.parts.push_back(std::move(part));
  }
  // Each within another one, up to the whole.
  for (std::size_t k = 0; k < plan.parts.size(); ++k) {
    std::string at = plan.parts[k].within;
    for (std::size_t steps = 0; !at.empty(); ++steps) {
      const auto outer =
          std::find_if(plan.parts.begin(), plan.parts.end(), [&](const BudgetPart& p) { return p.name == at; });
      if (outer == plan.parts.end())
        tables[k].fail_found("within", "\"" + at + "\"", "the name of a part", nearest_name(at, names));
      if (steps > plan.parts.size())
        tables[k].fail_found("within", "\"" + plan.parts[k].within + "\", which is within this one",
                             "a part that is not");
      at = outer->within;
    }
  }
  const auto empty = [&](const BudgetPart& p) {
    return p.contributors.empty() && !p.mechanism &&
           std::none_of(plan.parts.begin(), plan.parts.end(),
                        [&](const BudgetPart& inner) { return inner.within == p.name; });
  };
  for (std::size_t k = 0; k < plan.parts.size(); ++k)
    if (empty(plan.parts[k])) tables[k].fail("contributors", "contributors, the mechanism or parts within it");
}

}  // namespace boresight
