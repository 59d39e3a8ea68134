// A mixture of Gaussians fitted to points by expectation-maximisation (Dempster, Laird, Rubin 1977), as the proposal of
// importance sampling: one component per region in which the excess lies.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "boresight/math/types.hpp"
#include "boresight_analyses/random/counter_stream.hpp"
#include "boresight_analyses/statistics/batch_model.hpp"

namespace boresight {

class GaussianMixture {
 public:
  // The standard normal space itself.
  explicit GaussianMixture(int dimensions);
  // Fitted to points of the given weights (none: all equal). At least 2 (d + 1) effective points a component are needed;
  // fewer components are made where there are fewer.
  GaussianMixture(const Points& points, const std::vector<double>& weights, int components, std::uint64_t seed);

  // What importance sampling asks of a proposal, that it is nowhere far below what it stands for: a quarter of each
  // component with twice its sd, for tails longer than Gaussian, and with the chance `share` the standard normal, so that
  // no weight exceeds 1 / share.
  GaussianMixture defended(double share) const;

  // The most that the standard normal density exceeds this one by, known of one that is defended and of the standard
  // normal itself: infinite of others.
  double most_weight() const { return most_weight_; }

  int dimensions() const { return static_cast<int>(components_[0].mean.size()); }
  std::size_t components() const { return components_.size(); }
  double log_density(const Point& u) const;
  // Draw (a, b) of the stream.
  Point draw(const CounterStream& stream, std::uint64_t a, std::uint64_t b) const;

 private:
  struct Component {
    double share = 1.0;
    VecX mean;
    MatX factor;             // Cholesky, lower
    double log_scale = 0.0;  // of the density at the mean
    double log_density(const VecX& u) const;
  };
  // The two steps of the fit: components from who belongs to them, and who belongs to them (gives the log-likelihood).
  void maximise(const MatX& x, const VecX& w, const MatX& belongs);
  double expect(const MatX& x, const VecX& w, MatX& belongs) const;
  static Component component(double share, VecX mean, const MatX& covariance);

  std::vector<Component> components_;
  double most_weight_ = std::numeric_limits<double>::infinity();
};

// ln of the standard normal density.
double log_standard_normal(const Point& u);

// Draws (set, from) to (set, to - 1), each with its weight: standard normal density over the mixture's.
struct WeightedDraws {
  Points points;
  std::vector<double> weights;
};
WeightedDraws weighted_draws(const GaussianMixture& mixture, const CounterStream& stream, std::uint64_t set,
                             std::int64_t from, std::int64_t to);

}  // namespace boresight
