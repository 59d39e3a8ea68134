// The place in a part of a joint's gap that displaces most.
#pragma once

#include "boresight/play/gap_part.hpp"

namespace boresight {

// The xi in the part with the largest |G xi|.
Vec3 worst_offset(const Eigen::Matrix<double, 3, 3>& G, const GapPart& part);

}  // namespace boresight
