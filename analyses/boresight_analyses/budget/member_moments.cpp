#include "boresight_analyses/budget/member_moments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace boresight {

MemberSums sums_of(const std::vector<Vec3>& values) {
  MemberSums s;
  s.count = static_cast<double>(values.size());
  for (const Vec3& v : values) {
    s.sum += v;
    s.squares += v * v.transpose();
    s.most = s.most.cwiseMax(v.cwiseAbs());
  }
  return s;
}

std::vector<MemberSums> sums_of(const std::vector<std::vector<Vec3>>& members) {
  std::vector<MemberSums> sums;
  for (const std::vector<Vec3>& values : members) sums.push_back(sums_of(values));
  return sums;
}

Moments moments_of(std::span<const MemberSums> members, Eigen::Index axis, Interpretation interpretation,
                   std::span<const std::uint32_t> times) {
  double sum = 0.0, squares = 0.0, count = 0.0, worst = -1.0;
  Moments of_worst;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const MemberSums& m = members[k];
    const double drawn = times.empty() ? 1.0 : static_cast<double>(times[k]);
    if (drawn == 0.0 || m.count == 0.0) continue;
    if (const double square = m.squares(axis, axis) / m.count; square > worst) {
      worst = square;
      of_worst.mean = m.sum[axis] / m.count;
      of_worst.sd = std::sqrt(std::max(0.0, worst - of_worst.mean * of_worst.mean));
    }
    const bool ensemble = interpretation == Interpretation::ensemble;
    sum += drawn * (ensemble ? m.most[axis] : m.sum[axis]);
    squares += drawn * (ensemble ? m.most[axis] * m.most[axis] : m.squares(axis, axis));
    count += drawn * (ensemble ? 1.0 : m.count);
  }
  if (count == 0.0 || interpretation == Interpretation::temporal) return of_worst;
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

Mat3 covariance_of(std::span<const MemberSums> members, Interpretation interpretation,
                   std::span<const std::uint32_t> times) {
  MemberSums all;
  double worst = -1.0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const MemberSums& m = members[k];
    const double drawn = times.empty() ? 1.0 : static_cast<double>(times[k]);
    if (drawn == 0.0 || m.count == 0.0) continue;
    if (interpretation == Interpretation::temporal) {
      if (const double square = m.squares.trace() / m.count; square > worst) worst = square, all = m;
      continue;
    }
    all.count += drawn * m.count;
    all.sum += drawn * m.sum;
    all.squares += drawn * m.squares;
  }
  if (all.count == 0.0) return Mat3::Zero();
  const Vec3 mean = all.sum / all.count;
  const Mat3 covariance = all.squares / all.count - mean * mean.transpose();
  return interpretation == Interpretation::ensemble ? Mat3(covariance.diagonal().asDiagonal()) : covariance;
}

Mat3 factor_with(const Mat3& covariance, const Vec3& deviations) {
  Mat3 factor = Mat3(deviations.asDiagonal());
  Mat3 apart = covariance;
  apart.diagonal().setZero();
  if (apart.isZero(0.0)) return factor;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
  const Mat3 own = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  for (Eigen::Index a = 0; a < 3; ++a)
    if (const double length = own.row(a).norm(); length > 0.0) factor.row(a) = deviations[a] / length * own.row(a);
  return factor;
}

}  // namespace boresight
