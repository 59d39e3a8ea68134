#include "boresight_analyses/fidelities/fidelity_estimate.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight_analyses/statistics/betting_mean.hpp"
#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/running.hpp"

namespace boresight {

FidelityEstimate estimate_fidelities(const FidelityPlan& plan, const std::vector<std::vector<double>>& values,
                                     double confidence) {
  const std::size_t models = plan.models.size();
  if (values.size() != models) throw std::invalid_argument("one list of values per model of the plan");
  for (std::size_t i = 0; i < models; ++i)
    if (static_cast<std::int64_t>(values[i].size()) < plan.samples[i])
      throw std::invalid_argument("fewer values than the plan has samples");

  // Of each model the mean over all that it ran on, and over those that ran on the model before it as well; each over the
  // samples that did not fail on it.
  const auto good = [&](std::size_t i, std::size_t k) { return std::isfinite(values[i][k]); };
  std::vector<double> all(models), shared(models, 0.0), mean(models, 0.0), shared_mean(models, 0.0);
  double value = 0.0;
  for (std::size_t i = 0; i < models; ++i) {
    RunningMoments whole, before;
    for (std::size_t k = 0; k < static_cast<std::size_t>(plan.samples[i]); ++k) {
      if (!good(i, k)) continue;
      whole.add(values[i][k]);
      if (i > 0 && k < static_cast<std::size_t>(plan.samples[i - 1])) before.add(values[i][k]);
    }
    if (whole.count() < 2 || (i > 0 && (before.count() < 2 || whole.count() - before.count() < 1)))
      throw std::invalid_argument("fewer than two samples of a group did not fail");
    all[i] = double(whole.count());
    shared[i] = double(before.count());
    mean[i] = whole.mean();
    value += i == 0 ? whole.mean() : plan.weight[i] * (whole.mean() - before.mean());
  }

  // What each sample moves the value by; alike within the groups that ran on models g, g + 1, ...
  FidelityEstimate result;
  double variance = 0.0, fourth = 0.0;
  RunningMoments dear;
  for (std::size_t g = 0, k = 0; g < models; ++g) {
    RunningMoments terms;
    const double n = double(plan.samples[g]) - double(k);
    for (; k < static_cast<std::size_t>(plan.samples[g]); ++k) {
      double term = 0.0;
      bool whole = true;
      for (std::size_t i = g; i < models; ++i) {
        if (!good(i, k)) {
          whole = false;
          continue;
        }
        const double coefficient = 1.0 / all[i] - (i > g ? 1.0 / shared[i] : 0.0);
        term += (i == 0 ? 1.0 : plan.weight[i]) * (values[i][k] - mean[i]) * coefficient;
      }
      terms.add(n * term);
      result.failed += !whole;
      if (g == 0 && good(0, k)) dear.add(values[0][k]);
    }
    const double part = terms.variance() / n;
    variance += part;
    fourth += part * part / (n - 1.0);
  }
  result.standard_error = std::sqrt(variance);
  if (variance > 0.0) result.variance_ratio = dear.variance() / all[0] / variance;
  const double degrees = fourth > 0.0 ? variance * variance / fourth : all[0] - 1.0;
  const double half = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), degrees) * result.standard_error;
  result.value = {value,
                  value - half,
                  value + half,
                  confidence,
                  confidence,
                  false,
                  "multi-fidelity Monte Carlo, Student's t with Welch's degrees of freedom"};
  return result;
}

namespace {

// Of the risk of one side, what counting the first model's own samples has: all of it where it stands alone, else half.
double risk_of_counting(double risk, bool alone) { return alone ? risk : 0.5 * risk; }

}  // namespace

FewestSamples fewest_to_show(double probability, double confidence) {
  const auto fewest = [&](bool alone) {
    return wilks_one_sided(probability, 1.0 - risk_of_counting(1.0 - confidence, alone));
  };
  return {.beside_others = fewest(false), .alone = fewest(true)};
}

IndependentInterval excess_bounds(const FidelityPlan& plan, const std::vector<std::vector<double>>& indicators,
                                  double confidence) {
  const std::size_t models = plan.models.size();
  const std::int64_t dear = plan.samples[0];
  const auto beyond = static_cast<std::int64_t>(
      std::count(indicators[0].begin(), indicators[0].begin() + static_cast<std::ptrdiff_t>(dear), 1.0));
  const double risk = 0.5 * (1.0 - confidence);
  const double alone = 1.0 - risk_of_counting(risk, models == 1);
  IndependentInterval result{double(beyond) / double(dear),
                             clopper_pearson_lower(beyond, dear, alone),
                             clopper_pearson_upper(beyond, dear, alone),
                             confidence,
                             confidence,
                             false,
                             "Clopper-Pearson over " + std::to_string(dear) + " independent samples"};
  if (models == 1) return result;
  // The other half of the risk over the groups: each has terms between two known ends.
  const double each = 1.0 - 0.5 * risk / double(models);
  double value = 0.0, low = 0.0, high = 0.0;
  for (std::size_t g = 0, k = 0; g < models; ++g) {
    const double n = double(plan.samples[g]) - double(k);
    std::vector<double> coefficient(models, 0.0);
    double least = 0.0, most = 0.0;
    for (std::size_t i = g; i < models; ++i) {
      coefficient[i] = n * (i == 0 ? 1.0 : plan.weight[i]) *
                       (1.0 / double(plan.samples[i]) - (i > g ? 1.0 / double(plan.samples[i - 1]) : 0.0));
      (coefficient[i] < 0.0 ? least : most) += coefficient[i];
    }
    std::vector<double> shares;
    for (; k < static_cast<std::size_t>(plan.samples[g]); ++k) {
      double term = 0.0;
      for (std::size_t i = g; i < models; ++i) term += coefficient[i] * indicators[i][k];
      value += term / n;
      if (most > least) shares.push_back(std::clamp((term - least) / (most - least), 0.0, 1.0));
    }
    if (shares.empty()) continue;
    low += least + (most - least) * betting_lower(shares, 0, each);
    high += least + (most - least) * betting_upper(shares, 0, each);
  }
  result.low = std::max(result.low, low);
  result.high = std::min(result.high, high);
  // Differences of shares may leave what a probability can be, or what is shown of it.
  result.value = std::clamp(value, std::min(result.low, result.high), std::max(result.low, result.high));
  result.basis = "the closer of Clopper-Pearson over the first rung's " + std::to_string(dear) +
                 " samples and of betting on all rungs', half of the risk each";
  return result;
}

std::vector<std::vector<double>> excess_indicators(const FidelityPlan& plan,
                                                   const std::vector<std::vector<double>>& values,
                                                   const std::vector<double>& limits) {
  std::vector<std::vector<double>> indicators = values;
  for (std::size_t i = 0; i < indicators.size(); ++i)
    for (double& v : indicators[i]) v = !std::isfinite(v) || v > limits[plan.models[i]] ? 1.0 : 0.0;
  return indicators;
}

}  // namespace boresight
