#include "boresight_analyses/calibration/noise_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {
namespace {

NoiseScale at_scale(const ScaledResiduals& of, double square) {
  NoiseScale scale{.square = square, .log_weight = 0.0, .c = {}};
  const VecX v = of.g / square - of.m, M = (of.lambda / square).array() + 1.0;
  scale.c = -v.cwiseQuotient(M);
  scale.log_weight = -0.5 * (of.values / of.flattened * std::log(square) + M.array().log().sum() + of.rr / square +
                             of.known + v.dot(scale.c));
  return scale;
}

}  // namespace

std::vector<NoiseScale> noise_scales(const ScaledResiduals& of) {
  constexpr double kTiny = std::numeric_limits<double>::min();
  const double D = of.flattened;
  if (of.told > 0.0) return {at_scale(of, of.told * D)};
  const double most = std::max(of.rr, kTiny);
  if (of.lambda.size() == 0)
    return {{D * most / of.values, -0.5 * (of.values / D * std::log(most) + of.known), VecX()}};
  // The data's sum of squares lies between its least over c and what it is where the prior alone has c.
  double least = of.rr, by_prior = of.rr;
  for (Eigen::Index i = 0; i < of.lambda.size(); ++i) {
    if (of.lambda[i] > 0.0) least -= of.g[i] * of.g[i] / of.lambda[i];
    by_prior += 2.0 * of.g[i] * of.m[i] + of.lambda[i] * of.m[i] * of.m[i];
  }
  constexpr double kRounding = 1e-13;
  least = std::max({least, kRounding * most, kTiny});
  by_prior = std::max({by_prior, most, least});
  // Of log s; what the suspects take of the freedom lets s be larger. Beyond, a weight is less than exp(-30) of the largest.
  const double n = of.values / D, fewest = std::max(1.0, of.values - double(of.lambda.size())) / D;
  const double from = 0.5 * std::log(D * least / of.values) - 8.0 / std::sqrt(n),
               to = 0.5 * std::log(D * by_prior / (fewest * D)) + 30.0 / fewest + 8.0 / std::sqrt(fewest),
               step = std::min(0.5 / std::sqrt(2.0 * n), 0.25);
  std::vector<NoiseScale> scales;
  for (double t = from; t <= to + step; t += step) {
    scales.push_back(at_scale(of, std::exp(2.0 * t)));
    scales.back().log_weight += std::log(step);
  }
  return scales;
}

}  // namespace boresight
