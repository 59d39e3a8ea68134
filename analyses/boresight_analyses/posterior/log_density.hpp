// The logarithm of a density, up to a constant, and its gradient: what a sampler asks of whatever it samples.
#pragma once

#include <functional>

#include "boresight/math/types.hpp"

namespace boresight {

// At y: log p(y), and d log p / dy into `gradient`, which has the size of y, or none where it is not asked for. -infinity where y
// cannot be; the gradient says nothing there. Called from several threads at once.
using LogDensity = std::function<double(const VecX& y, VecX& gradient)>;

// What is sampled. Where its gradient costs much more than its value, `guide` stands in for it along trajectories: a density near it
// that costs next to nothing. The draws are those of `exact` all the same, which decides what is accepted; of a guide that leads astray
// they are fewer. Rasmussen (2003), Gaussian processes to speed up hybrid Monte Carlo for expensive Bayesian integrals, Bayesian
// Statistics 7, 651-659; Neal (2011), section 5.5.
struct SampledDensity {
  LogDensity exact;
  LogDensity guide = {};  // none: exact gradients
};

}  // namespace boresight
