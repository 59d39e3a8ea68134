#include "boresight_analyses/sensitivity/sobol_indices.hpp"

#include <stdexcept>

namespace boresight {
namespace {

// What the rows add up to, values relative to a centre (a constant cancels from the estimators and would cost digits):
// of a and b the values and their squares; then per group ab - a, b (ab - a) and (ab - a)^2.
RowTerms terms_of(const SobolRow& row, double centre) {
  const double a = row.a - centre, b = row.b - centre;
  const std::size_t groups = row.exchanged.size();
  RowTerms terms = {a + b, a * a + b * b};
  terms.resize(2 + 3 * groups);
  for (std::size_t g = 0; g < groups; ++g) {
    const double step = row.exchanged[g] - row.a;
    terms[2 + g] = step;
    terms[2 + groups + g] = b * step;
    terms[2 + 2 * groups + g] = step * step;
  }
  return terms;
}

double mean_of(const std::vector<double>& sums, double n) { return sums[0] / (2.0 * n); }
double variance_of(const std::vector<double>& sums, double n) {
  const double mean = mean_of(sums, n);
  return (sums[1] - 2.0 * n * mean * mean) / (2.0 * n - 1.0);
}

// First orders, totals, and what the first ones leave.
std::vector<double> indices_of(const std::vector<double>& sums, double n) {
  const std::size_t groups = (sums.size() - 2) / 3;
  std::vector<double> indices(2 * groups + 1);
  const double v = variance_of(sums, n), mean = mean_of(sums, n);
  if (!(v > 0.0)) return indices;
  indices.back() = 1.0;
  for (std::size_t g = 0; g < groups; ++g) {
    indices[g] = (sums[2 + groups + g] - mean * sums[2 + g]) / (n * v);
    indices[groups + g] = sums[2 + 2 * groups + g] / (2.0 * n * v);
    indices.back() -= indices[g];
  }
  return indices;
}

double centre_of(const std::vector<const SobolRow*>& rows) {
  if (rows.empty()) return 0.0;
  // From one of them, so that it is exactly that where all are the same: what rounding leaves would count as what varies.
  const double first = rows.front()->a;
  double sum = 0.0;
  for (const SobolRow* r : rows) sum += 0.5 * ((r->a - first) + (r->b - first));
  return first + sum / double(rows.size());
}

std::vector<const SobolRow*> whole_rows(const std::vector<SobolRow>& rows, std::size_t groups) {
  std::vector<const SobolRow*> whole;
  for (const SobolRow& r : rows) {
    if (r.exchanged.size() != groups) throw std::invalid_argument("rows of different numbers of groups");
    if (!r.failed()) whole.push_back(&r);
  }
  return whole;
}

template <typename Sampling>
SobolIndices<Sampling> sobol_indices(const std::vector<IntervalOf<Sampling>>& intervals) {
  SobolIndices<Sampling> result;
  const std::size_t groups = (intervals.size() - 1) / 2;
  for (std::size_t g = 0; g < groups; ++g) result.groups.push_back({intervals[g], intervals[groups + g]});
  result.interactions = intervals.back();
  return result;
}

template <typename Sampling>
void add_moments(const std::vector<const SobolRow*>& rows, double centre, SobolIndices<Sampling>& result) {
  std::vector<double> sums(2, 0.0);
  for (const SobolRow* r : rows) {
    const double a = r->a - centre, b = r->b - centre;
    sums[0] += a + b;
    sums[1] += a * a + b * b;
  }
  const double n = double(rows.size());
  result.mean = centre + mean_of(sums, n);
  result.variance = variance_of(sums, n);
  result.rows = static_cast<std::int64_t>(rows.size());
}

}  // namespace

template <typename Sampling>
bool SobolIndices<Sampling>::Group::undersampled() const {
  const auto unsettled = [](const IntervalOf<Sampling>& i) { return i.high < 0.0 || i.high - i.low > 0.2; };
  return unsettled(first) || unsettled(total);
}
template struct SobolIndices<Independent>;
template struct SobolIndices<Replicated>;

SobolIndices<Independent> sobol_indices(const std::vector<SobolRow>& rows, const BootstrapOptions& options) {
  const std::vector<const SobolRow*> whole = whole_rows(rows, rows.empty() ? 0 : rows[0].exchanged.size());
  if (whole.size() < kFewestRows)
    throw std::invalid_argument("Sobol' indices need ten rows without a failed evaluation");
  const double centre = centre_of(whole);
  std::vector<RowTerms> terms;
  for (const SobolRow* r : whole) terms.push_back(terms_of(*r, centre));
  SobolIndices<Independent> result = sobol_indices(row_intervals(terms, indices_of, options));
  add_moments(whole, centre, result);
  result.failed_rows = static_cast<std::int64_t>(rows.size()) - result.rows;
  return result;
}

SobolIndices<Replicated> sobol_indices(const std::vector<std::vector<SobolRow>>& replicates, double confidence) {
  if (replicates.size() < 2) throw std::invalid_argument("one replicate of a design has no interval: two are needed");
  const std::size_t groups = replicates[0].empty() ? 0 : replicates[0][0].exchanged.size();
  std::vector<const SobolRow*> every;
  std::vector<std::vector<const SobolRow*>> whole;
  std::int64_t failed = 0;
  for (const auto& rows : replicates) {
    whole.push_back(whole_rows(rows, groups));
    if (whole.back().empty()) throw std::invalid_argument("a replicate without a row that did not fail");
    every.insert(every.end(), whole.back().begin(), whole.back().end());
    failed += static_cast<std::int64_t>(rows.size() - whole.back().size());
  }
  const double centre = centre_of(every);
  std::vector<std::vector<RowTerms>> terms(whole.size());
  for (std::size_t r = 0; r < whole.size(); ++r)
    for (const SobolRow* row : whole[r]) terms[r].push_back(terms_of(*row, centre));
  SobolIndices<Replicated> result = sobol_indices(row_intervals(terms, indices_of, confidence));
  add_moments(every, centre, result);
  result.failed_rows = failed;
  return result;
}

}  // namespace boresight
