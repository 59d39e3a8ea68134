// Eigenvalues of matrices of any size, compiled once: Eigen's take a compiler seconds wherever they are used.
#pragma once

#include <Eigen/Eigenvalues>

#include "boresight/math/types.hpp"

extern template class Eigen::SelfAdjointEigenSolver<boresight::MatX>;
extern template class Eigen::EigenSolver<boresight::MatX>;
