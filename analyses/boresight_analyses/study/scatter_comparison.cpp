#include "boresight_analyses/study/scatter_comparison.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "boresight_analyses/study/measurement.hpp"

namespace boresight {
namespace {

// Quantiles between this and its complement are of the middle: plain samples serve.
constexpr double kMiddle = 0.25;

double normal_quantile(double p) { return boost::math::quantile(boost::math::normal(), p); }

// The statistic of the pairs but one (left_out: none if beyond their number).
double statistic_of(std::span<const double> values, std::span<const double> scores, const ScatterStatistic& statistic,
                    std::size_t left_out) {
  double n = 0.0, mean = 0.0, mean_score = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k == left_out) continue;
    n += 1.0;
    mean += values[k];
    if (!scores.empty()) mean_score += scores[k];
  }
  mean /= n;
  mean_score /= n;
  double squares = 0.0, cross = 0.0, score_squares = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k == left_out) continue;
    const double v = values[k] - mean, z = scores.empty() ? 0.0 : scores[k] - mean_score;
    squares += v * v;
    cross += v * z;
    score_squares += z * z;
  }
  const bool ranked = score_squares > 0.0;
  const double b = ranked ? cross / score_squares : 0.0;
  const double chance = std::max(0.0, squares - b * cross) / std::max(1.0, n - (ranked ? 2.0 : 1.0));
  const double a = mean - b * mean_score;
  if (statistic.probability <= 0.0) return a;
  return a + normal_quantile(statistic.probability) * std::sqrt(b * b + chance);
}

}  // namespace

std::string ScatterStatistic::title() const {
  if (probability <= 0.0) return "mean over the scatter";
  char text[60];
  std::snprintf(text, sizeof text, "%.6g %% quantile over the scatter", 100.0 * probability);
  return text;
}

ScatterDifference compare_scatter(std::span<const double> values, std::span<const double> reference,
                                  std::span<const double> scores, const ScatterStatistic& statistic, double nothing) {
  ScatterDifference d;
  d.pairs = values.size();
  d.half_width = std::numeric_limits<double>::infinity();
  if (values.empty()) return d;
  const auto relative = [&](std::size_t left_out) {
    const double x = statistic_of(values, scores, statistic, left_out);
    const double y = statistic_of(reference, scores, statistic, left_out);
    if (left_out >= values.size()) d.value = x, d.reference = y;
    if (std::abs(x) <= nothing && std::abs(y) <= nothing) return 0.0;
    return (x - y) / std::max(std::abs(y), nothing);
  };
  d.difference = relative(values.size());
  if (values.size() < 4) return d;
  std::vector<double> without(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) without[k] = relative(k);
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(without.begin(), without.end(), 0.0) / n;
  double squares = 0.0;
  for (double w : without) squares += (w - mean) * (w - mean);
  const double standard_error = std::sqrt((n - 1.0) / n * squares);
  const double freedom = n - (scores.empty() ? 1.0 : 2.0);
  d.half_width = boost::math::quantile(boost::math::students_t(freedom), 0.975) * standard_error;
  return d;
}

ChosenSamples choose_samples(std::span<const double> ranked_by, std::size_t samples, std::size_t most,
                             const ScatterStatistic& statistic) {
  ChosenSamples chosen;
  std::vector<std::size_t> ranked;  // by value, lowest first
  for (std::size_t k = 0; k < std::min(ranked_by.size(), samples); ++k)
    if (std::isfinite(ranked_by[k])) ranked.push_back(k);
  // Ranks among few say little.
  if (ranked.size() < 2 * most) ranked.clear();
  std::sort(ranked.begin(), ranked.end(), [&](std::size_t a, std::size_t b) {
    return ranked_by[a] != ranked_by[b] ? ranked_by[a] < ranked_by[b] : a < b;
  });
  const bool all_alike = !ranked.empty() && ranked_by[ranked.front()] == ranked_by[ranked.back()];
  if (ranked.empty() || all_alike) {
    for (std::size_t k = 0; k < std::min(most, samples); ++k) chosen.sample.push_back(k);
    return chosen;
  }
  const double n = static_cast<double>(ranked.size());
  std::vector<double> score(samples, 0.0);
  // Blom's normal scores.
  for (std::size_t r = 0; r < ranked.size(); ++r)
    score[ranked[r]] = normal_quantile((static_cast<double>(r) + 0.625) / (n + 0.25));
  std::vector<bool> taken(samples, false);
  std::vector<std::size_t> plain = ranked, tail;
  std::sort(plain.begin(), plain.end());
  const double p = statistic.probability;
  if (p > 0.0 && (p < kMiddle || p > 1.0 - kMiddle)) {
    const double beyond = std::min(p, 1.0 - p);
    const std::size_t size = std::clamp(static_cast<std::size_t>(3.0 * beyond * n), (most + 1) / 2,
                                        std::max((most + 1) / 2, ranked.size() / 4));
    for (std::size_t r = 0; r < size; ++r) tail.push_back(p < 0.5 ? ranked[r] : ranked[ranked.size() - 1 - r]);
    std::sort(tail.begin(), tail.end());
  }
  const auto take_next = [&](const std::vector<std::size_t>& from, std::size_t& at) {
    while (at < from.size() && taken[from[at]]) ++at;
    if (at == from.size()) return;
    taken[from[at]] = true;
    chosen.sample.push_back(from[at]);
    chosen.score.push_back(score[from[at]]);
  };
  std::size_t next_plain = 0, next_tail = 0;
  while (chosen.sample.size() < most) {
    const std::size_t before = chosen.sample.size();
    take_next(plain, next_plain);
    if (chosen.sample.size() < most) take_next(tail, next_tail);
    if (chosen.sample.size() == before) break;
  }
  return chosen;
}

}  // namespace boresight
