#include "boresight_analyses/statistics/bonett.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {

LogSdInterval bonett_interval(const std::vector<double>& sorted, double confidence) {
  const double n = double(sorted.size()), mean = gsl_stats_mean(sorted.data(), 1, sorted.size());
  const double trimmed = gsl_stats_trmean_from_sorted_data(0.5 / std::sqrt(n - 4.0), sorted.data(), 1, sorted.size());
  double fourth = 0.0, square = 0.0;
  for (const double v : sorted) {
    fourth += std::pow(v - trimmed, 4);
    square += (v - mean) * (v - mean);
  }
  if (square == 0.0) return {};
  const double z = gsl_cdf_ugaussian_Qinv(0.5 * (1.0 - confidence));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (n <= z) return {-kInfinity, kInfinity};
  const double kurtosis = n * fourth / (square * square), c = n / (n - z);
  const double error = c * std::sqrt(std::max(0.0, kurtosis - (n - 3.0) / n) / (n - 1.0));
  return {0.5 * (std::log(c) - z * error), 0.5 * (std::log(c) + z * error)};
}

}  // namespace boresight
