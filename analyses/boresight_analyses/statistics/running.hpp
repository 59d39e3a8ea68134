// Estimates that grow as samples land, in a fixed amount of memory however many there are: for progress lines, for
// stopping on an interval's width, and for sums over threads or ranks (merge). The final numbers come from the samples
// themselves (independent_samples.hpp, replicated_samples.hpp).
#pragma once

#include <cstdint>
#include <map>

#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

// Mean and variance in one pass (Welford 1962; merging: Chan, Golub, LeVeque 1983).
class RunningMoments {
 public:
  void add(double value);
  void merge(const RunningMoments& other);

  std::int64_t count() const { return count_; }
  double mean() const { return mean_; }
  double variance() const;  // unbiased; 0 below two values
  double sd() const;
  IndependentInterval mean_interval(double confidence) const;  // needs two values

 private:
  std::int64_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

// Quantiles of non-negative values to a relative accuracy, counted in bins of equal ratio (Masson, Rim, Lee 2019,
// "DDSketch"). The counts do not depend on the order of the samples, so neither do the estimates.
class RunningQuantiles {
 public:
  // Throws std::invalid_argument unless 0 < relative_accuracy < 1.
  explicit RunningQuantiles(double relative_accuracy = 1e-3);

  // Throws std::invalid_argument for a negative value or one that is not finite.
  void add(double value);
  void add_failed() { ++failed_; }
  // Throws std::invalid_argument where the accuracies differ.
  void merge(const RunningQuantiles& other);

  std::int64_t count() const { return count_ + failed_; }
  std::int64_t failed() const { return failed_; }
  // As IndependentSamples::quantile, each end widened by the accuracy of the bins. Needs one value.
  IndependentInterval quantile(double p, double confidence) const;

 private:
  double at_rank(std::int64_t rank) const;  // from 1, among the values

  double accuracy_, log_ratio_;
  std::map<int, std::int64_t> bins_;
  std::int64_t zeros_ = 0, count_ = 0, failed_ = 0;
};

}  // namespace boresight
