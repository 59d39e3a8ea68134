#include "boresight_analyses/random/copula.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "boresight/math/dense_solves.hpp"
#include "boresight/math/eigenvalues.hpp"

namespace boresight {
namespace {

double uniform_of(double score) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  return std::clamp(boost::math::cdf(boost::math::normal(), score), kEpsilon, 1.0 - kEpsilon);
}

}  // namespace

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
  factor_ = cholesky_factor(correlation);
  for (Eigen::Index i = 0; i < factor_.rows(); ++i) changed_.push_back(!factor_.row(i).head(i).isZero(0.0));
}

bool GaussianCopula::correlated(std::size_t i) const {
  if (independent()) return false;
  const auto k = static_cast<Eigen::Index>(i);
  return changed_[i] || !factor_.col(k).tail(factor_.rows() - k - 1).isZero(0.0);
}

void GaussianCopula::renew(std::span<const double> a, std::span<const double> b, const std::vector<bool>& renewed,
                           std::span<double> out) const {
  std::vector<std::size_t> anew, kept;  // of those that depend on others
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = renewed[i] ? b[i] : a[i];
    if (correlated(i)) (renewed[i] ? anew : kept).push_back(i);
  }
  if (anew.empty() && kept.empty()) return;
  const auto scores = [&](std::span<const double> coordinates) {
    const boost::math::normal standard;
    Eigen::VectorXd z(factor_.rows());
    for (Eigen::Index i = 0; i < z.size(); ++i)
      z[i] = boost::math::quantile(standard, coordinates[static_cast<std::size_t>(i)]);
    return Eigen::VectorXd(factor_.triangularView<Eigen::Lower>() * z);
  };
  const Eigen::VectorXd y_a = scores(a), y_b = scores(b);
  const auto part = [](const Eigen::VectorXd& y, const std::vector<std::size_t>& of) {
    Eigen::VectorXd taken(static_cast<Eigen::Index>(of.size()));
    for (std::size_t k = 0; k < of.size(); ++k)
      taken[static_cast<Eigen::Index>(k)] = y[static_cast<Eigen::Index>(of[k])];
    return taken;
  };
  const auto block = [&](const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns) {
    Eigen::MatrixXd r(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j)
        r(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            factor_.row(static_cast<Eigen::Index>(rows[i])).dot(factor_.row(static_cast<Eigen::Index>(columns[j])));
    return r;
  };
  Eigen::VectorXd y_anew = part(y_b, anew);
  if (!anew.empty() && !kept.empty())
    y_anew += block(anew, kept) * solve_positive(block(kept, kept), VecX(part(y_a, kept) - part(y_b, kept)));
  for (std::size_t k = 0; k < kept.size(); ++k) out[kept[k]] = uniform_of(y_a[static_cast<Eigen::Index>(kept[k])]);
  for (std::size_t k = 0; k < anew.size(); ++k) out[anew[k]] = uniform_of(y_anew[static_cast<Eigen::Index>(k)]);
}

void GaussianCopula::apply(std::span<double> coordinates) const {
  if (independent()) return;
  const boost::math::normal standard;
  Eigen::VectorXd z(factor_.rows());
  for (Eigen::Index i = 0; i < z.size(); ++i)
    z[i] = boost::math::quantile(standard, coordinates[static_cast<std::size_t>(i)]);
  for (Eigen::Index i = 0; i < z.size(); ++i)
    if (changed_[static_cast<std::size_t>(i)])
      coordinates[static_cast<std::size_t>(i)] = uniform_of(factor_.row(i).head(i + 1).dot(z.head(i + 1)));
}

}  // namespace boresight
