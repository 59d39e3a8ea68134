#include "boresight_analyses/tails/subset_simulation.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

// Samples of one level: chain c is every `chains`-th sample from c on.
struct LevelSamples {
  Points points;
  std::vector<double> values;
  std::size_t chains = 0;
};

// Au and Beck, Eqs. 25-28: (1 - P) / (P N) (1 + gamma), gamma from the autocovariance of the indicator along the chains.
double coefficient_of_variation(const LevelSamples& level, double threshold, double P) {
  if (P <= 0.0) return std::numeric_limits<double>::infinity();
  const std::size_t N = level.values.size(), length = N / level.chains;
  const auto beyond = [&](std::size_t chain, std::size_t step) {
    return level.values[step * level.chains + chain] > threshold ? 1.0 : 0.0;
  };
  const double variance = P * (1.0 - P);
  double gamma = 0.0;
  for (std::size_t lag = 1; lag < length && variance > 0.0; ++lag) {
    double covariance = 0.0;
    for (std::size_t c = 0; c < level.chains; ++c)
      for (std::size_t s = 0; s + lag < length; ++s) covariance += beyond(c, s) * beyond(c, s + lag);
    covariance = covariance / double(N - lag * level.chains) - P * P;
    gamma += 2.0 * (1.0 - double(lag) / double(length)) * covariance / variance;
  }
  return std::sqrt(std::max(0.0, (1.0 - P) / (P * double(N)) * (1.0 + gamma)));
}

class Simulation {
 public:
  Simulation(const BatchModel& model, int dimensions, const SubsetOptions& options, SubsetResult& result)
      : model_(model),
        dimensions_(dimensions),
        options_(options),
        stream_(options.seed, StreamPurpose::subset),
        result_(result) {}

  LevelSamples first() const {
    LevelSamples level;
    for (int k = 0; k < options_.samples; ++k) level.points.push_back(normals(0, static_cast<std::uint64_t>(k)));
    level.values = evaluate(level.points);
    level.chains = level.points.size();
    return level;
  }

  // Chains from `seeds`, all beyond the threshold, to as many samples as before.
  LevelSamples next(std::uint64_t index, LevelSamples seeds, double threshold) const {
    const std::size_t chains = seeds.points.size();
    LevelSamples level = std::move(seeds);
    level.chains = chains;
    const double r = options_.correlation, s = std::sqrt(1.0 - r * r);
    while (level.points.size() + chains <= static_cast<std::size_t>(options_.samples)) {
      const std::size_t from = level.points.size() - chains;
      Points proposed(level.points.begin() + static_cast<std::ptrdiff_t>(from), level.points.end());
      for (std::size_t c = 0; c < chains; ++c) {
        const Point z = normals(index, level.points.size() + c);
        for (int j = 0; j < dimensions_; ++j) proposed[c][j] = r * proposed[c][j] + s * z[j];
      }
      const std::vector<double> values = evaluate(proposed);
      for (std::size_t c = 0; c < chains; ++c) {
        const bool stays = values[c] > threshold;
        // By value: the list grows.
        Point point = stays ? proposed[c] : level.points[from + c];
        const double value = stays ? values[c] : level.values[from + c];
        level.points.push_back(std::move(point));
        level.values.push_back(value);
      }
    }
    return level;
  }

 private:
  Point normals(std::uint64_t level, std::uint64_t sample) const {
    Point z(dimensions_);
    for (int j = 0; j < dimensions_; ++j)
      z[j] = gsl_cdf_ugaussian_Pinv(stream_.uniform(level, sample, static_cast<std::uint64_t>(j)));
    return z;
  }
  std::vector<double> evaluate(const Points& points) const {
    std::vector<double> values = model_(points);
    if (values.size() != points.size()) throw std::logic_error("a batch model must give one value per point");
    result_.evaluations += static_cast<std::int64_t>(points.size());
    for (double& v : values)
      if (!std::isfinite(v)) {
        v = std::numeric_limits<double>::infinity();
        ++result_.failed;
      }
    return values;
  }

  const BatchModel& model_;
  int dimensions_;
  const SubsetOptions& options_;
  CounterStream stream_;
  SubsetResult& result_;
};

LevelSamples largest(const LevelSamples& level, std::size_t count) {
  std::vector<std::size_t> order(level.values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return level.values[a] > level.values[b]; });
  LevelSamples seeds;
  for (std::size_t k = 0; k < count; ++k) {
    seeds.points.push_back(level.points[order[k]]);
    seeds.values.push_back(level.values[order[k]]);
  }
  return seeds;
}

void check(int dimensions, double limit, const SubsetOptions& o) {
  if (dimensions < 1) throw std::invalid_argument("subset simulation needs a dimension");
  if (!std::isfinite(limit)) throw std::invalid_argument("the limit must be finite");
  if (!(o.level > 0.0 && o.level <= 0.5) || std::abs(1.0 / o.level - std::round(1.0 / o.level)) > 1e-9)
    throw std::invalid_argument("1 / level must be a whole number, at least 2");
  if (o.samples * o.level < 10.0) throw std::invalid_argument("a level needs ten chains: samples >= 10 / level");
  if (!(o.correlation >= 0.0 && o.correlation < 1.0)) throw std::invalid_argument("correlation must lie in [0, 1)");
}

}  // namespace

SubsetResult subset_simulation(const BatchModel& model, int dimensions, double limit, const SubsetOptions& options) {
  check(dimensions, limit, options);
  SubsetResult result;
  result.probability = 1.0;
  const Simulation simulation(model, dimensions, options, result);
  const auto kept = static_cast<std::size_t>(std::lround(options.samples * options.level));
  LevelSamples level = simulation.first();
  double variance = 0.0;
  for (int index = 1;; ++index) {
    LevelSamples seeds = largest(level, kept);
    // Just below the last that is kept. Chains repeat values where a step was refused: ties go with it.
    const double last = seeds.values.back();
    double below = -std::numeric_limits<double>::infinity();
    for (const double v : level.values)
      if (v < last) below = std::max(below, v);
    double threshold = std::isfinite(last) ? 0.5 * (last + below) : below;
    const bool stuck = !std::isfinite(below);  // no two different values
    if (last > limit || stuck || index > options.most_levels)
      threshold = limit;
    else
      threshold = std::min(threshold, limit);
    const double beyond =
        double(std::count_if(level.values.begin(), level.values.end(), [&](double v) { return v > threshold; }));
    const double P = beyond / double(level.values.size());
    result.levels.push_back({threshold, P, coefficient_of_variation(level, threshold, P)});
    result.probability *= P;
    variance += std::pow(result.levels.back().coefficient_of_variation, 2);
    if (threshold >= limit) {
      for (std::size_t k = 0; k < level.points.size(); ++k)
        if (level.values[k] > limit) result.beyond.push_back(level.points[k]);
      result.reached = !result.beyond.empty() && !stuck && index <= options.most_levels;
      result.coefficient_of_variation = std::sqrt(variance);
      return result;
    }
    level = simulation.next(static_cast<std::uint64_t>(index), std::move(seeds), threshold);
  }
}

}  // namespace boresight
