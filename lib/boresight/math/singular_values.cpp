#include "boresight/math/singular_values.hpp"

#include <Eigen/SVD>

namespace boresight {

SingularValues singular_decomposition(const MatX& A) {
  const Eigen::BDCSVD<MatX> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

VecX singular_values(const MatX& A) { return Eigen::BDCSVD<MatX>(A).singularValues(); }

}  // namespace boresight
