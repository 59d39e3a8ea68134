// What the searches for a place of rest within a play are content with, whatever the shape of the joint.
#pragma once

namespace boresight::rest {

inline constexpr int kIterations = 200;
// Balance asked for: force left over, relative to the load.
inline constexpr double kBalance = 1e-10;
// Steps shorter than this share of the gap are rounding.
inline constexpr double kShortestStep = 1e-13;

}  // namespace boresight::rest
