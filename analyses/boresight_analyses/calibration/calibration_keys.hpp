// What the [calibrate] table of a study file may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& calibrate_keys();
const KeyTable& calibrate_noise_keys();
const KeyTable& calibrate_discrepancy_keys();
const KeyTable& calibrate_posterior_keys();
const KeyTable& calibrate_parameter_keys();
const KeyTable& calibrate_run_keys();
const KeyTable& calibrate_candidate_keys();

}  // namespace boresight
