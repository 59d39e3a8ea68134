#include "boresight_analyses/sensitivity/morris_effects.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "boresight_analyses/random/permutation.hpp"

namespace boresight {
namespace {

// Per group d, |d| and d^2.
RowTerms terms_of(const std::vector<double>& effects) {
  RowTerms terms;
  for (const double d : effects) {
    terms.push_back(d);
    terms.push_back(std::abs(d));
    terms.push_back(d * d);
  }
  return terms;
}

// Per group mu_star, mu, sigma.
std::vector<double> measures_of(const std::vector<double>& sums, double n) {
  std::vector<double> measures;
  for (std::size_t k = 0; k + 2 < sums.size(); k += 3) {
    const double mu = sums[k] / n;
    const double variance = n > 1.0 ? (sums[k + 2] - n * mu * mu) / (n - 1.0) : 0.0;
    measures.push_back(sums[k + 1] / n);
    measures.push_back(mu);
    measures.push_back(std::sqrt(std::max(0.0, variance)));
  }
  return measures;
}

std::vector<RowTerms> whole_rows(const std::vector<std::vector<double>>& rows) {
  std::vector<RowTerms> whole;
  for (const std::vector<double>& row : rows)
    if (std::all_of(row.begin(), row.end(), [](double d) { return std::isfinite(d); })) whole.push_back(terms_of(row));
  return whole;
}

template <typename Sampling>
MorrisEffects<Sampling> morris_effects(const std::vector<IntervalOf<Sampling>>& intervals) {
  MorrisEffects<Sampling> result;
  for (std::size_t k = 0; k + 2 < intervals.size(); k += 3)
    result.groups.push_back({intervals[k], intervals[k + 1], intervals[k + 2]});
  return result;
}

}  // namespace

MorrisTrajectories::MorrisTrajectories(ParameterGroups groups, int levels, std::uint64_t seed)
    : groups_(std::move(groups)), levels_(levels), seed_(seed) {
  if (levels < 4 || levels % 4 != 0) throw std::invalid_argument("levels: a multiple of four");
}

int MorrisTrajectories::level(double u) const { return std::clamp(static_cast<int>(u * levels_), 0, levels_ - 1); }

std::uint64_t MorrisTrajectories::turn(std::size_t group, std::uint64_t row) const {
  return permuted(group, groups_.size(), seed_, row, 0);
}

void MorrisTrajectories::place(std::uint64_t row, std::uint64_t step, std::span<double> start) const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const bool moved = turn(g, row) < step;
    for (const int i : groups_[g]) {
      double& u = start[static_cast<std::size_t>(i)];
      const int at = (level(u) + (moved ? levels_ / 2 : 0)) % levels_;
      u = (at + 0.5) / levels_;
    }
  }
}

std::vector<double> MorrisTrajectories::effects(std::uint64_t row, std::span<const double> start,
                                                std::span<const double> results) const {
  constexpr double kMove = 0.5;
  std::vector<double> effects;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::uint64_t k = turn(g, row);
    const bool upwards = level(start[static_cast<std::size_t>(groups_[g].front())]) < levels_ / 2;
    effects.push_back((results[k + 1] - results[k]) / (upwards ? kMove : -kMove));
  }
  return effects;
}

std::vector<std::vector<double>> morris_rows(const BatchModel& model, const Points& starts,
                                             const MorrisTrajectories& trajectories) {
  Points points;
  for (std::uint64_t row = 0; row < starts.size(); ++row)
    for (std::uint64_t step = 0; step < trajectories.points(); ++step) {
      points.push_back(starts[row]);
      trajectories.place(row, step, points.back());
    }
  const std::vector<double> values = model(points);
  if (values.size() != points.size()) throw std::logic_error("a batch model must give one value per point");
  std::vector<std::vector<double>> rows;
  for (std::uint64_t row = 0; row < starts.size(); ++row)
    rows.push_back(trajectories.effects(row, starts[row],
                                        std::span(values).subspan(row * trajectories.points(), trajectories.points())));
  return rows;
}

MorrisEffects<Independent> morris_effects(const std::vector<std::vector<double>>& rows,
                                          const BootstrapOptions& options) {
  const std::vector<RowTerms> whole = whole_rows(rows);
  MorrisEffects<Independent> result = morris_effects(row_intervals(whole, measures_of, options));
  result.rows = static_cast<std::int64_t>(whole.size());
  result.failed_rows = static_cast<std::int64_t>(rows.size() - whole.size());
  return result;
}

MorrisEffects<Replicated> morris_effects(const std::vector<std::vector<std::vector<double>>>& replicates,
                                         double confidence) {
  std::vector<std::vector<RowTerms>> whole;
  std::int64_t given = 0, left = 0;
  for (const auto& rows : replicates) {
    whole.push_back(whole_rows(rows));
    given += static_cast<std::int64_t>(rows.size());
    left += static_cast<std::int64_t>(whole.back().size());
  }
  MorrisEffects<Replicated> result = morris_effects(row_intervals(whole, measures_of, confidence));
  result.rows = left;
  result.failed_rows = given - left;
  return result;
}

}  // namespace boresight
