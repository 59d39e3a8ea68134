#include "boresight_analyses/tails/gaussian_mixture.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "boresight/math/dense_solves.hpp"

namespace boresight {
namespace {

constexpr int kRounds = 100;
constexpr double kSettled = 1e-6;        // relative change of the log-likelihood
constexpr double kLeastVariance = 1e-4;  // of the standard normal's: no component collapses onto a point

double log_sum(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double l : logs) sum += std::exp(l - top);
  return top + std::log(sum);
}

VecX as_vector(const Point& u) { return Eigen::Map<const VecX>(u.data(), static_cast<Eigen::Index>(u.size())); }

// Rows far from each other (Arthur, Vassilvitskii 2007): each drawn with its weight and the square of its distance to
// those before.
std::vector<Eigen::Index> far_starts(const MatX& x, const VecX& w, int count, std::uint64_t seed) {
  const CounterStream stream(seed, StreamPurpose::proposal);
  std::uint64_t draws = 0;
  const auto drawn = [&](const VecX& chance) {
    double left = stream.uniform(~0ull, draws++) * chance.sum();
    Eigen::Index pick = 0;
    while (pick + 1 < chance.size() && (left -= chance[pick]) > 0.0) ++pick;
    return pick;
  };
  std::vector<Eigen::Index> starts = {drawn(w)};
  VecX distance = VecX::Constant(x.rows(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(starts.size()) < count) {
    distance = distance.cwiseMin((x.rowwise() - x.row(starts.back())).rowwise().squaredNorm());
    starts.push_back(drawn(w.cwiseProduct(distance)));
  }
  return starts;
}

}  // namespace

double log_standard_normal(const Point& u) {
  double square = 0.0;
  for (const double x : u) square += x * x;
  return -0.5 * square - 0.5 * double(u.size()) * std::log(2.0 * std::numbers::pi);
}

double GaussianMixture::Component::log_density(const VecX& u) const {
  return log_scale - 0.5 * factor.triangularView<Eigen::Lower>().solve(u - mean).squaredNorm();
}

GaussianMixture::Component GaussianMixture::component(double share, VecX mean, const MatX& covariance) {
  Component c;
  c.share = share;
  c.factor = cholesky_factor(covariance);
  c.log_scale = -0.5 * double(mean.size()) * std::log(2.0 * std::numbers::pi) - c.factor.diagonal().array().log().sum();
  c.mean = std::move(mean);
  return c;
}

GaussianMixture::GaussianMixture(int dimensions)
    : components_{component(1.0, VecX::Zero(dimensions), MatX::Identity(dimensions, dimensions))}, most_weight_(1.0) {}

GaussianMixture::GaussianMixture(const Points& points, const std::vector<double>& weights, int components,
                                 std::uint64_t seed) {
  if (points.empty()) throw std::invalid_argument("a mixture needs points");
  const auto n = static_cast<Eigen::Index>(points.size()), d = static_cast<Eigen::Index>(points[0].size());
  VecX w = weights.empty() ? VecX::Ones(n) : as_vector(weights);
  if (w.size() != n || !(w.minCoeff() >= 0.0) || !(w.sum() > 0.0))
    throw std::invalid_argument("a mixture needs one weight >= 0 per point, not all zero");
  w *= w.sum() / w.squaredNorm();  // adds up to the effective number of points
  const double effective = w.sum();
  components = std::clamp(static_cast<int>(effective / (2.0 * double(d + 1))), 1, std::max(1, components));
  MatX x(n, d);
  for (Eigen::Index k = 0; k < n; ++k) x.row(k) = as_vector(points[k]);

  MatX belongs = MatX::Zero(n, components);
  const std::vector<Eigen::Index> starts = far_starts(x, w, components, seed);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index nearest = 0;
    for (Eigen::Index c = 1; c < components; ++c)
      if ((x.row(k) - x.row(starts[c])).squaredNorm() < (x.row(k) - x.row(starts[nearest])).squaredNorm()) nearest = c;
    belongs(k, nearest) = 1.0;
  }
  double likelihood = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    maximise(x, w, belongs);
    const double now = expect(x, w, belongs);
    if (std::abs(now - likelihood) < kSettled * std::abs(now)) break;
    likelihood = now;
  }
}

void GaussianMixture::maximise(const MatX& x, const VecX& w, const MatX& belongs) {
  const Eigen::Index d = x.cols();
  const auto fitted = [&](const VecX& weight) {
    const VecX mean = x.transpose() * weight / weight.sum();
    const MatX centred = x.rowwise() - mean.transpose();
    return component(
        weight.sum(), mean,
        centred.transpose() * weight.asDiagonal() * centred / weight.sum() + kLeastVariance * MatX::Identity(d, d));
  };
  components_.clear();
  for (Eigen::Index c = 0; c < belongs.cols(); ++c) {
    const VecX weight = belongs.col(c).cwiseProduct(w);
    if (weight.sum() >= double(d + 1)) components_.push_back(fitted(weight));  // else too few to speak of a covariance
  }
  if (components_.empty()) components_.push_back(fitted(w));
  double shares = 0.0;
  for (const Component& c : components_) shares += c.share;
  for (Component& c : components_) c.share /= shares;
}

double GaussianMixture::expect(const MatX& x, const VecX& w, MatX& belongs) const {
  belongs.resize(x.rows(), static_cast<Eigen::Index>(components_.size()));
  std::vector<double> logs(components_.size());
  double likelihood = 0.0;
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    for (std::size_t c = 0; c < logs.size(); ++c)
      logs[c] = std::log(components_[c].share) + components_[c].log_density(x.row(k).transpose());
    const double total = log_sum(logs);
    likelihood += w[k] * total;
    for (std::size_t c = 0; c < logs.size(); ++c) belongs(k, static_cast<Eigen::Index>(c)) = std::exp(logs[c] - total);
  }
  return likelihood;
}

GaussianMixture GaussianMixture::defended(double share) const {
  if (!(share > 0.0 && share < 1.0)) throw std::invalid_argument("the defensive share must lie between 0 and 1");
  GaussianMixture result(dimensions());
  result.components_[0].share = share;
  result.most_weight_ = 1.0 / share;
  for (const Component& c : components_) {
    const MatX covariance = c.factor * c.factor.transpose();
    result.components_.push_back(component(0.75 * (1.0 - share) * c.share, c.mean, covariance));
    result.components_.push_back(component(0.25 * (1.0 - share) * c.share, c.mean, 4.0 * covariance));
  }
  return result;
}

double GaussianMixture::log_density(const Point& u) const {
  std::vector<double> logs;
  const VecX x = as_vector(u);
  for (const Component& c : components_) logs.push_back(std::log(c.share) + c.log_density(x));
  return log_sum(logs);
}

Point GaussianMixture::draw(const CounterStream& stream, std::uint64_t a, std::uint64_t b) const {
  double left = stream.uniform(a, b, 0);
  std::size_t pick = 0;
  while (pick + 1 < components_.size() && (left -= components_[pick].share) > 0.0) ++pick;
  VecX z(dimensions());
  for (Eigen::Index j = 0; j < z.size(); ++j)
    z[j] = gsl_cdf_ugaussian_Pinv(stream.uniform(a, b, static_cast<std::uint64_t>(j) + 1));
  const VecX u = components_[pick].mean + components_[pick].factor * z;
  return Point(u.data(), u.data() + u.size());
}

WeightedDraws weighted_draws(const GaussianMixture& mixture, const CounterStream& stream, std::uint64_t set,
                             std::int64_t from, std::int64_t to) {
  WeightedDraws d;
  for (std::int64_t k = from; k < to; ++k) {
    d.points.push_back(mixture.draw(stream, set, static_cast<std::uint64_t>(k)));
    d.weights.push_back(std::exp(log_standard_normal(d.points.back()) - mixture.log_density(d.points.back())));
  }
  return d;
}

}  // namespace boresight
