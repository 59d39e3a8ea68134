#include "boresight_analyses/random/parameter_groups.hpp"

#include <algorithm>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/random_keys.hpp"

namespace boresight {
namespace {

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
      groups.require(!members.empty(), name, "at least one parameter");
      out.members.push_back(std::move(members));
      out.names.push_back(name);
    }
    groups.finish();
  }
  for (const DrawnTogether& zone : inputs.zones)
    if (taken[zone.first] != taken[zone.first + 1])
      table.fail_found("groups", "only one of " + known[zone.first] + " and " + known[zone.first + 1] + " in a group",
                       "both in it, as one cylinder holds them");
  for (std::size_t i = 0; i < d; ++i) {
    if (taken[i]) continue;
    out.members.push_back({static_cast<int>(i)});
    out.names.push_back(known[i]);
    if (inputs.zone_of(i) == nullptr) continue;
    ++i;
    out.members.back().push_back(static_cast<int>(i));
    out.names.back() += ", " + known[i];
  }
  std::vector<std::size_t> group_of(d);
  for (std::size_t g = 0; g < out.members.size(); ++g)
    for (const int i : out.members[g]) group_of[static_cast<std::size_t>(i)] = g;
  for (const DrawnTogether& zone : inputs.zones)
    if (group_of[zone.first] != group_of[zone.first + 1])
      table.fail_found("groups", known[zone.first] + " and " + known[zone.first + 1] + " apart",
                       "both in one group, as one cylinder holds them");
  if (rules.correlated_apart) return out;
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j < d; ++j)
      if (group_of[i] != group_of[j] && depends(inputs, i, j))
        table.fail_found("groups", known[i] + " and " + known[j] + ", which are correlated, apart",
                         "correlated parameters in one group" + rules.instead);
  return out;
}

}  // namespace boresight
