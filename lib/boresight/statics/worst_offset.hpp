// The place in a part of a joint's gap that displaces most.
#pragma once

#include <vector>

#include "boresight/play/gap_part.hpp"

namespace boresight {

// The xi in the part with the largest |G xi|.
Vec3 worst_offset(const Eigen::Matrix<double, 3, 3>& G, const GapPart& part);

// Of parts that are lines (a slider's, each to one of its sides), all of one joint: the corner +- line + ... with the largest |G corner|. Their
// directions differ, so that this is less than the worst of each added up.
PlayOffsets worst_corner(const Eigen::Matrix<double, 3, kMostOffsets>& G, const std::vector<PlayOffsets>& lines);

}  // namespace boresight
