// Intervals of numbers that are functions of sums over rows, a row being some runs that belong together: Sobol' indices, elementary
// effects, Shapley effects.
//
// Independent rows: bootstrap over rows, percentile interval (Efron, Tibshirani 1993, chapter 13; Archer, Saltelli, Sobol' 1997
// for indices). Rows of scrambled nets depend on each other: jackknife over replicate nets, Student's t. Which of the two is the
// type's word, as in interval.hpp.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

using RowTerms = std::vector<double>;  // what one row adds to each of the sums

// The numbers, from the sums and the number of rows in them.
using OfRowSums = std::function<std::vector<double>(const std::vector<double>& sums, double rows)>;

struct BootstrapOptions {
  double confidence = 0.95;
  int resamples = 1000;
  std::uint64_t seed = 1;
};

inline constexpr std::size_t kFewestRows = 10;

// One interval a number. All rows have terms of one length. Throw std::invalid_argument for fewer than kFewestRows rows; for
// fewer than two replicates, or one without a row.
std::vector<IndependentInterval> row_intervals(const std::vector<RowTerms>& rows, const OfRowSums& numbers,
                                               const BootstrapOptions& options);
std::vector<ReplicatedInterval> row_intervals(const std::vector<std::vector<RowTerms>>& replicates,
                                              const OfRowSums& numbers, double confidence);

}  // namespace boresight
