// The names of things that have one: what a choice may be, or what a faulty name is nearest to.
#pragma once

#include <string>
#include <vector>

namespace boresight {

template <typename Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.emplace_back(thing.name);
  return names;
}

}  // namespace boresight
