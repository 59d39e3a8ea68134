// What the [match] table of a study file may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& match_keys();
const KeyTable& match_constraint_keys();

}  // namespace boresight
