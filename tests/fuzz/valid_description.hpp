// Everything that must hold of a description that the reader lets through, checked independently of the reader.
#pragma once

#include <string>

#include "boresight/mechanism/description.hpp"

namespace boresight {

// The first thing that is wrong, in words; "" if nothing is.
std::string fault_of(const MechanismDescription& mechanism);

}  // namespace boresight
