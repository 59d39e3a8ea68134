#include "boresight/math/orthogonal_factors.hpp"

template class Eigen::ColPivHouseholderQR<boresight::MatX>;
template class Eigen::CompleteOrthogonalDecomposition<boresight::MatX>;
