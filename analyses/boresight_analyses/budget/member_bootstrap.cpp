#include "boresight_analyses/budget/member_bootstrap.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace boresight {

MemberInterval expanded_percentiles(std::vector<double> values, double value, std::size_t members, double confidence) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (members < MemberBootstrap::kFewest || values.empty() || !std::isfinite(value)) return {};
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(members);
  const double t = quantile(complement(boost::math::students_t(n - 1.0), 0.5 * (1.0 - confidence)));
  const double tail = cdf(boost::math::normal(), -std::sqrt(n / (n - 1.0)) * t);
  const auto at = [&](double share) {
    const double rank = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const auto above = std::min(below + 1, values.size() - 1);
    return values[below] + (rank - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return {std::min(value, at(tail)), std::max(value, at(1.0 - tail))};
}

}  // namespace boresight
