// Densities whose moments are known in closed form.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <vector>

#include "boresight_analyses/posterior/log_density.hpp"

namespace boresight::known {

struct NormalDensity {
  VecX mean;
  MatX covariance;

  LogDensity log_density() const {
    return [m = mean, P = MatX(covariance.inverse())](const VecX& y, VecX& gradient) {
      gradient = -P * (y - m);
      return 0.5 * gradient.dot(y - m);
    };
  }
};

// Normal modes with weights. Mean and covariance of a mixture: of the means and within them.
struct Mixture {
  std::vector<double> weight;
  std::vector<NormalDensity> mode;

  VecX mean() const {
    VecX m = VecX::Zero(mode[0].mean.size());
    for (std::size_t k = 0; k < mode.size(); ++k) m += weight[k] * mode[k].mean;
    return m;
  }
  MatX covariance() const {
    const VecX m = mean();
    MatX C = MatX::Zero(m.size(), m.size());
    for (std::size_t k = 0; k < mode.size(); ++k)
      C += weight[k] * (mode[k].covariance + (mode[k].mean - m) * (mode[k].mean - m).transpose());
    return C;
  }
  LogDensity log_density() const {
    std::vector<LogDensity> part;
    std::vector<double> height;
    for (std::size_t k = 0; k < mode.size(); ++k) {
      part.push_back(mode[k].log_density());
      height.push_back(std::log(weight[k]) - 0.5 * std::log(mode[k].covariance.determinant()));
    }
    return [part, height](const VecX& y, VecX& gradient) {
      std::vector<double> value;
      std::vector<VecX> slope(part.size(), VecX::Zero(y.size()));
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < part.size(); ++k) {
        value.push_back(height[k] + part[k](y, slope[k]));
        most = std::max(most, value[k]);
      }
      double sum = 0.0;
      gradient.setZero(y.size());
      for (std::size_t k = 0; k < part.size(); ++k) {
        const double share = std::exp(value[k] - most);
        sum += share;
        gradient += share * slope[k];
      }
      gradient /= sum;
      return most + std::log(sum);
    };
  }
};

// x ~ N(0, 1), y given x ~ N(b x^2, s^2): bent, so that no one shape suits it. Mean (0, b), variances 1 and s^2 + 2 b^2.
inline LogDensity bent(double b, double s) {
  return [b, s](const VecX& y, VecX& gradient) {
    const double off = (y[1] - b * y[0] * y[0]) / (s * s);
    gradient.resize(2);
    gradient << -y[0] + 2.0 * b * y[0] * off, -off;
    return -0.5 * (y[0] * y[0] + off * off * s * s);
  };
}

}  // namespace boresight::known
