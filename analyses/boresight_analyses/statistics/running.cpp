#include "boresight_analyses/statistics/running.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {

void RunningMoments::add(double value) {
  ++count_;
  const double before = value - mean_;
  mean_ += before / double(count_);
  squares_ += before * (value - mean_);
}

void RunningMoments::merge(const RunningMoments& other) {
  if (other.count_ == 0) return;
  const double n = double(count_), m = double(other.count_), shift = other.mean_ - mean_;
  count_ += other.count_;
  mean_ += shift * m / double(count_);
  squares_ += other.squares_ + shift * shift * n * m / double(count_);
}

double RunningMoments::variance() const { return count_ < 2 ? 0.0 : squares_ / double(count_ - 1); }
double RunningMoments::sd() const { return std::sqrt(variance()); }

IndependentInterval RunningMoments::mean_interval(double confidence) const {
  if (count_ < 2) throw std::invalid_argument("the interval of a mean needs 2 samples");
  const double n = double(count_);
  const double half = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), n - 1.0) * sd() / std::sqrt(n);
  return {mean_, mean_ - half, mean_ + half, confidence, confidence, false, "Student's t over independent samples"};
}

RunningQuantiles::RunningQuantiles(double relative_accuracy)
    : accuracy_(relative_accuracy), log_ratio_(std::log1p(relative_accuracy) - std::log1p(-relative_accuracy)) {
  if (!(relative_accuracy > 0.0 && relative_accuracy < 1.0))
    throw std::invalid_argument("the relative accuracy must lie between 0 and 1");
}

void RunningQuantiles::add(double value) {
  if (!(value >= 0.0) || !std::isfinite(value))
    throw std::invalid_argument("running quantiles need finite values >= 0");
  ++count_;
  if (value == 0.0)
    ++zeros_;
  else
    ++bins_[static_cast<int>(std::ceil(std::log(value) / log_ratio_))];
}

void RunningQuantiles::merge(const RunningQuantiles& other) {
  if (other.accuracy_ != accuracy_) throw std::invalid_argument("running quantiles of different accuracy");
  for (const auto& [bin, count] : other.bins_) bins_[bin] += count;
  zeros_ += other.zeros_;
  count_ += other.count_;
  failed_ += other.failed_;
}

// The middle of a bin: within `accuracy_` of everything in it.
double RunningQuantiles::at_rank(std::int64_t rank) const {
  std::int64_t below = zeros_;
  if (rank <= below) return 0.0;
  for (const auto& [bin, count] : bins_) {
    below += count;
    if (rank <= below) return std::exp(double(bin) * log_ratio_) * (1.0 - accuracy_);
  }
  return std::numeric_limits<double>::infinity();
}

IndependentInterval RunningQuantiles::quantile(double p, double confidence) const {
  if (count_ == 0) throw std::invalid_argument("a quantile needs 1 sample, there are 0");
  const QuantileRanks ranks = quantile_ranks(count(), p, confidence);
  IndependentInterval result;
  result.value = at_rank(std::clamp<std::int64_t>(std::llround(p * double(count_ - 1)) + 1, 1, count_));
  const std::int64_t low = ranks.low - failed_;
  result.low = low >= 1 ? at_rank(low) * (1.0 - accuracy_) : -std::numeric_limits<double>::infinity();
  result.high = at_rank(ranks.high) * (1.0 + accuracy_);
  result.confidence = confidence;
  result.coverage = ranks.coverage;
  result.exact = true;
  result.basis = "order statistics of " + std::to_string(count()) + " independent samples, binned";
  return result;
}

}  // namespace boresight
