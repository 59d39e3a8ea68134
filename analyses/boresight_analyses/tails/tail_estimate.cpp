#include "boresight_analyses/tails/tail_estimate.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight_analyses/statistics/betting_mean.hpp"
#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/running.hpp"

namespace boresight {
namespace {

constexpr std::int64_t kBatch = 1024;

// Weights of the points beyond the limit.
struct Excess {
  double sum = 0.0, squares = 0.0;
  std::vector<double> weights = {};
  void add(double weight) {
    sum += weight;
    squares += weight * weight;
    weights.push_back(weight);
  }
  double effective() const { return squares > 0.0 ? sum * sum / squares : 0.0; }
};

std::vector<double> evaluate(const BatchModel& model, const Points& points, std::int64_t& evaluations,
                             std::int64_t& failed) {
  std::vector<double> values = model(points);
  if (values.size() != points.size()) throw std::logic_error("a batch model must give one value per point");
  evaluations += static_cast<std::int64_t>(points.size());
  failed += std::count_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  return values;
}

void finish(TailEstimate& e, double value, double error, double degrees, double confidence, const char* basis) {
  const double half = gsl_cdf_tdist_Qinv(0.5 * (1.0 - confidence), degrees) * error;
  e.standard_error = error;
  e.probability = {
      value, std::clamp(value - half, 0.0, 1.0), std::clamp(value + half, 0.0, 1.0), confidence, confidence, false,
      basis};
}

// Of the exact points alone: what they say does not hang on how the two models agree.
void bound(TailEstimate& e, const Excess& excess, const GaussianMixture& proposal, double confidence) {
  e.most_weight = proposal.most_weight();
  IndependentInterval& b = e.bounds;
  b = {e.probability.value, 0.0, 1.0, confidence, confidence, false, "none: the proposal's weights are not bounded"};
  if (!std::isfinite(e.most_weight)) return;
  const double side = 0.5 * (1.0 + confidence);
  const std::int64_t points = e.exact_evaluations;
  if (e.most_weight == 1.0) {
    b.low = clopper_pearson_lower(e.exceedances, points, side);
    b.high = clopper_pearson_upper(e.exceedances, points, side);
    b.basis = "Clopper-Pearson over " + std::to_string(points) + " independent points";
    return;
  }
  std::vector<double> shares;
  for (const double w : excess.weights) shares.push_back(std::min(1.0, w / e.most_weight));
  const std::int64_t zeros = points - e.exceedances;
  b.low = std::min(1.0, e.most_weight * betting_lower(shares, zeros, side));
  b.high = std::min(1.0, e.most_weight * betting_upper(shares, zeros, side));
  b.basis = "betting on bounded weights of " + std::to_string(points) + " independent points";
}

void check(std::int64_t points) {
  if (points < 2) throw std::invalid_argument("importance sampling needs two points");
}

}  // namespace

TailEstimate importance_sampling(const BatchModel& model, double limit, const GaussianMixture& proposal,
                                 std::int64_t points, const TailOptions& options) {
  check(points);
  const CounterStream stream(options.seed, StreamPurpose::proposal);
  TailEstimate e;
  RunningMoments moments;
  Excess excess;
  for (std::int64_t from = 0; from < points; from += kBatch) {
    const WeightedDraws d = weighted_draws(proposal, stream, 2 * options.stream, from, std::min(points, from + kBatch));
    const std::vector<double> y = evaluate(model, d.points, e.exact_evaluations, e.failed);
    for (std::size_t k = 0; k < y.size(); ++k) {
      const bool bad = is_beyond(y[k], limit);
      moments.add(bad ? d.weights[k] : 0.0);
      if (bad) excess.add(d.weights[k]);
      e.exceedances += bad;
    }
  }
  e.effective_exceedances = excess.effective();
  finish(e, moments.mean(), moments.sd() / std::sqrt(double(points)), double(points) - 1.0, options.confidence,
         "importance sampling, central limit");
  bound(e, excess, proposal, options.confidence);
  return e;
}

TailEstimate two_level_importance_sampling(const BatchModel& cheap, const BatchModel& exact, double limit,
                                           const GaussianMixture& proposal, std::int64_t cheap_points,
                                           std::int64_t exact_points, double control, const TailOptions& options) {
  check(cheap_points);
  check(exact_points);
  const CounterStream stream(options.seed, StreamPurpose::proposal);
  TailEstimate e;
  RunningMoments alone, correction;
  Excess excess;
  for (std::int64_t from = 0; from < cheap_points; from += kBatch) {
    const WeightedDraws d =
        weighted_draws(proposal, stream, 2 * options.stream, from, std::min(cheap_points, from + kBatch));
    const std::vector<double> y = evaluate(cheap, d.points, e.cheap_evaluations, e.failed);
    for (std::size_t k = 0; k < y.size(); ++k) alone.add(is_beyond(y[k], limit) ? control * d.weights[k] : 0.0);
  }
  for (std::int64_t from = 0; from < exact_points; from += kBatch) {
    const WeightedDraws d =
        weighted_draws(proposal, stream, 2 * options.stream + 1, from, std::min(exact_points, from + kBatch));
    const std::vector<double> c = evaluate(cheap, d.points, e.cheap_evaluations, e.failed);
    const std::vector<double> y = evaluate(exact, d.points, e.exact_evaluations, e.failed);
    for (std::size_t k = 0; k < y.size(); ++k) {
      const bool bad = is_beyond(y[k], limit);
      correction.add(d.weights[k] * (double(bad) - control * double(is_beyond(c[k], limit))));
      e.disagreements += bad != is_beyond(c[k], limit);
      if (bad) excess.add(d.weights[k]);
      e.exceedances += bad;
    }
  }
  e.effective_exceedances = excess.effective();
  const double va = alone.variance() / double(cheap_points), vc = correction.variance() / double(exact_points);
  // Welch and Satterthwaite's degrees of freedom of a sum of two means.
  const double spread = va * va / double(cheap_points - 1) + vc * vc / double(exact_points - 1);
  const double degrees = spread > 0.0 ? (va + vc) * (va + vc) / spread : double(exact_points - 1);
  finish(e, alone.mean() + correction.mean(), std::sqrt(va + vc), degrees, options.confidence,
         "importance sampling on the cheap model, corrected on the exact one, central limit");
  bound(e, excess, proposal, options.confidence);
  return e;
}

}  // namespace boresight
