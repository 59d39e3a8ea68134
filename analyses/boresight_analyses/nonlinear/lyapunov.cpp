#include "boresight_analyses/nonlinear/lyapunov.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace boresight {
namespace {

// Straight line through (t, y) from `first` up to `end`: slope and its standard error.
std::pair<double, double> line_through(const std::vector<double>& t, const std::vector<double>& y, std::size_t first,
                                       std::size_t end) {
  const double count = static_cast<double>(end - first);
  double mean_t = 0.0, mean_y = 0.0, tt = 0.0, ty = 0.0, residual = 0.0;
  for (std::size_t k = first; k < end; ++k) mean_t += t[k] / count, mean_y += y[k] / count;
  for (std::size_t k = first; k < end; ++k)
    tt += (t[k] - mean_t) * (t[k] - mean_t), ty += (t[k] - mean_t) * (y[k] - mean_y);
  const double slope = ty / tt;
  for (std::size_t k = first; k < end; ++k) {
    const double e = y[k] - mean_y - slope * (t[k] - mean_t);
    residual += e * e;
  }
  return {slope, count > 2.0 ? std::sqrt(residual / (count - 2.0) / tt) : 0.0};
}

}  // namespace

Divergence largest_lyapunov_exponent(const StateSeries& series, double apart, double horizon) {
  Divergence result;
  const Eigen::Index n = series.states.cols(), steps = std::max<Eigen::Index>(3, std::lround(horizon / series.spacing));
  const Eigen::Index last = n - steps, gap = std::max<Eigen::Index>(1, std::lround(apart / series.spacing));
  if (last < 2 * gap) return result;
  const VecX mean = series.states.rowwise().mean();
  VecX scale = ((series.states.colwise() - mean).cwiseAbs2().rowwise().mean()).cwiseSqrt();
  for (double& s : scale) s = s > 0.0 ? 1.0 / s : 0.0;
  const MatX x = scale.asDiagonal() * (series.states.colwise() - mean);

  std::vector<double> sum(steps + 1, 0.0);
  std::vector<long> counted(steps + 1, 0);
  // A few thousand reference states are plenty.
  const Eigen::Index stride = std::max<Eigen::Index>(1, last / 4000);
  for (Eigen::Index i = 0; i < last; i += stride) {
    double nearest = std::numeric_limits<double>::infinity();
    Eigen::Index neighbour = -1;
    for (Eigen::Index j = i % series.per_period; j < last; j += series.per_period) {
      if (std::abs(i - j) < gap) continue;
      const double d = (x.col(i) - x.col(j)).squaredNorm();
      if (d < nearest && d > 0.0) nearest = d, neighbour = j;
    }
    if (neighbour < 0) continue;
    ++result.pairs;
    for (Eigen::Index k = 0; k <= steps; ++k) {
      const double d = (x.col(i + k) - x.col(neighbour + k)).squaredNorm();
      if (d > 0.0) sum[k] += 0.5 * std::log(d), ++counted[k];
    }
  }
  if (result.pairs < 10) return result;
  for (Eigen::Index k = 0; k <= steps; ++k) {
    if (counted[k] == 0) continue;
    result.t.push_back(static_cast<double>(k) * series.spacing);
    result.log_distance.push_back(sum[k] / static_cast<double>(counted[k]));
  }
  // The rise: from two to seven tenths of the way to where the curve levels off (the mean of its last
  // quarter). Before it, differences still turn into the direction that grows fastest, which is faster or
  // slower than the exponent.
  const std::vector<double>& y = result.log_distance;
  const std::size_t count = y.size();
  double level = 0.0;
  for (std::size_t k = count - count / 4 - 1; k < count; ++k) level += y[k] / (count / 4 + 1);
  result.rises = level - y.front() > 1.0;
  const auto reaches = [&](double share) {
    const auto at =
        std::find_if(y.begin(), y.end(), [&](double v) { return v > y.front() + share * (level - y.front()); });
    return static_cast<std::size_t>(at - y.begin());
  };
  std::size_t first = 0, end = count;
  if (result.rises) {
    first = std::min(reaches(0.2), count - 3);
    end = std::clamp(reaches(0.7), first + 3, count);
  }
  std::tie(result.exponent, result.standard_error) = line_through(result.t, y, first, end);
  result.fitted_from = result.t[first];
  result.fitted_until = result.t[end - 1];
  return result;
}

}  // namespace boresight
