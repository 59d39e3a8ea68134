// How fast the loads of a mechanism change: what no grid and no step may be longer than, since neither sees what begins and ends within it.
#pragma once

#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// The shortest time in which one of the loads changes by all that it ever does: its range over its largest rate [s]; of a sinusoid 2 / omega,
// of a bell 1.65 standard deviations. Infinite where no load changes by more than a millionth of what the bodies weigh, or of the
// largest load. Looked for at instants kLookedAt apart, or more of a motion that is longer than 1,048,576 of them, of 1000 s a millisecond: a
// blow that is over within one of these may not be seen.
double load_time(const Mechanism& mechanism);

// The same of the laws of drives' errors, one by one, along a commanded motion; infinite of those that are not `wanted` or do not change.
std::vector<double> error_times(const Mechanism& mechanism, const IdealMotion& commanded,
                                const std::vector<bool>& wanted);
// Of such a time, or the instants' distance that were looked at, where that is longer: what grids and steps answer to. These are 16,384 at most:
// grids have no more cells.
double least_error_time(const Mechanism& mechanism, double time);
// The shortest of them, so bounded.
double error_time(const Mechanism& mechanism, const IdealMotion& commanded, const std::vector<bool>& wanted);

inline constexpr double kLookedAt = 50e-6;  // [s], or a 1,024th of a shorter motion

// Of that time: what a grid of cubics takes of it at most to begin with, and what a step takes. A bell is then met at every 0.4 of its
// standard deviations, where cubics are off by 0.1 percent of its height.
inline constexpr double kCellOfLoads = 0.5, kStepOfLoads = 0.25;

}  // namespace boresight
