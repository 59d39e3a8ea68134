// Arrays of lanes over the coordinates, of a size known when compiling.
#pragma once

#include <array>

namespace boresight {

// Not zero from the start.
template <typename T, int N>
using LaneVector = std::array<T, N>;
template <typename T, int N>
using LaneMatrix = std::array<T, N * N>;  // row by row

}  // namespace boresight
