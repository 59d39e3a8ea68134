// What the spectrum of a contributor, its measured course and its transfer functions may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& spectrum_keys();
const KeyTable& spectrum_table_keys();
const KeyTable& measured_keys();
const KeyTable& through_keys();

}  // namespace boresight
