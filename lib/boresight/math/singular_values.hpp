// The singular value decomposition of a matrix of any size, compiled once: Eigen's takes a compiler half a minute wherever it is used.
#pragma once

#include <Eigen/SVD>

#include "boresight/math/types.hpp"

extern template class Eigen::BDCSVD<boresight::MatX>;
extern template class Eigen::JacobiSVD<boresight::MatX>;
