#include "boresight_analyses/fidelities/fidelity_estimate.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <stdexcept>

#include "boresight_analyses/statistics/running.hpp"

namespace boresight {

FidelityEstimate estimate_fidelities(const FidelityPlan& plan, const std::vector<std::vector<double>>& values,
                                     double confidence) {
  const std::size_t models = plan.models.size();
  if (values.size() != models) throw std::invalid_argument("one list of values per model of the plan");
  for (std::size_t i = 0; i < models; ++i)
    if (static_cast<std::int64_t>(values[i].size()) < plan.samples[i])
      throw std::invalid_argument("fewer values than the plan has samples");

  // Groups of samples that ran on models g, g + 1, ...; the count of each without those that failed on any of them.
  const auto failed_at = [&](std::size_t g, std::size_t k) {
    for (std::size_t i = g; i < models; ++i)
      if (!std::isfinite(values[i][k])) return true;
    return false;
  };
  FidelityEstimate result;
  std::vector<std::vector<std::size_t>> group(models);
  std::vector<double> m(models);  // samples of each model, failed ones left out
  for (std::size_t g = 0, k = 0; g < models; ++g) {
    for (; k < static_cast<std::size_t>(plan.samples[g]); ++k) {
      if (failed_at(g, k)) ++result.failed;
      else group[g].push_back(k);
    }
    m[g] = double(group[g].size()) + (g > 0 ? m[g - 1] : 0.0);
    if (group[g].size() < 2) throw std::invalid_argument("fewer than two samples of a group did not fail");
  }

  double value = 0.0, variance = 0.0, fourth = 0.0;
  RunningMoments dear;
  for (std::size_t g = 0; g < models; ++g) {
    RunningMoments terms;
    const double n = double(group[g].size());
    for (const std::size_t k : group[g]) {
      double term = 0.0;
      for (std::size_t i = g; i < models; ++i) {
        // In the mean over m_i, and where it ran on the model before as well, in the mean over m_{i-1}.
        const double coefficient = 1.0 / m[i] - (i > g ? 1.0 / m[i - 1] : 0.0);
        term += (i == 0 ? 1.0 : plan.weight[i]) * values[i][k] * coefficient;
      }
      terms.add(n * term);
      if (g == 0) dear.add(values[0][k]);
    }
    value += terms.mean();
    const double part = terms.variance() / n;
    variance += part;
    fourth += part * part / (n - 1.0);
  }
  result.standard_error = std::sqrt(variance);
  if (variance > 0.0) result.variance_ratio = dear.variance() / m[0] / variance;
  const double degrees = fourth > 0.0 ? variance * variance / fourth : m[0] - 1.0;
  const double half = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), degrees) * result.standard_error;
  result.value = {value, value - half, value + half, confidence, confidence, false,
                  "multi-fidelity Monte Carlo, Student's t with Welch's degrees of freedom"};
  return result;
}

std::vector<std::vector<double>> excess_indicators(const FidelityPlan& plan, const std::vector<std::vector<double>>& values,
                                                   const std::vector<double>& limits) {
  std::vector<std::vector<double>> indicators = values;
  for (std::size_t i = 0; i < indicators.size(); ++i)
    for (double& v : indicators[i]) v = !std::isfinite(v) || v > limits[plan.models[i]] ? 1.0 : 0.0;
  return indicators;
}

}  // namespace boresight
