#include "boresight_analyses/budget/member_shares.hpp"

#include <cmath>

namespace boresight {

std::vector<double> shares(const MemberProducts& p, const std::vector<std::uint32_t>& times,
                           const std::vector<std::uint32_t>& times_of_attribution) {
  const auto mean = [](const std::vector<double>& values, const std::vector<std::uint32_t>& counts) {
    double sum = 0.0, all = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      sum += counts[k] * values[k];
      all += counts[k];
    }
    return all > 0.0 ? sum / all : 0.0;
  };
  const double square = mean(p.all, times);
  double together = mean(p.own, times) / square;
  std::vector<double> out;
  for (const double alone : p.alone) {
    out.push_back(alone / square);
    if (std::isfinite(alone)) together -= out.back();
  }
  // Parts that add up: of the mechanism's own mean square of the very members that they are known of, so that they make it
  // all whichever members these are.
  const double own = mean(p.own, times) / square;
  for (std::size_t g = 0; g < p.change.size(); ++g) {
    const double change = mean(p.change[g], times_of_attribution);
    const double same = p.of_same[g].empty() ? 0.0 : mean(p.of_same[g], times_of_attribution);
    out.push_back(same > 0.0 ? own * change / same : change / square);
    together -= out.back();
  }
  for (const std::vector<double>& external : p.external) out.push_back(mean(external, times) / square);
  out.push_back(together);
  return out;
}

}  // namespace boresight
