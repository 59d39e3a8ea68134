// How large the errors of a contributor get, so that those are refused whose squares no number holds.
#pragma once

#include "boresight_analyses/budget/contributor.hpp"

namespace boresight {

// SI: of a standing error in its own unit, of everything else in that of the index. Nothing that points is off by so much: it is no
// error but a slip in a unit or an exponent.
inline constexpr double kLargestExternalError = 1e9;

// By the worst end of its distributions, or three deviations. Infinite where no number is so large. `samples`: of the histories.
double largest_size(const Contributor& contributor, const Windows& windows, double duration, std::size_t samples);

}  // namespace boresight
