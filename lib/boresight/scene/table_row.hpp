// Rows of a scene's tables, as they are made: the entries of a matrix one after the other, row by row.
#pragma once

#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

template <typename Matrix>
void append(std::vector<double>& to, const Matrix& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) to.push_back(matrix(i, j));
}

}  // namespace boresight
