#include "boresight_analyses/calibration/channel_variances.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace boresight {

ChannelVariances::ChannelVariances(std::vector<SharedNoise> noises, const MatX& seen, const VecX& prior)
    : noises_(std::move(noises)), prior_(prior) {
  const auto count = static_cast<Eigen::Index>(noises_.size());
  const auto noise = [&](Eigen::Index c) -> const SharedNoise& { return noises_[static_cast<std::size_t>(c)]; };
  std::vector<MatX> taken;  // B H
  for (const SharedNoise& one : noises_) taken.push_back(seen * one.information);
  const auto unknowns = [&](Eigen::Index c, Eigen::Index d) {
    return taken[static_cast<std::size_t>(c)]
        .cwiseProduct(taken[static_cast<std::size_t>(d)].transpose())
        .sum();  // the trace of their product
  };
  variance_.resize(count);
  MatX K(count, count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const double own = taken[static_cast<std::size_t>(c)].trace(), mean_slope = noise(c).psi_slope / noise(c).values;
    // As infer() has it of all channels together.
    variance_[c] = noise(c).psi_square / std::max(1.0, noise(c).values - own) / std::max(mean_slope, 1e-3);
    for (Eigen::Index d = 0; d < count; ++d) K(c, d) = unknowns(c, d) + (c == d ? noise(c).values - 2.0 * own : 0.0);
  }
  // No noise is known by less than one value.
  const Eigen::SelfAdjointEigenSolver<MatX> solver(K);
  uncertainty_ = 2.0 * solver.eigenvectors() * solver.eigenvalues().cwiseMax(1.0).cwiseInverse().asDiagonal() *
                 solver.eigenvectors().transpose();
  weights_ = MatX::Zero(seen.rows(), seen.cols());
  for (Eigen::Index c = 0; c < count; ++c)
    for (Eigen::Index d = 0; d < count; ++d) {
      if (!noise(c).estimated || !noise(d).estimated) continue;
      if (c == d) weights_ += uncertainty_(c, c) * noise(c).information;
      weights_ -= uncertainty_(c, d) * noise(c).information * taken[static_cast<std::size_t>(d)];
    }
  weights_ = 0.5 * (weights_ + weights_.transpose()).eval();
}

MatX ChannelVariances::departure(double variance_factor) const {
  MatX sum = 2.0 * weights_;
  for (std::size_t c = 0; c < noises_.size(); ++c)
    sum += (variance_[static_cast<Eigen::Index>(c)] - variance_factor) * noises_[c].information;
  return sum;
}

double ChannelVariances::freedom(const VecX& z, double otherwise) const {
  VecX of_noise(variance_.size());
  for (Eigen::Index c = 0; c < of_noise.size(); ++c)
    of_noise[c] = variance_[c] * z.dot(noises_[static_cast<std::size_t>(c)].information * z);
  const double scatter = of_noise.size() > 0 ? of_noise.dot(uncertainty_ * of_noise) : 0.0;
  if (!(scatter > 0.0)) return otherwise;
  const double all = of_noise.sum() + prior_.dot(z.cwiseAbs2());
  return std::max(1.0, 2.0 * all * all / scatter);
}

}  // namespace boresight
