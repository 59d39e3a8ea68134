// What the [budget] table of a study file may hold, and the posterior of a calibration that it may name.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& budget_keys();
const KeyTable& budget_requirement_keys();
const KeyTable& budget_contributor_keys();
const KeyTable& budget_part_keys();
const KeyTable& budget_correlation_keys();
const KeyTable& budget_frame_keys();
const KeyTable& posterior_keys();  // a file of its own

}  // namespace boresight
