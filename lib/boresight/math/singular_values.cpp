#include "boresight/math/singular_values.hpp"

template class Eigen::BDCSVD<boresight::MatX>;
template class Eigen::JacobiSVD<boresight::MatX>;
