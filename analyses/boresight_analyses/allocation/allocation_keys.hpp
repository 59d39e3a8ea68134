// What the [allocate] table of a study file may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& allocate_keys();
const KeyTable& allocate_joint_keys();
const KeyTable& allocate_error_keys();
const KeyTable& allocate_fit_keys();
const KeyTable& allocate_process_keys();
const KeyTable& allocate_error_process_keys();
const KeyTable& allocate_cost_keys();

}  // namespace boresight
