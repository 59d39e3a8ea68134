#include "boresight_analyses/random/copula.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "boresight/math/eigenvalues.hpp"

namespace boresight {

double normal_from_spearman(double rank_correlation) {
  return 2.0 * std::sin(std::numbers::pi / 6.0 * rank_correlation);
}
double normal_from_kendall(double tau) { return std::sin(0.5 * std::numbers::pi * tau); }

GaussianCopula::GaussianCopula(const Eigen::MatrixXd& correlation) {
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlation, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!(least > 1e-10)) {
    char text[120];
    std::snprintf(text, sizeof text, "the correlation matrix is not positive definite (smallest eigenvalue %.3g)",
                  least);
    throw std::domain_error(text);
  }
  factor_ = correlation.llt().matrixL();
  for (Eigen::Index i = 0; i < factor_.rows(); ++i) changed_.push_back(!factor_.row(i).head(i).isZero(0.0));
}

void GaussianCopula::apply(std::span<double> coordinates) const {
  if (independent()) return;
  const boost::math::normal standard;
  Eigen::VectorXd z(factor_.rows());
  for (Eigen::Index i = 0; i < z.size(); ++i)
    z[i] = boost::math::quantile(standard, coordinates[static_cast<std::size_t>(i)]);
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < z.size(); ++i)
    if (changed_[static_cast<std::size_t>(i)])
      coordinates[static_cast<std::size_t>(i)] = std::clamp(
          boost::math::cdf(standard, factor_.row(i).head(i + 1).dot(z.head(i + 1))), kEpsilon, 1.0 - kEpsilon);
}

}  // namespace boresight
