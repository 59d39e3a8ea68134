// What the table of a parameter that an optimisation may choose may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& design_variable_keys();

}  // namespace boresight
