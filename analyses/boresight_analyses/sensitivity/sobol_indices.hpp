// Sobol' indices: which share of the variance of a result a group of parameters makes.
//
//   first  V(E(y | x_g)) / V(y)       alone                         Saltelli et al. 2010, Eq. (b) of Table 2
//   total  E(V(y | x_~g)) / V(y)      alone and with all others     Jansen 1999, Eq. (f) of Table 2
//
// For independent parameters (groups). Intervals: row_intervals.hpp.
//
// A row with a failed evaluation is left out whole, and counted: indices then speak of the parameters' domain without it.
#pragma once

#include <cstdint>
#include <vector>

#include "boresight_analyses/sensitivity/row_intervals.hpp"
#include "boresight_analyses/sensitivity/sobol_rows.hpp"
#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

template <typename Sampling>
struct SobolIndices {
  struct Group {
    IntervalOf<Sampling> first, total;
    // An interval wholly below zero, where no share lies, or wider than 0.2: the sample does not settle it.
    bool undersampled() const;
  };
  std::vector<Group> groups;
  double mean = 0.0, variance = 0.0;
  std::int64_t rows = 0, failed_rows = 0;
  // 1 - the sum of the first-order indices: what parameters do only together.
  IntervalOf<Sampling> interactions;
};

// Throw std::invalid_argument for fewer than ten rows (two replicates) that did not fail, or rows of unequal width. A
// result that does not vary has indices 0.
SobolIndices<Independent> sobol_indices(const std::vector<SobolRow>& rows, const BootstrapOptions& options);
SobolIndices<Replicated> sobol_indices(const std::vector<std::vector<SobolRow>>& replicates, double confidence);

}  // namespace boresight
