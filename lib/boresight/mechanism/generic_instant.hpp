// A time at which a motion is looked at where no special instant may be hit.
#pragma once

namespace boresight {

// Rows that are independent along a motion may depend on each other at single instants, and those of the motions that people
// draw lie at simple fractions of the duration: the ends, a half, thirds, quarters, fifths, sixths, eighths, tenths. 0.37 is
// nearest to none of them (3/8 and 1/3 are 0.005 and 0.037 away) and lies in the first half, where a motion that stops early
// still moves. Only a comparison hangs on it: what holds here and there is taken to hold everywhere.
inline double generic_instant(double from, double to) { return from + 0.37 * (to - from); }

}  // namespace boresight
