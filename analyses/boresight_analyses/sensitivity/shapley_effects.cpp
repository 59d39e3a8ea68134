#include "boresight_analyses/sensitivity/shapley_effects.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "boresight_analyses/random/permutation.hpp"

namespace boresight {
namespace {

// Of the sums over rows: each share over the whole.
std::vector<double> effects_of(const std::vector<double>& sums, double) {
  std::vector<double> effects(sums.begin(), sums.end() - 1);
  for (double& e : effects) e = sums.back() > 0.0 ? e / sums.back() : 0.0;
  return effects;
}

std::vector<RowTerms> whole_rows(const std::vector<ShapleyRow>& rows) {
  std::vector<RowTerms> whole;
  for (const ShapleyRow& row : rows)
    if (!row.failed()) whole.push_back(row.shares);
  return whole;
}

// Mean and variance over all points a and b.
template <typename Sampling>
void add_moments(const std::vector<const ShapleyRow*>& rows, ShapleyEffects<Sampling>& result) {
  const double n = 2.0 * double(rows.size());
  for (const ShapleyRow* row : rows) result.mean += (row->a + row->b) / n;
  for (const ShapleyRow* row : rows)
    for (const double y : {row->a, row->b}) result.variance += (y - result.mean) * (y - result.mean) / (n - 1.0);
  result.rows = static_cast<std::int64_t>(rows.size());
}

void collect(const std::vector<ShapleyRow>& rows, std::vector<const ShapleyRow*>& whole) {
  for (const ShapleyRow& row : rows)
    if (!row.failed()) whole.push_back(&row);
}

}  // namespace

ShapleyRows::ShapleyRows(ParameterGroups groups, ShapleyOrders orders, std::uint64_t seed)
    : groups_(std::move(groups)), orders_(orders), seed_(seed) {
  const std::size_t g = groups_.size();
  if (orders == ShapleyOrders::random) return;
  if (g > kMostForAllOrders) throw std::invalid_argument("too many groups for all orders");
  weights_.assign(g, 1.0 / double(std::max<std::size_t>(g, 1)));  // |J|! (g - |J| - 1)! / g!, from |J| = 0
  for (std::size_t k = 1; k < g; ++k) weights_[k] = weights_[k - 1] * double(k) / double(g - k);
}

std::uint64_t ShapleyRows::points() const {
  return orders_ == ShapleyOrders::all ? std::uint64_t{1} << groups_.size() : groups_.size() + 1;
}

std::uint64_t ShapleyRows::turn(std::size_t group, std::uint64_t row) const {
  return permuted(group, groups_.size(), seed_, row, 0);
}

std::vector<bool> ShapleyRows::renewed(std::uint64_t row, std::uint64_t k, std::size_t dimensions) const {
  std::vector<bool> renewed(dimensions, false);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (orders_ == ShapleyOrders::all ? (k >> g & 1U) != 0U : turn(g, row) < k)
      for (const int i : groups_[g]) renewed[static_cast<std::size_t>(i)] = true;
  return renewed;
}

std::vector<double> ShapleyRows::shares(std::uint64_t row, std::span<const double> results) const {
  const auto remains = [&](std::uint64_t k) {
    const double change = results[k] - results[0];
    return 0.5 * change * change;
  };
  std::vector<double> shares(groups_.size(), 0.0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (orders_ == ShapleyOrders::random) {
      const std::uint64_t k = turn(g, row);
      shares[g] = remains(k + 1) - remains(k);
      continue;
    }
    for (std::uint64_t set = 0; set < points(); ++set)
      if ((set >> g & 1U) == 0U)
        shares[g] += weights_[static_cast<std::size_t>(std::popcount(set))] *
                     (remains(set | std::uint64_t{1} << g) - remains(set));
  }
  shares.push_back(remains(points() - 1));
  return shares;
}

bool ShapleyRow::failed() const {
  return !std::isfinite(a) || !std::isfinite(b) ||
         !std::all_of(shares.begin(), shares.end(), [](double v) { return std::isfinite(v); });
}

std::vector<ShapleyRow> shapley_rows(const BatchModel& model, const Points& ab, const GaussianCopula& copula,
                                     const ShapleyRows& rows, std::uint64_t first) {
  Points points;
  for (std::uint64_t row = 0; row < ab.size(); ++row) {
    const std::size_t d = ab[row].size() / 2;
    const std::span<const double> both(ab[row]);
    for (std::uint64_t k = 0; k < rows.points(); ++k) {
      points.emplace_back(d);
      copula.renew(both.first(d), both.last(d), rows.renewed(first + row, k, d), points.back());
    }
  }
  const std::vector<double> values = model(points);
  if (values.size() != points.size()) throw std::logic_error("a batch model must give one value per point");
  std::vector<ShapleyRow> out;
  for (std::uint64_t row = 0; row < ab.size(); ++row) {
    const std::span<const double> of_row = std::span(values).subspan(row * rows.points(), rows.points());
    out.push_back({rows.shares(first + row, of_row), of_row.front(), of_row.back()});
  }
  return out;
}

ShapleyEffects<Independent> shapley_effects(const std::vector<ShapleyRow>& rows, const BootstrapOptions& options) {
  ShapleyEffects<Independent> result{.groups = row_intervals(whole_rows(rows), effects_of, options)};
  std::vector<const ShapleyRow*> whole;
  collect(rows, whole);
  add_moments(whole, result);
  result.failed_rows = static_cast<std::int64_t>(rows.size() - whole.size());
  return result;
}

ShapleyEffects<Replicated> shapley_effects(const std::vector<std::vector<ShapleyRow>>& replicates, double confidence) {
  std::vector<std::vector<RowTerms>> terms;
  std::vector<const ShapleyRow*> whole;
  std::size_t given = 0;
  for (const auto& rows : replicates) {
    terms.push_back(whole_rows(rows));
    collect(rows, whole);
    given += rows.size();
  }
  ShapleyEffects<Replicated> result{.groups = row_intervals(terms, effects_of, confidence)};
  add_moments(whole, result);
  result.failed_rows = static_cast<std::int64_t>(given - whole.size());
  return result;
}

}  // namespace boresight
