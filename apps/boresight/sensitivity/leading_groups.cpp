#include "sensitivity/leading_groups.hpp"

#include <algorithm>

namespace boresight::app {
namespace {

constexpr std::size_t kAllNamed = 4, kNamedOfMore = 3;

}  // namespace

std::vector<MeasuredGroup> leading_groups(std::vector<MeasuredGroup> groups) {
  std::stable_sort(groups.begin(), groups.end(),
                   [](const MeasuredGroup& a, const MeasuredGroup& b) { return a.measure.value > b.measure.value; });
  std::vector<MeasuredGroup> leading;
  for (MeasuredGroup& group : groups)
    if (leading.empty() || group.measure.high >= leading.front().measure.low) leading.push_back(std::move(group));
  return leading;
}

std::size_t named(const std::vector<MeasuredGroup>& leading) {
  return leading.size() > kAllNamed ? kNamedOfMore : leading.size();
}

std::string in_a_sentence(const std::vector<std::string>& words) {
  std::string sentence;
  for (std::size_t k = 0; k < words.size(); ++k)
    sentence += (k == 0 ? "" : k + 1 < words.size() ? ", " : " and ") + words[k];
  return sentence;
}

std::string names_of(const std::vector<MeasuredGroup>& leading) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < named(leading); ++k) names.push_back(leading[k].name);
  if (names.size() < leading.size()) names.push_back(std::to_string(leading.size() - names.size()) + " others");
  return in_a_sentence(names);
}

}  // namespace boresight::app
