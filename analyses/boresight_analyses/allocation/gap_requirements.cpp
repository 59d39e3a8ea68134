#include "boresight_analyses/allocation/gap_requirements.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>

#include "boresight_analyses/random/sampling_design.hpp"
#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {

std::int64_t allowed_failures(std::int64_t samples, double probability, double confidence) {
  std::int64_t allowed = -1;
  while (allowed + 1 < samples && clopper_pearson_lower(samples - allowed - 1, samples, confidence) >= probability)
    ++allowed;
  return allowed;
}

UnitSamples unit_samples(std::size_t joints, std::size_t samples, std::uint64_t seed) {
  const SamplingDesign design({.kind = SamplingKind::random, .seed = seed}, static_cast<int>(joints));
  UnitSamples unit(joints, std::vector<double>(samples));
  std::vector<double> point(joints);
  for (std::size_t k = 0; k < samples; ++k) {
    design.point(k, point);
    for (std::size_t j = 0; j < joints; ++j) unit[j][k] = point[j];
  }
  return unit;
}

std::vector<int> tightest_options(const std::vector<std::vector<DistributionPtr>>& gap) {
  std::vector<int> tightest;
  for (const auto& options : gap) {
    std::vector<double> mean, width;
    for (const DistributionPtr& d : options) {
      mean.push_back(d->mean());
      width.push_back(d->highest() - d->lowest());
    }
    // Means that differ by rounding of the widths alone are one.
    const auto [least, largest] = std::minmax_element(mean.begin(), mean.end());
    constexpr double kRounding = 1e-9;
    const bool one_middle = *largest - *least <= kRounding * *std::max_element(width.begin(), width.end());
    const std::vector<double>& by = one_middle ? width : mean;
    tightest.push_back(static_cast<int>(std::min_element(by.begin(), by.end()) - by.begin()));
  }
  return tightest;
}

StatisticalRequirement::StatisticalRequirement(const LinearDeviation& deviation,
                                               const std::vector<std::vector<DistributionPtr>>& gap,
                                               const UnitSamples& unit, std::int64_t allowed, double limit,
                                               BesideValues beside)
    : deviation_(deviation),
      beside_(std::move(beside)),
      tightest_(tightest_options(gap)),
      samples_(unit.front().size()),
      allowed_(allowed),
      limit_(limit),
      order_(samples_) {
  for (std::size_t j = 0; j < gap.size(); ++j) {
    gap_.emplace_back();
    for (const DistributionPtr& d : gap[j]) {
      auto& values = gap_.back().emplace_back(samples_);
      for (std::size_t k = 0; k < samples_; ++k) values[k] = d->quantile(unit[j][k]);
    }
  }
  std::iota(order_.begin(), order_.end(), 0U);
  tight_index_ = indices(tightest_);
  for (std::size_t j = 0; j < gap.size(); ++j) most_per_gap_.push_back(deviation.most_per_gap(j));
}

void StatisticalRequirement::take(std::span<const int> choice, std::size_t k, std::vector<double>& c) const {
  c.resize(size());
  const std::size_t joints = gap_.size();
  for (std::size_t j = 0; j < joints; ++j) c[j] = gap(j, choice[j] >= 0 ? choice[j] : tightest_[j], k);
  for (std::size_t i = 0; i < beside_.size(); ++i) c[joints + i] = beside_[i][k];
}

// |e + a_j dc| <= |e| + |a_j| |dc|, and no statistic of sizes grows by more than the largest of them does.
double StatisticalRequirement::quick_bound(std::span<const double> gaps, std::size_t k) const {
  double bound = tight_index_[k];
  for (std::size_t j = 0; j < gap_.size(); ++j) bound += most_per_gap_[j] * std::abs(gaps[j] - gap(j, tightest_[j], k));
  return bound;
}

std::vector<double> StatisticalRequirement::indices(std::span<const int> choice) const {
  std::vector<double> values(samples_), c;
  for (std::size_t k = 0; k < samples_; ++k) {
    take(choice, k, c);
    values[k] = deviation_.index(c);
  }
  return values;
}

double StatisticalRequirement::reached(std::span<const int> choice) const {
  if (allowed_ < 0) return std::numeric_limits<double>::infinity();
  std::vector<double> values = indices(choice);
  std::nth_element(values.begin(), values.begin() + allowed_, values.end(), std::greater<>());
  return values[static_cast<std::size_t>(allowed_)];
}

bool StatisticalRequirement::is_met(std::span<const int> choice) const {
  std::int64_t failed = 0;
  std::vector<double> c;
  for (std::size_t i = 0; i < samples_; ++i) {
    const std::uint32_t k = order_[i];
    take(choice, k, c);
    if (quick_bound(c, k) > limit_ && deviation_.index(c) > limit_) {
      std::swap(order_[i], order_[static_cast<std::size_t>(failed)]);
      if (++failed > allowed_) return false;
    }
  }
  return allowed_ >= 0;
}

// Convex: the index lies above its tangent. Where a wider gap works against the others, the tangent says by
// how much at most. A statistic that is not convex is bounded instant by instant.
double StatisticalRequirement::least_of(std::span<const int> choice, std::span<const double> c, std::span<double> g,
                                        std::size_t k) const {
  if (!deviation_.is_convex()) {
    std::vector<double> low(c.begin(), c.end()), high(low);
    for (std::size_t j = 0; j < choice.size(); ++j)
      if (choice[j] < 0)
        for (const auto& option : gap_[j]) {
          low[j] = std::min(low[j], option[k]);
          high[j] = std::max(high[j], option[k]);
        }
    return deviation_.least_index(c, low, high);
  }
  double least = deviation_.index(c, g);
  for (std::size_t j = 0; j < choice.size(); ++j) {
    if (choice[j] >= 0) continue;
    double gain = 0.0;
    for (const auto& option : gap_[j]) gain = std::min(gain, g[j] * (option[k] - c[j]));
    least += gain;
  }
  return least;
}

bool StatisticalRequirement::may_be_met(std::span<const int> choice) const {
  if (allowed_ < 0) return false;
  std::int64_t failed = 0;
  std::vector<double> c, g(size());
  for (std::size_t i = 0; i < samples_; ++i) {
    const std::uint32_t k = order_[i];
    take(choice, k, c);
    if (quick_bound(c, k) <= limit_ || deviation_.index(c) <= limit_) continue;
    if (least_of(choice, c, g, k) > limit_) {
      std::swap(order_[i], order_[static_cast<std::size_t>(failed)]);
      if (++failed > allowed_) return false;
    }
  }
  return true;
}

// For a set that meets the requirement, all samples but at most the allowed ones have I_k <= limit, and each
// lies above its tangent L_k = l_k + sum_j g_kj c_jk at the set given. So among any M samples there are M -
// allowed with
//   sum_k L_k <= (M - allowed) limit,
// and whichever they are, joint j adds at least the sum of its M - allowed least g_kj c_jk: an inequality
// that is additive over joints. The M samples are those with the largest indices here: few lie near the
// limit, many lose little by the choice.
std::vector<AdditiveInequality> StatisticalRequirement::inequalities_near(std::span<const int> choice) const {
  if (allowed_ < 0 || !deviation_.is_convex()) return {};
  const std::vector<double> values = indices(choice);
  std::vector<std::uint32_t> hard(samples_);
  std::iota(hard.begin(), hard.end(), 0U);
  std::sort(hard.begin(), hard.end(), [&](auto l, auto r) { return values[l] > values[r]; });
  std::vector<std::vector<double>> gradient(samples_, std::vector<double>(size()));
  std::vector<double> constant(samples_), c;
  for (std::size_t i = 0; i < samples_; ++i) {
    const std::uint32_t k = hard[i];
    take(choice, k, c);
    constant[i] = deviation_.index(c, gradient[i]);
    // What scatters beside is the same for all sets: of the constant.
    for (std::size_t j = 0; j < choice.size(); ++j) constant[i] -= gradient[i][j] * c[j];
  }
  const auto allowed = static_cast<std::size_t>(allowed_);
  std::vector<AdditiveInequality> all;
  std::vector<double> terms;
  for (const std::size_t times : {5, 12, 25}) {
    const std::size_t most = std::min(samples_, times * (allowed + 1));
    const auto least_sum = [&](auto&& term) {
      terms.clear();
      for (std::size_t i = 0; i < most; ++i) terms.push_back(term(i));
      std::nth_element(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(most - allowed - 1), terms.end());
      return std::accumulate(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(most - allowed), 0.0);
    };
    AdditiveInequality& out = all.emplace_back();
    out.budget = static_cast<double>(most - allowed) * limit_ - least_sum([&](std::size_t i) { return constant[i]; });
    for (std::size_t j = 0; j < gap_.size(); ++j) {
      out.weight.emplace_back();
      for (const auto& option : gap_[j])
        out.weight[j].push_back(least_sum([&](std::size_t i) { return gradient[i][j] * option[hard[i]]; }));
    }
    if (most == samples_) break;
  }
  return all;
}

std::vector<double> StatisticalRequirement::error_shares(std::span<const int> choice) const {
  std::vector<double> mean(size()), variance(choice.size()), g(size());
  for (std::size_t i = 0; i < beside_.size(); ++i) mean[choice.size() + i] = middle_and_half(beside_[i]).middle;
  for (std::size_t j = 0; j < variance.size(); ++j) {
    const auto& values = gap_[j][static_cast<std::size_t>(choice[j])];
    // From the first value on: gaps that do not vary have a variance of zero, and none by rounding.
    double beyond = 0.0;
    for (const double v : values) beyond += v - values.front();
    mean[j] = values.front() + beyond / static_cast<double>(samples_);
    for (const double v : values) variance[j] += (v - mean[j]) * (v - mean[j]);
  }
  deviation_.index(mean, g);
  double sum = 0.0;
  for (std::size_t j = 0; j < variance.size(); ++j) sum += variance[j] *= g[j] * g[j];
  for (double& v : variance) v = sum > 0.0 ? v / sum : 0.0;
  return variance;
}

WorstCaseRequirement::WorstCaseRequirement(const LinearDeviation& deviation,
                                           const std::vector<std::vector<DistributionPtr>>& gap, double limit,
                                           const BesideValues& beside)
    : deviation_(deviation), limit_(limit) {
  for (const std::vector<double>& values : beside) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    largest_beside_.push_back(std::max(std::abs(*low), std::abs(*high)));
  }
  for (const auto& options : gap) {
    largest_.emplace_back();
    for (const DistributionPtr& d : options)
      largest_.back().push_back(std::max(std::abs(d->lowest()), std::abs(d->highest())));
  }
}

bool WorstCaseRequirement::is_met(std::span<const int> choice) const { return may_be_met(choice); }

bool WorstCaseRequirement::may_be_met(std::span<const int> choice) const {
  std::vector<double> c(choice.size());
  for (std::size_t j = 0; j < c.size(); ++j)
    c[j] = choice[j] >= 0 ? largest_[j][static_cast<std::size_t>(choice[j])]
                          : *std::min_element(largest_[j].begin(), largest_[j].end());
  c.insert(c.end(), largest_beside_.begin(), largest_beside_.end());
  return deviation_.worst_index(c) <= limit_;
}

// Convex in the sizes: it lies above its tangent, which is additive.
std::vector<AdditiveInequality> WorstCaseRequirement::inequalities_near(std::span<const int> choice) const {
  if (!deviation_.is_convex()) return {};
  std::vector<double> c(choice.size());
  for (std::size_t j = 0; j < c.size(); ++j) c[j] = largest_[j][static_cast<std::size_t>(choice[j])];
  c.insert(c.end(), largest_beside_.begin(), largest_beside_.end());
  std::vector<double> g(c.size());
  AdditiveInequality tangent{.weight = {}, .budget = limit_ - deviation_.worst_index(c, g)};
  for (std::size_t j = 0; j < choice.size(); ++j) {
    tangent.budget += g[j] * c[j];
    std::vector<double>& weight = tangent.weight.emplace_back();
    for (const double size : largest_[j]) weight.push_back(g[j] * size);
  }
  return {tangent};
}

RootSumSquareRequirement::RootSumSquareRequirement(const LinearDeviation& deviation,
                                                   const std::vector<std::vector<DistributionPtr>>& gap,
                                                   double probability, double limit, std::vector<bool> centred,
                                                   const BesideValues& beside)
    : deviation_(deviation),
      tightest_(tightest_options(gap)),
      centred_(std::move(centred)),
      z_(root_sum_square_quantile(probability, centred_, gap.size())),
      limit_(limit) {
  for (const auto& options : gap) {
    middle_.emplace_back();
    half_.emplace_back();
    for (const DistributionPtr& d : options) {
      middle_.back().push_back(0.5 * (d->lowest() + d->highest()));
      half_.back().push_back(0.5 * (d->highest() - d->lowest()));
    }
    const auto [low, high] = std::minmax_element(middle_.back().begin(), middle_.back().end());
    const std::size_t j = least_.size();
    least_.push_back(*low);
    largest_.push_back(j < centred_.size() && centred_[j] ? *low : *high);
  }
  centred_.resize(gap.size(), false);
  for (const std::vector<double>& values : beside) {
    const auto [middle, half] = middle_and_half(values);
    middle_beside_.push_back(middle);
    half_beside_.push_back(half);
    // Of no direction of its own against the others, as errors are.
    centred_.push_back(true);
  }
  least_.insert(least_.end(), middle_beside_.begin(), middle_beside_.end());
  largest_.insert(largest_.end(), middle_beside_.begin(), middle_beside_.end());
  rises_ = deviation.rises_with_every_gap(least_, largest_);
}

bool RootSumSquareRequirement::is_met(std::span<const int> choice) const {
  return index_with_open_at_tightest(choice) <= limit_;
}

bool RootSumSquareRequirement::may_be_met(std::span<const int> choice) const {
  const bool whole = std::find(choice.begin(), choice.end(), -1) == choice.end();
  if (whole || rises_) return is_met(choice);
  if (z_ < 0.0) return true;
  std::vector<double> low(least_), high(largest_), at;
  for (std::size_t j = 0; j < choice.size(); ++j) {
    at.push_back(middle_[j][static_cast<std::size_t>(choice[j] >= 0 ? choice[j] : tightest_[j])]);
    if (choice[j] >= 0) low[j] = high[j] = at[j];
  }
  at.insert(at.end(), middle_beside_.begin(), middle_beside_.end());
  return deviation_.least_index(at, low, high) <= limit_;
}

double RootSumSquareRequirement::index_with_open_at_tightest(std::span<const int> choice) const {
  std::vector<double> c(choice.size()), h(choice.size());
  for (std::size_t j = 0; j < c.size(); ++j) {
    const auto o = static_cast<std::size_t>(choice[j] >= 0 ? choice[j] : tightest_[j]);
    c[j] = middle_[j][o];
    h[j] = half_[j][o];
  }
  c.insert(c.end(), middle_beside_.begin(), middle_beside_.end());
  h.insert(h.end(), half_beside_.begin(), half_beside_.end());
  return root_sum_square_index(deviation_, c, h, z_, centred_);
}

MiddleAndHalf middle_and_half(const std::vector<double>& values) {
  // From the first value on: values that do not vary have a deviation of zero, and none by rounding.
  double beyond = 0.0, squares = 0.0;
  const auto count = static_cast<double>(values.size());
  for (const double v : values) beyond += v - values.front();
  const double mean = values.front() + beyond / count;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, 3.0 * std::sqrt(squares / count)};
}

double root_sum_square_quantile(double probability, const std::vector<bool>& centred, std::size_t count) {
  const bool all =
      count > 0 && centred.size() >= count && std::find(centred.begin(), centred.end(), false) == centred.end();
  return boost::math::quantile(boost::math::normal(), all ? 0.5 + 0.5 * probability : probability);
}

double root_sum_square_index(const LinearDeviation& deviation, std::span<const double> middle,
                             std::span<const double> half, double z, const std::vector<bool>& centred) {
  std::vector<double> g(middle.size());
  const double index = deviation.index(middle, g);
  double squares = 0.0;
  for (std::size_t j = 0; j < g.size(); ++j) {
    const double slope = j < centred.size() && centred[j] ? deviation.alone(j) : g[j];
    squares += std::pow(slope * half[j] / 3.0, 2);
  }
  return index + z * std::sqrt(squares);
}

}  // namespace boresight
