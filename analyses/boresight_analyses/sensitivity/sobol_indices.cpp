#include "boresight_analyses/sensitivity/sobol_indices.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

struct Indices {
  std::vector<double> first, total;
  double interactions = 1.0;
};

// Sums over rows, values relative to `centre`: a constant cancels from the estimators and would cost digits.
struct RowSums {
  double n = 0.0, values = 0.0, squares = 0.0;  // of a and b
  std::vector<double> change, product, jump;    // per group: ab - a, b (ab - a), (ab - a)^2

  explicit RowSums(std::size_t groups) : change(groups), product(groups), jump(groups) {}

  void add(const SobolRow& row, double centre, double times = 1.0) {
    const double a = row.a - centre, b = row.b - centre;
    n += times;
    values += times * (a + b);
    squares += times * (a * a + b * b);
    for (std::size_t g = 0; g < change.size(); ++g) {
      const double step = row.exchanged[g] - row.a;
      change[g] += times * step;
      product[g] += times * b * step;
      jump[g] += times * step * step;
    }
  }
  void add(const RowSums& other, double times) {
    n += times * other.n;
    values += times * other.values;
    squares += times * other.squares;
    for (std::size_t g = 0; g < change.size(); ++g) {
      change[g] += times * other.change[g];
      product[g] += times * other.product[g];
      jump[g] += times * other.jump[g];
    }
  }
  double mean() const { return values / (2.0 * n); }
  double variance() const { return (squares - 2.0 * n * mean() * mean()) / (2.0 * n - 1.0); }
  Indices indices() const {
    Indices result;
    const double v = variance();
    for (std::size_t g = 0; g < change.size(); ++g) {
      result.first.push_back(v > 0.0 ? (product[g] - mean() * change[g]) / (n * v) : 0.0);
      result.total.push_back(v > 0.0 ? jump[g] / (2.0 * n * v) : 0.0);
      result.interactions -= result.first.back();
    }
    if (!(v > 0.0)) result.interactions = 0.0;
    return result;
  }
};

double centre_of(const std::vector<const SobolRow*>& rows) {
  double sum = 0.0;
  for (const SobolRow* r : rows) sum += 0.5 * (r->a + r->b);
  return sum / double(rows.size());
}

std::vector<const SobolRow*> whole_rows(const std::vector<SobolRow>& rows, std::size_t groups) {
  std::vector<const SobolRow*> whole;
  for (const SobolRow& r : rows) {
    if (r.exchanged.size() != groups) throw std::invalid_argument("rows of different numbers of groups");
    if (!r.failed()) whole.push_back(&r);
  }
  return whole;
}

}  // namespace

template <typename Sampling>
bool SobolIndices<Sampling>::Group::undersampled() const {
  const auto unsettled = [](const IntervalOf<Sampling>& i) { return i.value < 0.0 || i.high - i.low > 0.2; };
  return unsettled(first) || unsettled(total);
}
template struct SobolIndices<Independent>;
template struct SobolIndices<Replicated>;

SobolIndices<Independent> sobol_indices(const std::vector<SobolRow>& rows, const BootstrapOptions& options) {
  const std::size_t groups = rows.empty() ? 0 : rows[0].exchanged.size();
  const std::vector<const SobolRow*> whole = whole_rows(rows, groups);
  if (whole.size() < 10) throw std::invalid_argument("Sobol' indices need ten rows without a failed evaluation");
  const double centre = centre_of(whole);
  RowSums all(groups);
  for (const SobolRow* r : whole) all.add(*r, centre);

  std::vector<std::vector<double>> first(groups), total(groups);
  std::vector<double> interactions;
  const CounterStream stream(options.seed, StreamPurpose::resampling);
  const auto n = static_cast<std::uint64_t>(whole.size());
  for (int k = 0; k < options.resamples; ++k) {
    RowSums drawn(groups);
    for (std::uint64_t j = 0; j < n; ++j) drawn.add(*whole[stream.below(n, static_cast<std::uint64_t>(k), j)], centre);
    const Indices i = drawn.indices();
    for (std::size_t g = 0; g < groups; ++g) {
      first[g].push_back(i.first[g]);
      total[g].push_back(i.total[g]);
    }
    interactions.push_back(i.interactions);
  }
  const auto interval = [&](double value, std::vector<double>& resampled) {
    std::sort(resampled.begin(), resampled.end());
    const auto at = [&](double p) {
      return gsl_stats_quantile_from_sorted_data(resampled.data(), 1, resampled.size(), p);
    };
    const double risk = 0.5 * (1.0 - options.confidence);
    return IndependentInterval{value,
                               at(risk),
                               at(1.0 - risk),
                               options.confidence,
                               options.confidence,
                               false,
                               "bootstrap over " + std::to_string(n) + " independent rows"};
  };
  const Indices value = all.indices();
  SobolIndices<Independent> result;
  for (std::size_t g = 0; g < groups; ++g)
    result.groups.push_back({interval(value.first[g], first[g]), interval(value.total[g], total[g])});
  result.interactions = interval(value.interactions, interactions);
  result.mean = centre + all.mean();
  result.variance = all.variance();
  result.rows = static_cast<std::int64_t>(n);
  result.failed_rows = static_cast<std::int64_t>(rows.size()) - result.rows;
  return result;
}

SobolIndices<Replicated> sobol_indices(const std::vector<std::vector<SobolRow>>& replicates, double confidence) {
  if (replicates.size() < 2) throw std::invalid_argument("one replicate of a design has no interval: two are needed");
  const std::size_t groups = replicates[0].empty() ? 0 : replicates[0][0].exchanged.size();
  SobolIndices<Replicated> result;
  std::vector<std::vector<const SobolRow*>> whole;
  std::vector<const SobolRow*> every;
  for (const auto& rows : replicates) {
    whole.push_back(whole_rows(rows, groups));
    every.insert(every.end(), whole.back().begin(), whole.back().end());
    result.failed_rows += static_cast<std::int64_t>(rows.size() - whole.back().size());
    if (whole.back().empty()) throw std::invalid_argument("a replicate without a row that did not fail");
  }
  const double centre = centre_of(every);
  RowSums all(groups);
  std::vector<RowSums> parts(whole.size(), RowSums(groups));
  for (std::size_t r = 0; r < whole.size(); ++r) {
    for (const SobolRow* row : whole[r]) parts[r].add(*row, centre);
    all.add(parts[r], 1.0);
  }
  std::vector<Indices> without;
  for (const RowSums& part : parts) {
    RowSums rest = all;
    rest.add(part, -1.0);
    without.push_back(rest.indices());
  }
  const double R = double(parts.size());
  const double student = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), R - 1.0);
  const auto interval = [&](double value, auto&& of) {
    std::vector<double> left_out;
    for (const Indices& i : without) left_out.push_back(of(i));
    const double sd = gsl_stats_sd(left_out.data(), 1, left_out.size());
    const double half =
        student * sd * (R - 1.0) / std::sqrt(R);  // jackknife: pseudo-values scatter R - 1 times as much
    return ReplicatedInterval{value,
                              value - half,
                              value + half,
                              confidence,
                              confidence,
                              false,
                              "jackknife over " + std::to_string(parts.size()) + " independent replicates"};
  };
  const Indices value = all.indices();
  for (std::size_t g = 0; g < groups; ++g)
    result.groups.push_back({interval(value.first[g], [g](const Indices& i) { return i.first[g]; }),
                             interval(value.total[g], [g](const Indices& i) { return i.total[g]; })});
  result.interactions = interval(value.interactions, [](const Indices& i) { return i.interactions; });
  result.mean = centre + all.mean();
  result.variance = all.variance();
  result.rows = static_cast<std::int64_t>(every.size());
  return result;
}

}  // namespace boresight
