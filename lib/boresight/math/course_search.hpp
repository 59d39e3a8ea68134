// Where a function of time is no course that a motion can follow: no number, a jump, a corner.
#pragma once

#include "boresight/math/time_function.hpp"

namespace boresight {

// The first of `samples` + 1 even times in [0, duration] at which value or a derivative is not finite; -1 if there is none.
double first_time_not_finite(const TimeFunction& function, double duration, int samples = 400);

// What value and rate are counted as at least, where they are known to their rounding only.
struct LeastSizes {
  double value = 0.0, rate = 0.0;
};

// The first time at which value or rate jump, which no derivative at any one time shows; -1 where none is found. Looked for between
// `samples` even times: where a course is not what its derivative adds up to, halves are, unless it jumps.
double first_jump(const TimeFunction& function, double duration, int samples = 2000, const LeastSizes& least = {});

}  // namespace boresight
