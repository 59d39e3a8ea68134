// What a mechanism file may hold: one table of keys a section; its reader is in `io`.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& mechanism_keys();  // the file itself
const KeyTable& body_keys();
const KeyTable& payload_keys();
const KeyTable& pattern_keys();
const KeyTable& joint_keys();
const KeyTable& clearance_keys();
// bearing_keys.cpp: the keys of a clearance and those by which it stands for two bearings, the names of the latter, and what one of a pair
// has of its own.
std::vector<Key> with_two_bearings(std::vector<Key> keys_of_one);
std::vector<std::string> two_bearing_keys();
const KeyTable& floating_bearing_keys();
const KeyTable& contact_keys();
const KeyTable& friction_keys();
const KeyTable& motion_keys();
const KeyTable& angles_keys();
const KeyTable& position_keys();
const KeyTable& drives_keys();
const KeyTable& initial_keys();
const KeyTable& rates_keys();
const KeyTable& freedom_rates_keys();  // of one joint
const KeyTable& spring_keys();
const KeyTable& load_keys();
const KeyTable& error_keys();
const KeyTable& pointing_keys();
const KeyTable& body_axes_keys();

}  // namespace boresight
