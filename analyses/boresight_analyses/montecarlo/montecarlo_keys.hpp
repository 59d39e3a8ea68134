// What the [montecarlo] table of a study file may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& montecarlo_keys();
const KeyTable& requirement_keys();  // of [allocate] too
const KeyTable& stop_keys();
const KeyTable& fidelities_keys();
const KeyTable& tail_keys();

}  // namespace boresight
