// Plays that standing errors use up: what such an error displaces the parts by has to find room within the clearance where other joints hold
// the parts, or within all clearances together where redundant joints tie these (tied_room.hpp).
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// One sentence for each play that cannot move and in which these errors ask for more room than there is, to first order, and one for those
// that move together and are pressed wherever they rest. None where
// nothing is known of the errors (error_influence.hpp): what stands against that is said elsewhere.
std::vector<std::string> overrun_plays(const Mechanism& mechanism, const Parameters& parameters,
                                       const IdealMotion& commanded);

}  // namespace boresight
