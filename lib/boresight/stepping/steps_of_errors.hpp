// What fixed steps make of the laws by which drives err: a ripple that goes on a whole number of times in half a step of RK4 is a constant
// to it, whatever accelerations it has.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// In which an error that acts changes by all that it does, bounded as grids are [s]: load_time.hpp. Infinite where none changes.
// times: error_times() of all errors.
double time_of_errors(const Mechanism& mechanism, const std::vector<double>& times, const Parameters& parameters);

// A sentence on the fastest error that acts, where it changes by all that it does within less than a step [s]; else empty.
std::string errors_not_followed(const Mechanism& mechanism, const std::vector<double>& times,
                                const Parameters& parameters, double step);

}  // namespace boresight
