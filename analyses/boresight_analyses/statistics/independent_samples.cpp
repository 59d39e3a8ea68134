#include "boresight_analyses/statistics/independent_samples.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/bonett.hpp"

namespace boresight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void need(std::int64_t have, std::int64_t wanted, const char* what) {
  if (have < wanted)
    throw std::invalid_argument(std::string(what) + " needs " + std::to_string(wanted) + " samples, there are " +
                                std::to_string(have));
}

}  // namespace

IndependentSamples::IndependentSamples(std::vector<double> values, std::int64_t failed)
    : sorted_(std::move(values)), failed_(failed) {
  for (const double v : sorted_)
    if (!std::isfinite(v)) throw std::invalid_argument("a sample without a finite value has failed");
  if (failed < 0) throw std::invalid_argument("a negative number of failed samples");
  std::sort(sorted_.begin(), sorted_.end());
}

IndependentInterval IndependentSamples::mean(double confidence) const {
  need(valued(), 2, "the interval of a mean");
  const double n = double(valued()), mean = gsl_stats_mean(sorted_.data(), 1, sorted_.size());
  const double sd = gsl_stats_sd_m(sorted_.data(), 1, sorted_.size(), mean);
  const double half = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), n - 1.0) * sd / std::sqrt(n);
  return {mean, mean - half, mean + half, confidence, confidence, false, "Student's t over independent samples"};
}

IndependentInterval IndependentSamples::sd(double confidence) const {
  need(valued(), 5, "the interval of a standard deviation");
  const double sd = gsl_stats_sd(sorted_.data(), 1, sorted_.size());
  const LogSdInterval log = bonett_interval(sorted_, confidence);
  return {sd,
          sd * std::exp(log.low),
          sd * std::exp(log.high),
          confidence,
          confidence,
          false,
          "Bonett's interval over independent samples"};
}

IndependentInterval IndependentSamples::quantile(double p, double confidence) const {
  need(valued(), 1, "a quantile");
  const QuantileRanks ranks = quantile_ranks(count(), p, confidence);
  // Failed samples below everything shift the ranks up by their number, above everything leave them.
  const std::int64_t low = ranks.low - failed_, high = ranks.high;
  IndependentInterval result;
  result.value = gsl_stats_quantile_from_sorted_data(sorted_.data(), 1, sorted_.size(), p);
  result.low = low >= 1 ? sorted_[low - 1] : -kInfinity;
  result.high = high <= valued() ? sorted_[high - 1] : kInfinity;
  // Between two samples by a straight line: with few of them that may lie on the far side of a bound, which is one of them.
  result.value = std::clamp(result.value, result.low, result.high);
  result.confidence = confidence;
  result.coverage = ranks.coverage;
  result.exact = true;
  result.basis = "order statistics " + std::to_string(ranks.low) + " and " + std::to_string(ranks.high) + " of " +
                 std::to_string(count()) + " independent samples";
  return result;
}

IndependentInterval IndependentSamples::probability_below(double limit, double confidence) const {
  need(count(), 1, "a probability");
  const std::int64_t hits = std::upper_bound(sorted_.begin(), sorted_.end(), limit) - sorted_.begin();
  const ProbabilityBounds bounds = clopper_pearson(hits, count(), confidence);
  std::string basis = "Clopper-Pearson over " + std::to_string(count()) + " independent samples";
  if (failed_ > 0) basis += ", " + std::to_string(failed_) + " failed counted as bad";
  // At least `confidence`: the bounds are conservative.
  return {double(hits) / double(count()), bounds.low, bounds.high, confidence, confidence, false, std::move(basis)};
}

}  // namespace boresight
