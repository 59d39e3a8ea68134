// The logarithm of a density, up to a constant, and its gradient: what a sampler asks of whatever it samples.
#pragma once

#include <functional>

#include "boresight/math/types.hpp"

namespace boresight {

// At y: log p(y), and d log p / dy into `gradient`, which has the size of y. -infinity where y cannot be; the gradient says
// nothing there. Called from several threads at once.
using LogDensity = std::function<double(const VecX& y, VecX& gradient)>;

}  // namespace boresight
