#include "boresight_analyses/statistics/gaffke.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

namespace boresight {
namespace {

// In ln u the integrand is smooth and dies out both ways, so that the trapezoidal rule converges geometrically. This step leaves less than
// 1e-8 of up to 64 exponentials, 3e-6 of 256. To the left of `kFirst` it is u times the sum of the weights; to the right it ends where the
// product has grown beyond exp(kFaded).
constexpr double kFirst = -12.0, kLast = 12.0, kStep = 0.1, kFaded = 25.0;

}  // namespace

double probability_not_positive(const WeightedExponentials& sum) {
  double largest = 0.0;
  for (const double w : sum.weights) largest = std::max(largest, std::abs(w));
  if (largest == 0.0) return 1.0;
  double all = 0.0;
  for (std::size_t i = 0; i < sum.weights.size(); ++i) all += sum.counts[i] * sum.weights[i];
  // What the points before the first one add, a geometric series.
  double integral = all / largest * std::exp(kFirst) / std::expm1(kStep), fading = 0.0;
  const auto steps = static_cast<int>(std::lround((kLast - kFirst) / kStep));
  for (int k = 0; k <= steps && fading < kFaded; ++k) {
    const double u = std::exp(kFirst + k * kStep) / largest;
    double angle = 0.0;
    fading = 0.0;
    for (std::size_t i = 0; i < sum.weights.size(); ++i) {
      const double w = u * sum.weights[i];
      angle += sum.counts[i] * std::atan(w);
      fading += 0.5 * sum.counts[i] * std::log1p(w * w);
    }
    integral += std::sin(angle) * std::exp(-fading);
  }
  return std::clamp(0.5 - kStep * integral / std::numbers::pi, 0.0, 1.0);
}

double gaffke_lower(const std::vector<double>& values, double least, double risk) {
  if (values.empty()) throw std::invalid_argument("a bound of a mean needs 1 value, there are 0");
  if (!(risk > 0.0 && risk < 1.0)) throw std::invalid_argument("a risk lies between 0 and 1");
  std::map<double, double> counted{{least, 1.0}};
  for (const double v : values) {
    if (!(v >= least)) throw std::invalid_argument("a value lies below the least one");
    counted[v] += 1.0;
  }
  const double most = counted.rbegin()->first;
  if (!(most > least)) return least;
  WeightedExponentials sum;
  for (const auto& [value, count] : counted) sum.counts.push_back(count);
  const auto beyond = [&](double t) {
    sum.weights.clear();
    for (const auto& [value, count] : counted) sum.weights.push_back(value - t);
    return probability_not_positive(sum) - risk;
  };
  std::uintmax_t evaluations = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      beyond, least, most, -risk, 1.0 - risk, boost::math::tools::eps_tolerance<double>(36), evaluations);
  return low;
}

}  // namespace boresight
