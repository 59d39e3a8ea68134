// A motion that a period drives, seen once a period: its states, its section, and how many points that
// section has.
//
// A section of one point is a motion of the drive's own period, of m points one of m periods, of a curve a
// quasi-periodic one; a cloud is what chaos leaves.
#pragma once

#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

// States at even spacing, one per column; whole samples make a period.
struct StateSeries {
  double spacing = 0.0;  // [s]
  int per_period = 1;    // samples a period
  MatX states;
};

// States once a period, from the first sample on that `skip` periods leave.
MatX poincare_section(const StateSeries& series, int skip);

// After how many periods the section comes back to itself: the fewest m, up to `most`, with the points m
// apart closer than `share` of the section's own size in every direction; 0 where there is none, or fewer
// than four repetitions to see it in. size: per state, what counts as large (the range of the whole motion).
int section_period(const MatX& section, const VecX& size, double share = 0.02, int most = 16);

}  // namespace boresight
