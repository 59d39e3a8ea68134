// Plays that other joints hold, and that standing errors use up: what such an error displaces the parts by has to find room within the
// clearance, as nothing gives way.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// One sentence for each play that cannot move and in which these errors ask for more room than there is, to first order. None where
// nothing is known of the errors (error_influence.hpp): what stands against that is said elsewhere.
std::vector<std::string> overrun_plays(const Mechanism& mechanism, const Parameters& parameters,
                                       const IdealMotion& commanded);

}  // namespace boresight
