// The envelope rung: the worst case over the clearance volume, pose error = E(t) xi with each joint's xi anywhere in its
// gap, reached out by its static deflection. An upper bound of continuous contact; impacts may overshoot it.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

std::unique_ptr<Rung> make_envelope(std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
