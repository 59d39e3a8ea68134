// Solutions of dense systems of any size, compiled once: Eigen's solvers take a compiler seconds in every file that names them. What every
// instant of a motion solves keeps its own factors.
#pragma once

#include <optional>

#include "boresight/math/types.hpp"

namespace boresight {

// x of A x = b (n x n, n or n x m), A symmetric and positive definite, by Cholesky's factors.
VecX solve_positive(const MatX& A, const VecX& b);
MatX solve_positive(const MatX& A, const MatX& B);

// The same of a symmetric A, definite or not, by its factors L D L^T.
VecX solve_symmetric(const MatX& A, const VecX& b);
MatX solve_symmetric(const MatX& A, const MatX& B);

// The same of any square A that is not singular, by LU with partial pivots.
VecX solve_square(const MatX& A, const VecX& b);
MatX solve_square(const MatX& A, const MatX& B);

// The x of least size among those that bring A x nearest to b (m x n, m), by a complete orthogonal decomposition. What is below
// threshold of the largest pivot counts as nothing; kByRounding: what rounding leaves (Eigen's own: n times the machine's epsilon).
inline constexpr double kByRounding = -1.0;
VecX solve_least(const MatX& A, const VecX& b, double threshold = kByRounding);
MatX solve_least(const MatX& A, const MatX& B, double threshold = kByRounding);

// The matrix that takes any b to that x (Moore and Penrose's inverse).
MatX pseudo_inverse(const MatX& A, double threshold = kByRounding);

// L of A = L L^T, A symmetric and positive definite; and the inverse of L^T, whose columns are of length one in the metric of A.
MatX cholesky_factor(const MatX& A);
MatX orthonormal_in(const MatX& A);

// X of A X = B as solve_positive finds it; none where A is not positive definite, or so nearly singular that the reciprocal of its condition
// number is at most least_rcond.
std::optional<MatX> solve_if_positive(const MatX& A, const MatX& B, double least_rcond);

}  // namespace boresight
