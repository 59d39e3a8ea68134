// The ideal motion of any mechanism: by kinematics where everything is driven, else simulated without clearance from its
// starting rates, with the step halved until two runs agree to 1e-9 of the characteristic length.
#pragma once

#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

// How many freedoms of the mechanism without clearance nothing drives, at home.
int undriven_freedoms(const Mechanism& mechanism);

// Whether everything is driven, so that no parameter changes the ideal motion.
bool is_kinematic(const Mechanism& mechanism);

// Throws ComputationError where the motion cannot be followed.
IdealMotion ideal_motion(const Mechanism& mechanism, const Parameters& parameters);

}  // namespace boresight
