// Vibrations that grow, and that a method's steps are too long to see grow.
//
// An A-stable method damps whatever is faster than its steps, also what the system itself amplifies: outside its region of stability lies
// only a bounded part of the right half plane (Hairer and Wanner 1996, section IV.3), so that at large h lambda a motion stays beside a
// course that it would leave: a journal slides quietly where friction makes it whirl. Finer tolerances that still step over the
// vibration agree with coarser ones, and say nothing of it. What the derivatives at hand say does.
#pragma once

#include "boresight/math/types.hpp"

namespace boresight {

struct GrowingVibration {
  double step;  // the longest that follows it [s]; infinite where nothing grows
  VecX shape;   // of the state in it, in its own units; empty where nothing grows
};

// The fastest vibration that grows noticeably within `rest` [s] under y' = jacobian y.
GrowingVibration growing_vibration(const MatX& jacobian, double rest);

}  // namespace boresight
