#include "boresight_analyses/statistics/effective_samples.hpp"

#include <algorithm>
#include <limits>

namespace boresight {

double values_per_independent_one(const std::vector<double>& autocorrelations, double noise, double values,
                                  double parameters) {
  double sum = 0.0, lags = 0.0;
  for (std::size_t lag = 1; lag < autocorrelations.size() && autocorrelations[lag] > noise; ++lag) {
    sum += autocorrelations[lag];
    lags += 1.0;
  }
  constexpr double kMostTaken = 0.5;
  constexpr int kRounds = 50;
  double per_one = 1.0 + 2.0 * sum;
  for (int round = 0; round < kRounds; ++round) {
    const double taken = std::min(kMostTaken, parameters * per_one / values);
    per_one = 1.0 + 2.0 * (taken * lags + (1.0 - taken) * sum);
  }
  return std::max(1.0, per_one);
}

double akaike(double loss, double values, double parameters, const ResidualsOfBest& best) {
  const double taken = best.parameters * best.per_independent_one;
  const double left = values / best.per_independent_one - parameters - 1.0;
  if (!(left > 0.0) || !(values > taken)) return std::numeric_limits<double>::infinity();
  const double variance = best.mean_square * values / (values - taken);
  return loss / (variance * best.per_independent_one) + 2.0 * parameters + 2.0 * parameters * (parameters + 1.0) / left;
}

}  // namespace boresight
