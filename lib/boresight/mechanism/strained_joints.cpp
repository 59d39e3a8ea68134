#include "boresight/mechanism/strained_joints.hpp"

#include <algorithm>

namespace boresight {

std::string strained_joints(const Mechanism& mechanism, const std::vector<double>& open) {
  // Of the most: less is what other loops close to.
  constexpr double kShare = 1e-3;
  constexpr std::size_t kMostNamed = 8;
  const double most = *std::max_element(open.begin(), open.end());
  std::vector<std::string> names;
  for (std::size_t j = 0; j < open.size(); ++j)
    if (open[j] >= kShare * most) names.push_back('"' + mechanism.description().joints[j].name + '"');
  if (names.size() == 1) return "joint " + names.front() + " does";
  if (names.size() > kMostNamed) {
    const std::size_t others = names.size() - kMostNamed + 1;
    names.resize(kMostNamed - 1);
    names.push_back(std::to_string(others) + " more");
  }
  std::string text = "joints ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text + " do";
}

}  // namespace boresight
