// Whether a course over time is told by samples of it: one that is faster than they are is folded down, and a history of samples has it
// slower than it is, or not at all.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

namespace boresight {

// Mean square of what straight lines between samples miss of the course, over its variance: next to nothing of one with ten samples a period,
// 0.1 with four, 1 and more where it is folded. Looked at once in every cell, each time elsewhere in it. Zero of a course that does not vary.
double share_between_samples(const std::function<std::array<double, 3>(double)>& course, double start, double spacing,
                             std::size_t samples);

}  // namespace boresight
