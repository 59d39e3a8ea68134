// What every study file may hold. The table of a verb stands beside that verb's reader.
#pragma once

#include <string>

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& study_keys();  // the file itself
const KeyTable& index_keys();

// Keys that the tables of several verbs have.
Key seed_key();
Key confidence_key(double otherwise);
// The path of a parameter, or a list of paths that take the same value.
Key parameter_key(const std::string& sentence);

}  // namespace boresight
