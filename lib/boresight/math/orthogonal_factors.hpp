// Orthogonal factors of matrices of any size, with pivots, compiled once: Eigen's take a compiler seconds wherever they are used.
#pragma once

#include <Eigen/QR>

#include "boresight/math/types.hpp"

extern template class Eigen::ColPivHouseholderQR<boresight::MatX>;
extern template class Eigen::CompleteOrthogonalDecomposition<boresight::MatX>;
