// Arrays of lanes over the coordinates: of a size known when compiling, so that loops over few of them unroll and their numbers
// stay in registers, or with room for the most that lanes take.
#pragma once

#include <array>

namespace boresight {

// The linear systems of an implicit step grow with the cube of the coordinates, three to five a joint: with twelve joints
// explicit steps of single samples are cheaper.
inline constexpr int kMostLaneJoints = 4, kMostLaneCoordinates = 5 * kMostLaneJoints;  // see serve()

// N: number of coordinates, 0 if known only when running. Not zero from the start.
template <typename T, int N>
using LaneVector = std::array<T, N == 0 ? kMostLaneCoordinates : N>;
template <typename T, int N>
using LaneMatrix = std::array<T, N == 0 ? kMostLaneCoordinates * kMostLaneCoordinates : N * N>;  // n x n, row by row

}  // namespace boresight
