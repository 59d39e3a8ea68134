#include "boresight/math/eigenvalues.hpp"

template class Eigen::SelfAdjointEigenSolver<boresight::MatX>;
template class Eigen::EigenSolver<boresight::MatX>;
