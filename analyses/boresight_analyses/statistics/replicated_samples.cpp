#include "boresight_analyses/statistics/replicated_samples.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight_analyses/statistics/bonett.hpp"
#include "boresight_analyses/statistics/gaffke.hpp"
#include "boresight_analyses/statistics/hall.hpp"
#include "boresight_analyses/statistics/unseen_share.hpp"

namespace boresight {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kFewestBeyond = 5.0;

double student(double confidence, std::int64_t replicates) {
  return gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), double(replicates) - 1.0);
}

double standard_error(const std::vector<double>& values) {
  return gsl_stats_sd(values.data(), 1, values.size()) / std::sqrt(double(values.size()));
}

// How far off their mean the share may lie that designs of `size` samples have on the average. Shares of good stratification take a few neighbouring
// values k / size, skewed between them, and often all of them the same: Student's t knows neither. A k beyond those that were seen may have
// been missed by chance; within these ends the bounds of gaffke.hpp ask nothing of how the shares lie. One such step where all replicates
// miss one that three in ten have less often than the risk, else two. Enumerated for sums of chances, as the cells of a net that the
// limit cuts make them, neither side errs more often than it says (ReplicatedSamples.OfAFewCutCellsAreNotSurerThanTheySay).
struct Off {
  double below = 0.0, above = 0.0;  // the mean
};
Off off_the_mean(const std::vector<double>& shares, double mean, double size, double confidence) {
  const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
  const double risk = 0.5 * (1.0 - confidence), missed = std::pow(0.7, double(shares.size()));
  const double step = (missed <= risk ? 1.0 : 2.0) / size;
  std::vector<double> mirrored;
  for (const double share : shares) mirrored.push_back(1.0 - share);
  return {mean - gaffke_lower(shares, std::max(0.0, *least - step), risk),
          1.0 - gaffke_lower(mirrored, std::max(0.0, 1.0 - *most - step), risk) - mean};
}

// p shifted by `shift` on the logit scale.
double logit_shifted(double p, double shift) { return p / (p + (1.0 - p) * std::exp(-shift)); }

std::string over(std::int64_t replicates) { return " over " + std::to_string(replicates) + " independent replicates"; }

}  // namespace

ReplicatedSamples::ReplicatedSamples(std::vector<std::vector<double>> replicates, std::vector<std::int64_t> failed)
    : sorted_(std::move(replicates)), failed_(std::move(failed)) {
  if (sorted_.size() < 2) throw std::invalid_argument("one replicate of a design has no interval: two are needed");
  if (failed_.empty()) failed_.assign(sorted_.size(), 0);
  if (failed_.size() != sorted_.size()) throw std::invalid_argument("one number of failed samples a replicate");
  const std::size_t size = sorted_[0].size() + static_cast<std::size_t>(failed_[0]);
  for (std::size_t r = 0; r < sorted_.size(); ++r) {
    if (failed_[r] < 0 || sorted_[r].size() + static_cast<std::size_t>(failed_[r]) != size || size == 0)
      throw std::invalid_argument("replicates of a design must have the same size");
    for (const double v : sorted_[r])
      if (!std::isfinite(v)) throw std::invalid_argument("a sample without a finite value has failed");
    std::sort(sorted_[r].begin(), sorted_[r].end());
    pooled_.insert(pooled_.end(), sorted_[r].begin(), sorted_[r].end());
    all_failed_ += failed_[r];
  }
  std::sort(pooled_.begin(), pooled_.end());
}

ReplicatedInterval mean_over_replicates(const std::vector<double>& values, double confidence) {
  if (values.size() < 2) throw std::invalid_argument("one replicate of a design has no interval: two are needed");
  const auto n = static_cast<std::int64_t>(values.size());
  const MeanInterval m = skewed_mean_interval(values, confidence);
  return {
      m.mean, m.low, m.high, confidence, confidence, false, "Student's t" + over(n) + ", Hall's for their skewness"};
}

ReplicatedInterval ReplicatedSamples::mean(double confidence) const {
  std::vector<double> means;
  for (const auto& r : sorted_)
    if (!r.empty()) means.push_back(gsl_stats_mean(r.data(), 1, r.size()));
  return mean_over_replicates(means, confidence);
}

ReplicatedInterval ReplicatedSamples::sd(double confidence) const {
  if (valued() < 5) throw std::invalid_argument("the interval of a standard deviation needs 5 samples");
  const double value = gsl_stats_sd(pooled_.data(), 1, pooled_.size());
  ReplicatedInterval result{value,
                            value,
                            value,
                            confidence,
                            confidence,
                            false,
                            "mean squares" + over(replicates()) + ", not below Bonett's interval"};
  if (value == 0.0) return result;
  const double centre = gsl_stats_mean(pooled_.data(), 1, pooled_.size());
  std::vector<double> squares;  // about the pooled mean, relative to the pooled variance
  for (const auto& r : sorted_)
    if (!r.empty())
      squares.push_back(gsl_stats_variance_with_fixed_mean(r.data(), 1, r.size(), centre) / (value * value));
  const double half = 0.5 * student(confidence, static_cast<std::int64_t>(squares.size())) * standard_error(squares);
  const LogSdInterval log = bonett_interval(pooled_, confidence);
  result.low = value * std::exp(std::min(-half, log.low));
  result.high = value * std::exp(std::max(half, log.high));
  return result;
}

ReplicatedInterval ReplicatedSamples::quantile(double p, double confidence) const {
  if (!(p > 0.0 && p < 1.0)) throw std::invalid_argument("probability must lie between 0 and 1");
  if (pooled_.empty()) throw std::invalid_argument("a quantile needs 1 sample, there are 0");
  ReplicatedInterval result{gsl_stats_quantile_from_sorted_data(pooled_.data(), 1, pooled_.size(), p),
                            -kUnbounded,
                            kUnbounded,
                            confidence,
                            confidence,
                            false,
                            "Woodruff's interval" + over(replicates()) + ", not closer than Gaffke's"};
  const double N = double(count()), size = N / double(replicates());
  std::vector<double> shares;  // below the pooled quantile
  for (const auto& r : sorted_)
    shares.push_back(double(std::upper_bound(r.begin(), r.end(), result.value) - r.begin()) / size);
  // A share is read in steps of 1 / size: what rounding adds keeps a perfectly stratified design from an empty interval.
  const double error = std::hypot(standard_error(shares), 1.0 / (size * std::sqrt(12.0 * double(replicates()))));
  const double shift = student(confidence, replicates()) * error / (p * (1.0 - p));
  const Off off = off_the_mean(shares, gsl_stats_mean(shares.data(), 1, shares.size()), size, confidence);
  const double share_low = std::min(logit_shifted(p, -shift), p - off.below),
               share_high = std::max(logit_shifted(p, shift), p + off.above);
  const auto low = static_cast<std::int64_t>(std::floor(N * share_low)) - failed();
  const auto high = static_cast<std::int64_t>(std::floor(N * share_high)) + 1;
  if (N * p >= kFewestBeyond && low >= 1) result.low = pooled_[low - 1];
  if (N * (1.0 - p) >= kFewestBeyond && high <= valued()) result.high = pooled_[high - 1];
  return result;
}

ReplicatedInterval ReplicatedSamples::probability_below(double limit, double confidence) const {
  const double size = double(count()) / double(replicates());
  std::vector<double> shares;
  for (const auto& r : sorted_)
    shares.push_back(double(std::upper_bound(r.begin(), r.end(), limit) - r.begin()) / size);
  const double p = gsl_stats_mean(shares.data(), 1, shares.size()), error = standard_error(shares);
  ReplicatedInterval result{p,
                            0.0,
                            1.0,
                            confidence,
                            confidence,
                            false,
                            "Student's t on the logit scale" + over(replicates()) + ", not closer than Gaffke's"};
  const bool all_good = shares == std::vector<double>(shares.size(), 1.0), all_bad = p == 0.0;
  if (all_good || all_bad) {
    const double unseen = unseen_share(replicates(), size, 0.5 * (1.0 - confidence));
    (all_good ? result.low : result.high) = all_good ? 1.0 - unseen : unseen;
    result.basis = std::string("no ") + (all_good ? "bad" : "good") + " sample: Clopper-Pearson" + over(replicates()) +
                   ", two such samples together where there are any";
    return result;
  }
  const double rounding = 1.0 / (size * std::sqrt(12.0 * double(replicates())));
  const double shift = student(confidence, replicates()) * std::hypot(error, rounding) / (p * (1.0 - p));
  const Off off = off_the_mean(shares, p, size, confidence);
  result.low = std::max(0.0, std::min(logit_shifted(p, -shift), p - off.below));
  result.high = std::min(1.0, std::max(logit_shifted(p, shift), p + off.above));
  return result;
}

}  // namespace boresight
