// Shapley effects (Owen 2014; Song, Nelson, Staum 2016, SIAM/ASA J. Uncertainty Quantification 4): the variance of a result divided
// among parameters (groups) that may depend on each other. Each is paid what it adds to the variance explained, on average over
// all orders in which parameters may be taken in. The effects are not negative and add up to 1.
//
//   c(J) = E V(y | x_~J)                                    what remains where all but the groups J are known
//   effect_i = sum over J without i of  |J|! (g - |J| - 1)! / g!  (c(J and i) - c(J)) / V(y)
//
// c gives the same effects as V(E(y | x_J)) does and has an estimator without bias from single runs (Song and
// others). A row here is two independent points a and b, and for sets J the point a whose groups J are drawn anew given the
// rest, by b (GaussianCopula::renew): c(J) is the mean of (y_J - y_a)^2 / 2, as in Jansen's formula. Two kinds of row:
//
//   all orders      all 2^g - 1 sets: each row has every order in it                        2^g runs
//   random orders   the g sets that one random order builds up: an increment a group        g + 1 runs
//
// Effects are ratios of sums over rows, so they add up to 1 in any sample.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "boresight_analyses/random/copula.hpp"
#include "boresight_analyses/random/parameter_groups.hpp"
#include "boresight_analyses/sensitivity/row_intervals.hpp"
#include "boresight_analyses/statistics/batch_model.hpp"

namespace boresight {

enum class ShapleyOrders { all, random };

class ShapleyRows {
 public:
  static constexpr std::size_t kMostForAllOrders = 12;  // groups; 4,096 runs a row
  // Throws std::invalid_argument for all orders of more groups than that.
  ShapleyRows(ParameterGroups groups, ShapleyOrders orders, std::uint64_t seed);

  std::uint64_t points() const;  // of a row, the point a first
  ShapleyOrders orders() const { return orders_; }
  // Which of d coordinates point `k` of a row has drawn anew; none for k = 0, all for the last one.
  std::vector<bool> renewed(std::uint64_t row, std::uint64_t k, std::size_t dimensions) const;
  // What the groups add to the variance explained, in their order, and the whole, c of all groups; from the results at all points.
  std::vector<double> shares(std::uint64_t row, std::span<const double> results) const;

 private:
  std::uint64_t turn(std::size_t group, std::uint64_t row) const;

  ParameterGroups groups_;
  ShapleyOrders orders_;
  std::uint64_t seed_;
  std::vector<double> weights_;  // all orders: by the number of groups already taken in
};

// One row of runs, by its results.
struct ShapleyRow {
  std::vector<double> shares;  // of the groups, then the whole
  double a = 0.0, b = 0.0;     // results at two independent points

  bool failed() const;  // one of its results is not finite
};

// Rows `first` and on of a model on the unit cube whose coordinates depend on each other by `copula`, from points `ab` of 2 d
// independent ones.
std::vector<ShapleyRow> shapley_rows(const BatchModel& model, const Points& ab, const GaussianCopula& copula,
                                     const ShapleyRows& rows, std::uint64_t first = 0);

template <typename Sampling>
struct ShapleyEffects {
  std::vector<IntervalOf<Sampling>> groups;
  double mean = 0.0, variance = 0.0;
  std::int64_t rows = 0, failed_rows = 0;
};

// A result that does not vary has effects 0. Throw std::invalid_argument as row_intervals() does.
ShapleyEffects<Independent> shapley_effects(const std::vector<ShapleyRow>& rows, const BootstrapOptions& options);
ShapleyEffects<Replicated> shapley_effects(const std::vector<std::vector<ShapleyRow>>& replicates, double confidence);

}  // namespace boresight
