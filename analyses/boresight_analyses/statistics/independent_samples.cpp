#include "boresight_analyses/statistics/independent_samples.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/bonett.hpp"
#include "boresight_analyses/statistics/hall.hpp"

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
  const MeanInterval m = skewed_mean_interval(sorted_, confidence);
  return {m.mean,
          m.low,
          m.high,
          confidence,
          confidence,
          false,
          "Student's t over independent samples, Hall's for their skewness" + unseen()};
}

IndependentInterval IndependentSamples::sd(double confidence) const {
  need(valued(), 5, "the interval of a standard deviation");
  const double sd = gsl_stats_sd(sorted_.data(), 1, sorted_.size());
  const LogSdInterval log = bonett_interval(sorted_, confidence);
  // Bonett's kurtosis is that of few values, which holds too little of a long tail. A variance is a mean too, of skewed values.
  std::vector<double> squares;
  const double mean = gsl_stats_mean(sorted_.data(), 1, sorted_.size());
  for (const double v : sorted_) squares.push_back((v - mean) * (v - mean));
  const MeanInterval variance = skewed_mean_interval(squares, confidence);
  const double per_value = double(valued()) / (double(valued()) - 1.0);
  double low = sd * std::exp(log.low), high = sd * std::exp(log.high);
  if (variance.low > 0.0) low = std::min(low, std::sqrt(per_value * variance.low));
  high = std::max(high, std::sqrt(per_value * variance.high));
  return {sd,
          low,
          high,
          confidence,
          confidence,
          false,
          "Bonett's interval over independent samples, Hall's for their skewness" + unseen()};
}

// Samples that are all alike have intervals of no width, which say nothing of what they do not hold.
std::string IndependentSamples::unseen() const {
  constexpr double kRuleOfThree = 3.0;  // -ln 0.05
  if (sorted_.front() < sorted_.back() || double(valued()) <= kRuleOfThree) return "";
  char text[100];
  std::snprintf(text, sizeof text, "; all are alike: up to %.2g %% of other ones would go unseen",
                100.0 * kRuleOfThree / double(valued()));
  return text;
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
