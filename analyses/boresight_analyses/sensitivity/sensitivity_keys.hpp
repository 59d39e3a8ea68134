// What the [sensitivity] table of a study file may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& sensitivity_keys();

}  // namespace boresight
