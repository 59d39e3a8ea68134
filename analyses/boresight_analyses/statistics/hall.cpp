#include "boresight_analyses/statistics/hall.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>

namespace boresight {

MeanInterval skewed_mean_interval(const std::vector<double>& values, double confidence) {
  // Below, the cubic is a straight line to rounding.
  constexpr double kNoSkewness = 1e-6;
  const double n = double(values.size()), root = std::sqrt(n);
  const double mean = gsl_stats_mean(values.data(), 1, values.size());
  const double sd = gsl_stats_sd_m(values.data(), 1, values.size(), mean), scale = sd / root;
  const double t = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), n - 1.0);
  MeanInterval interval{mean, mean - t * scale, mean + t * scale};
  if (!(scale > 0.0)) return interval;
  double cubes = 0.0, squares = 0.0;
  for (const double v : values) {
    cubes += std::pow((v - mean) / sd, 3);
    squares += std::pow((v - mean) / sd, 2);
  }
  const double skewness = (cubes / n) / std::pow(squares / n, 1.5);
  if (!(std::abs(skewness) > kNoSkewness)) return interval;
  const auto without_skewness = [&](double x) {
    return 3.0 * root / skewness * (std::cbrt(1.0 + skewness * (x / root - skewness / (6.0 * n))) - 1.0);
  };
  interval.low = std::min(interval.low, mean - scale * without_skewness(t));
  interval.high = std::max(interval.high, mean - scale * without_skewness(-t));
  return interval;
}

}  // namespace boresight
