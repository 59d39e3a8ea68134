// What is to be said of a key, in short: for help, schemas and the reference page alike.
#pragma once

#include <string>

#include "reference/sections.hpp"

namespace boresight::app {

// "must be there", "default 0.9", "default: that of coefficient", "needed of a revolute joint".
std::string presence_text(const Key& key);
// "length with its unit, "0.1 mm"; 1 pm to 10000 km, above 0; must be there".
std::string facts_text(const Key& key);
// "run, check": the verbs that read a section; "every verb that takes a mechanism".
std::string verbs_text(const Section& section, const Key* key = nullptr);

}  // namespace boresight::app
