// Where a mechanism with freedoms that nothing drives starts: its drives at their laws, its joints closed, and what joints leave free at
// home, at rest, unless the file gives a rate.
//
// Where a loop does not let every free coordinate q stay at home (a built mechanism's bodies do not quite fit; a drive does not begin at
// home), they depart from it as little as closes the joints, as the least of sum q^2, lengths over the mechanism's own; rates likewise.
// Neither hangs on masses, nor on which body is drawn how large: a joint is held where it is by itself, and not by what it carries.
#pragma once

#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

// All bodies at home, at rest.
IdealState home_state(const Mechanism& mechanism);

// laws: of the drives at t = 0. Throws ComputationError where the joints do not close, InputError where rates contradict each other.
IdealState starting_state(const Mechanism& mechanism, const std::vector<TimeValue>& laws);

}  // namespace boresight
