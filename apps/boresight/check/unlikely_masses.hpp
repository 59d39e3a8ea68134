// Moments of inertia that do not go with the size of what they are of: numbers of another unit, mostly.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight::app {

// One sentence for each body whose radius of gyration is tens of times the mechanism's size, or hundreds of times less than the
// distances from its centre of mass to its joints.
std::vector<std::string> unlikely_inertias(const Mechanism& mechanism);

}  // namespace boresight::app
