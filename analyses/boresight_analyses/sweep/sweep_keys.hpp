// What the [sweep] table of a study file may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& sweep_keys();
const KeyTable& sweep_axis_keys();

}  // namespace boresight
