#include "boresight/math/dense_solves.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "boresight/math/orthogonal_factors.hpp"

namespace boresight {

namespace {

Eigen::CompleteOrthogonalDecomposition<MatX> decomposed(const MatX& A, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatX> solver;
  if (threshold != kByRounding) solver.setThreshold(threshold);
  solver.compute(A);
  return solver;
}

}  // namespace

VecX solve_positive(const MatX& A, const VecX& b) { return A.llt().solve(b); }
MatX solve_positive(const MatX& A, const MatX& B) { return A.llt().solve(B); }

VecX solve_symmetric(const MatX& A, const VecX& b) { return A.ldlt().solve(b); }
MatX solve_symmetric(const MatX& A, const MatX& B) { return A.ldlt().solve(B); }

VecX solve_square(const MatX& A, const VecX& b) { return A.partialPivLu().solve(b); }
MatX solve_square(const MatX& A, const MatX& B) { return A.partialPivLu().solve(B); }

// Eigen's decomposition reads beyond a matrix that is empty.
VecX solve_least(const MatX& A, const VecX& b, double threshold) {
  if (A.size() == 0) return VecX::Zero(A.cols());
  return decomposed(A, threshold).solve(b);
}
MatX solve_least(const MatX& A, const MatX& B, double threshold) {
  if (A.size() == 0) return MatX::Zero(A.cols(), B.cols());
  return decomposed(A, threshold).solve(B);
}

MatX pseudo_inverse(const MatX& A, double threshold) {
  if (A.size() == 0) return MatX::Zero(A.cols(), A.rows());
  return decomposed(A, threshold).pseudoInverse();
}

MatX cholesky_factor(const MatX& A) { return A.llt().matrixL(); }

MatX orthonormal_in(const MatX& A) { return A.llt().matrixU().solve(MatX::Identity(A.rows(), A.cols())); }

std::optional<MatX> solve_if_positive(const MatX& A, const MatX& B, double least_rcond) {
  const Eigen::LLT<MatX> cholesky(A);
  if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > least_rcond)) return std::nullopt;
  return cholesky.solve(B);
}

}  // namespace boresight
