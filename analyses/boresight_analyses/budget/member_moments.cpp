#include "boresight_analyses/budget/member_moments.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {

Moments moments_of(const std::vector<std::vector<Vec3>>& members, Eigen::Index axis, Interpretation interpretation) {
  if (members.empty()) return {};
  double sum = 0.0, squares = 0.0, count = 0.0, worst = -1.0;
  Moments of_worst;
  for (const std::vector<Vec3>& values : members) {
    double own_sum = 0.0, own_squares = 0.0, most = 0.0;
    for (const Vec3& v : values) {
      own_sum += v[axis];
      own_squares += v[axis] * v[axis];
      most = std::max(most, std::abs(v[axis]));
    }
    const auto n = static_cast<double>(values.size());
    if (own_squares / n > worst) {
      worst = own_squares / n;
      of_worst.mean = own_sum / n;
      of_worst.sd = std::sqrt(std::max(0.0, worst - of_worst.mean * of_worst.mean));
    }
    const bool ensemble = interpretation == Interpretation::ensemble;
    sum += ensemble ? most : own_sum;
    squares += ensemble ? most * most : own_squares;
    count += ensemble ? 1.0 : n;
  }
  if (interpretation == Interpretation::temporal) return of_worst;
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

}  // namespace boresight
