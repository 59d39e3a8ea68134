#include "boresight_analyses/statistics/bounded_mean.hpp"

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace boresight {
namespace {

// KL(m || p).
double divergence(double m, double p) {
  const double first = m > 0.0 ? m * std::log(m / p) : 0.0;
  const double second = m < 1.0 ? (1.0 - m) * (std::log1p(-m) - std::log1p(-p)) : 0.0;
  return first + second;
}

double allowed_divergence(double samples, double confidence) {
  if (!(samples > 0.0)) throw std::invalid_argument("there must be samples");
  if (!(confidence > 0.0 && confidence < 1.0)) throw std::invalid_argument("confidence must lie between 0 and 1");
  return -std::log1p(-confidence) / samples;
}

// Where a function that changes its sign once between the two does so.
double root(const std::function<double(double)>& f, double low, double high) {
  boost::math::tools::eps_tolerance<double> close(50);
  std::uintmax_t most = 200;
  const auto bracket = boost::math::tools::bisect(f, low, high, close, most);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

double bounded_mean_lower(double mean, double samples, double confidence) {
  if (!(mean >= 0.0 && mean <= 1.0)) throw std::invalid_argument("the mean must lie between 0 and 1");
  const double most = allowed_divergence(samples, confidence);
  if (mean == 0.0) return 0.0;
  if (mean == 1.0) return std::exp(-most);
  // KL grows without bound towards 0, but only as a logarithm: of a small mean it is not beyond `most` even here.
  constexpr double kTiny = 1e-300;
  if (divergence(mean, kTiny) <= most) return 0.0;
  return root([&](double p) { return divergence(mean, p) - most; }, kTiny, mean);
}

double bounded_mean_upper(double mean, double samples, double confidence) {
  return 1.0 - bounded_mean_lower(1.0 - mean, samples, confidence);
}

double mean_that_shows(double target, double samples, double confidence) {
  if (!(target > 0.0 && target < 1.0)) throw std::invalid_argument("the target must lie between 0 and 1");
  const double most = allowed_divergence(samples, confidence);
  if (divergence(1.0, target) < most) return 2.0;
  return root([&](double m) { return divergence(m, target) - most; }, target, 1.0);
}

double mean_that_denies(double target, double samples, double confidence) {
  return 1.0 - mean_that_shows(1.0 - target, samples, confidence);
}

}  // namespace boresight
