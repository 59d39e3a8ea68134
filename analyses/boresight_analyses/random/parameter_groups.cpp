#include "boresight_analyses/random/parameter_groups.hpp"

#include <algorithm>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/random/sample_rows.hpp"

namespace boresight {
namespace {

// Parameters that are drawn together: `first` and those next to it.
struct Together {
  std::size_t first = 0, count = 0;
  std::string holder;
};

std::vector<Together> drawn_together(const RandomInputs& inputs) {
  std::vector<Together> all;
  for (const DrawnTogether& zone : inputs.zones) all.push_back({zone.first, 2, "cylinder"});
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (const SampleRows* rows = rows_from(inputs.parameters[i].distribution))
      all.push_back({i, static_cast<std::size_t>(rows->columns()), "table"});
  return all;
}

// Whether the copula makes parameter `to` depend on the coordinate of `from`.
bool depends(const RandomInputs& inputs, std::size_t from, std::size_t to) {
  std::vector<double> low(inputs.size(), 0.3), high = low;
  high[from] = 0.8;
  inputs.copula.apply(low);
  inputs.copula.apply(high);
  return low[to] != high[to];
}

}  // namespace

NamedGroups read_parameter_groups(Cursor& table, const RandomInputs& inputs, const GroupRules& rules) {
  const std::size_t d = inputs.size();
  NamedGroups out;
  std::vector<std::string> known;
  for (const RandomParameter& p : inputs.parameters) known.push_back(p.name());
  std::vector<bool> taken(d, false);
  if (table.has("groups")) {
    Cursor groups = table.table("groups");
    groups.only(groups_keys());
    for (const std::string& name : groups.keys()) {
      std::vector<int> members;
      for (const std::string& path : groups.texts(name)) {
        const auto at = std::find(known.begin(), known.end(), path);
        if (at == known.end())
          groups.fail_found(name, "\"" + path + "\"", "the parameter of a [[random]] table", nearest_name(path, known));
        const auto index = static_cast<std::size_t>(at - known.begin());
        if (taken[index]) groups.fail_found(name, "\"" + path + "\" a second time", "each parameter in one group");
        taken[index] = true;
        members.push_back(static_cast<int>(index));
      }
      out.members.push_back(std::move(members));
      out.names.push_back(name);
    }
    groups.finish();
  }
  const std::vector<Together> together = drawn_together(inputs);
  for (const Together& t : together)
    for (std::size_t i = t.first + 1; i < t.first + t.count; ++i)
      if (taken[t.first] != taken[i])
        table.fail_found("groups", "only one of " + known[t.first] + " and " + known[i] + " in a group",
                         "both in it, as one " + t.holder + " holds them");
  for (std::size_t i = 0; i < d; ++i) {
    if (taken[i]) continue;
    out.members.push_back({static_cast<int>(i)});
    out.names.push_back(known[i]);
    for (const Together& t : together)
      while (i >= t.first && i + 1 < t.first + t.count) {
        ++i;
        out.members.back().push_back(static_cast<int>(i));
        out.names.back() += ", " + known[i];
      }
  }
  std::vector<std::size_t> group_of(d);
  for (std::size_t g = 0; g < out.members.size(); ++g)
    for (const int i : out.members[g]) group_of[static_cast<std::size_t>(i)] = g;
  for (const Together& t : together)
    for (std::size_t i = t.first + 1; i < t.first + t.count; ++i)
      if (group_of[t.first] != group_of[i])
        table.fail_found("groups", known[t.first] + " and " + known[i] + " apart",
                         "both in one group, as one " + t.holder + " holds them");
  if (rules.correlated_apart) return out;
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j < d; ++j)
      if (group_of[i] != group_of[j] && depends(inputs, i, j))
        table.fail_found("groups", known[i] + " and " + known[j] + ", which are correlated, apart",
                         "correlated parameters in one group" + rules.instead);
  return out;
}

}  // namespace boresight
