// Estimates from independent samples (design "random"), whatever their distribution.
//
//   const IndependentSamples samples(values, failed);
//   const IndependentInterval worst = samples.quantile(0.9973, 0.95);
//
// A sample that failed has no value and is not left out: in a probability it counts as bad; the interval of a quantile
// is the widest that the failed ones could give, its low end with all of them below, its high end with all above.
// Mean and sd speak of the samples that have a value. Latin hypercubes and nets are not independent: replicated_samples.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

class IndependentSamples {
 public:
  // Values in any order. Throws std::invalid_argument for a value that is not finite: that sample failed.
  explicit IndependentSamples(std::vector<double> values, std::int64_t failed = 0);

  std::int64_t valued() const { return static_cast<std::int64_t>(sorted_.size()); }
  std::int64_t failed() const { return failed_; }
  std::int64_t count() const { return valued() + failed_; }
  const std::vector<double>& sorted() const { return sorted_; }

  // Student's t, exact for normal values, or Hall's for skewed ones (hall.hpp): the wider on either side. By the central limit: values so rare
  // that the samples hold none are not allowed for. Needs two values.
  IndependentInterval mean(double confidence) const;
  // Bonett (2006), Computational Statistics & Data Analysis 50: allows for the kurtosis; or Hall's of the squares. Needs five values.
  IndependentInterval sd(double confidence) const;
  // Value: Hyndman and Fan's definition 7 over the valued samples. Interval: order statistics, coverage exact.
  IndependentInterval quantile(double p, double confidence) const;
  // P(value <= limit): Clopper-Pearson, failed samples bad.
  IndependentInterval probability_below(double limit, double confidence) const;

 private:
  std::string unseen() const;

  std::vector<double> sorted_;
  std::int64_t failed_;
};

}  // namespace boresight
