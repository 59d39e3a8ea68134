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

}  // namespace boresight
