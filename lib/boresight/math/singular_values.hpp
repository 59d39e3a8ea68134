// The singular value decomposition of a matrix of any size, compiled once: Eigen's takes a compiler half a minute wherever it is used.
#pragma once

#include "boresight/math/types.hpp"

namespace boresight {

// A = U diag(values) V^T, A m x n: the min(m, n) values, the largest first, and all n columns of V.
struct SingularValues {
  VecX values;
  MatX V;
};
SingularValues singular_decomposition(const MatX& A);

// The values alone.
VecX singular_values(const MatX& A);

// What a QR factorisation with column pivoting proves of A's rank, for a twentieth of what the singular values cost.
// A P = Q [R11 R12; 0 R22], R11 of `rank` rows: sigma_rank >= kept >= 1 / |R11^-1|_F and sigma_(rank+1) <= dropped = |R22|_F
// (Golub and Van Loan, Matrix Computations, 4th ed. 2013, 5.4.2; singular values of a part interlace those of the whole, 2.4).
// `threshold`: the diagonal entries of R above it are counted. kept: infinite where none is.
struct RankBounds {
  int rank = 0;
  double kept = 0.0, dropped = 0.0;
};
RankBounds rank_bounds(const MatX& A, double threshold);

}  // namespace boresight
