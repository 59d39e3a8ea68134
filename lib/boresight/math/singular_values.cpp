#include "boresight/math/singular_values.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {

namespace {

// The values alone of a matrix of so many rows and columns take a tenth of the time by a tridiagonal one, of smaller ones no less.
constexpr Eigen::Index kLarge = 32;

// Of A, no wider than high: reflections make it bidiagonal, and the eigenvalues of [0 B; B^T 0], tridiagonal once its rows are interleaved,
// are the singular values and their negatives (Golub and Van Loan, 8.6.1), each to rounding of the largest. Empty where they are not found.
VecX values_by_tridiagonal(MatX A) {
  const double scale = A.cwiseAbs().maxCoeff();
  if (!std::isfinite(scale) || scale < std::numeric_limits<double>::min()) return {};
  A /= scale;
  const Eigen::Index m = A.rows(), n = A.cols();
  VecX between(2 * n - 1), reflection, work(m);
  double tau = 0.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    A.col(k).tail(m - k).makeHouseholderInPlace(tau, between[2 * k]);
    const Eigen::Index right = n - k - 1;
    if (right == 0) break;
    reflection = A.col(k).tail(m - k - 1);
    A.bottomRightCorner(m - k, right).applyHouseholderOnTheLeft(reflection, tau, work.data());
    A.row(k).tail(right).makeHouseholderInPlace(tau, between[2 * k + 1]);
    reflection = A.row(k).tail(right - 1);
    A.bottomRightCorner(m - k - 1, right).applyHouseholderOnTheRight(reflection, tau, work.data());
  }
  Eigen::SelfAdjointEigenSolver<MatX> eigen;
  eigen.computeFromTridiagonal(VecX::Zero(2 * n), between, Eigen::EigenvaluesOnly);
  if (eigen.info() != Eigen::Success || !eigen.eigenvalues().allFinite()) return {};
  return scale * eigen.eigenvalues().tail(n).reverse().cwiseMax(0.0);
}

}  // namespace

// By Jacobi's rotations: the divide-and-conquer of Eigen 3.4.0 (BDCSVD), two to four times as fast, gives vectors of no null space and values
// off by 1e-5 once in a hundred matrices of the rows of parallel joints, whose singular values repeat. Eigen's decompositions read beyond
// a matrix that is empty.
SingularValues singular_decomposition(const MatX& A) {
  if (A.size() == 0) return {VecX(0), MatX::Identity(A.cols(), A.cols())};
  const Eigen::JacobiSVD<MatX> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

VecX singular_values(const MatX& A) {
  if (A.size() == 0) return VecX(0);
  if (std::min(A.rows(), A.cols()) >= kLarge)
    if (const VecX values = values_by_tridiagonal(A.rows() >= A.cols() ? A : MatX(A.transpose())); values.size() > 0)
      return values;
  return Eigen::JacobiSVD<MatX>(A).singularValues();
}

RankBounds rank_bounds(const MatX& A, double threshold) {
  if (A.size() == 0) return {0, std::numeric_limits<double>::infinity(), 0.0};
  const Eigen::ColPivHouseholderQR<MatX> qr(A);
  const MatX& R = qr.matrixQR();
  const int most = static_cast<int>(std::min(R.rows(), R.cols()));
  RankBounds bounds;
  while (bounds.rank < most && std::abs(R(bounds.rank, bounds.rank)) > threshold) ++bounds.rank;
  const int k = bounds.rank;
  const MatX inverse = R.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(MatX::Identity(k, k));
  bounds.kept = 1.0 / inverse.norm();
  // Below the diagonal stand the reflections.
  bounds.dropped = R.block(k, k, most - k, R.cols() - k).triangularView<Eigen::Upper>().toDenseMatrix().norm();
  return bounds;
}

}  // namespace boresight
