#include "boresight_analyses/sensitivity/row_intervals.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

void add(std::vector<double>& sums, const RowTerms& terms) {
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += terms[k];
}

}  // namespace

std::vector<IndependentInterval> row_intervals(const std::vector<RowTerms>& rows, const OfRowSums& numbers,
                                               const BootstrapOptions& options) {
  if (rows.size() < kFewestRows)
    throw std::invalid_argument("intervals over rows need " + std::to_string(kFewestRows) +
                                " rows without a failed evaluation");
  const auto n = static_cast<std::uint64_t>(rows.size());
  const std::vector<double> zero(rows.front().size(), 0.0);
  std::vector<double> sums = zero;
  for (const RowTerms& row : rows) add(sums, row);
  const std::vector<double> values = numbers(sums, double(n));

  std::vector<std::vector<double>> resampled(values.size());
  const CounterStream stream(options.seed, StreamPurpose::resampling);
  for (int k = 0; k < options.resamples; ++k) {
    std::vector<double> drawn = zero;
    for (std::uint64_t j = 0; j < n; ++j) add(drawn, rows[stream.below(n, static_cast<std::uint64_t>(k), j)]);
    const std::vector<double> of_drawn = numbers(drawn, double(n));
    for (std::size_t i = 0; i < values.size(); ++i) resampled[i].push_back(of_drawn[i]);
  }
  const double risk = 0.5 * (1.0 - options.confidence);
  std::vector<IndependentInterval> intervals;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::sort(resampled[i].begin(), resampled[i].end());
    const auto at = [&](double p) {
      return gsl_stats_quantile_from_sorted_data(resampled[i].data(), 1, resampled[i].size(), p);
    };
    intervals.push_back({values[i], at(risk), at(1.0 - risk), options.confidence, options.confidence, false,
                         "bootstrap over " + std::to_string(n) + " independent rows"});
  }
  return intervals;
}

std::vector<ReplicatedInterval> row_intervals(const std::vector<std::vector<RowTerms>>& replicates,
                                              const OfRowSums& numbers, double confidence) {
  if (replicates.size() < 2) throw std::invalid_argument("one replicate of a design has no interval: two are needed");
  std::size_t n = 0;
  for (const auto& rows : replicates) {
    if (rows.empty()) throw std::invalid_argument("a replicate without a row that did not fail");
    n += rows.size();
  }
  const std::vector<double> zero(replicates.front().front().size(), 0.0);
  std::vector<double> all = zero;
  std::vector<std::vector<double>> parts(replicates.size(), zero);
  for (std::size_t r = 0; r < replicates.size(); ++r) {
    for (const RowTerms& row : replicates[r]) add(parts[r], row);
    add(all, parts[r]);
  }
  const std::vector<double> values = numbers(all, double(n));
  std::vector<std::vector<double>> without(values.size());  // each replicate left out once
  for (std::size_t r = 0; r < parts.size(); ++r) {
    std::vector<double> rest = all;
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= parts[r][k];
    const std::vector<double> of_rest = numbers(rest, double(n - replicates[r].size()));
    for (std::size_t i = 0; i < values.size(); ++i) without[i].push_back(of_rest[i]);
  }
  const double R = double(parts.size());
  const double student = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), R - 1.0);
  std::vector<ReplicatedInterval> intervals;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double sd = gsl_stats_sd(without[i].data(), 1, without[i].size());
    const double half =
        student * sd * (R - 1.0) / std::sqrt(R);  // jackknife: pseudo-values scatter R - 1 times as much
    intervals.push_back({values[i], values[i] - half, values[i] + half, confidence, confidence, false,
                         "jackknife over " + std::to_string(parts.size()) + " independent replicates"});
  }
  return intervals;
}

}  // namespace boresight
