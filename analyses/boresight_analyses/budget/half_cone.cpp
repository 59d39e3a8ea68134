#include "boresight_analyses/budget/half_cone.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>

namespace boresight {
namespace {

double below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

}  // namespace

double probability_within(double radius, std::span<const double> mean, std::span<const double> sd) {
  if (radius < 0.0) return 0.0;
  if (mean.empty()) return 1.0;
  const double m = mean.front(), s = sd.front();
  const auto rest = [&](double x) {
    return probability_within(std::sqrt(std::max(0.0, radius * radius - x * x)), mean.subspan(1), sd.subspan(1));
  };
  // A deviation that rounding leaves of an axis that does not scatter is none: no integral resolves it.
  constexpr double kNoScatter = 1e-12;
  if (s <= kNoScatter * std::max(std::abs(m), radius)) return std::abs(m) <= radius ? rest(m) : 0.0;
  if (mean.size() == 1) return below((radius - m) / s) - below((-radius - m) / s);
  // x = r sin(angle) takes away the corner of the circle; nothing is beyond nine deviations.
  constexpr double kFar = 9.0;
  const double low = std::asin(std::clamp((m - kFar * s) / radius, -1.0, 1.0));
  const double high = std::asin(std::clamp((m + kFar * s) / radius, -1.0, 1.0));
  if (!(low < high)) return 0.0;
  const double scale = 1.0 / (s * std::sqrt(2.0 * M_PI));
  const auto integrand = [&](double angle) {
    const double x = radius * std::sin(angle), u = (x - m) / s;
    return scale * std::exp(-0.5 * u * u) * radius * std::cos(angle) * rest(x);
  };
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(integrand, low, high, 8, 1e-9);
}

double radius_of(double probability, std::span<const double> mean, std::span<const double> sd) {
  double square = 0.0;
  for (std::size_t k = 0; k < mean.size(); ++k) square += std::pow(std::abs(mean[k]) + 9.0 * sd[k], 2);
  if (square == 0.0) return 0.0;
  boost::math::tools::eps_tolerance<double> close(30);
  std::uintmax_t most = 100;
  // Beside a fixed value of one axis a deviation of another may be rounding: a little beyond, all of it is within.
  constexpr double kRounding = 1e-9;
  // A fixed value makes a step in the probability, so bisection.
  const auto bracket =
      boost::math::tools::bisect([&](double r) { return probability_within(r, mean, sd) - probability; }, 0.0,
                                 (1.0 + kRounding) * std::sqrt(square), close, most);
  return 0.5 * (bracket.first + bracket.second);
}

double equal_axes_factor(double probability, int axes) {
  return std::sqrt(quantile(boost::math::chi_squared(axes), probability));
}

double coverage_factor(double probability) {
  const double gaussian = std::sqrt(2.0) * boost::math::erf_inv(probability);
  const double whole = std::round(gaussian);
  // 95 % is 1.96 and 68.3 % is 1.0006.
  constexpr double kAbove = 0.05, kBelow = 0.001;
  return whole >= 1.0 && whole - gaussian <= kAbove && gaussian - whole <= kBelow ? whole : gaussian;
}

}  // namespace boresight
