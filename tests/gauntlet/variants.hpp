// The same mechanism drawn otherwise: nothing that it does may change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "boresight/mechanism/description.hpp"

namespace boresight::gauntlet {

// "moved", "turned", "renamed", "reordered", "turned about".
const std::vector<std::string>& variant_names();

// Nothing where it cannot be said: a prescribed pose names world axes, so it can be moved but not turned.
std::optional<MechanismDescription> variant(const MechanismDescription& mechanism, const std::string& name);

// A mechanism file's text with the same values in other units: mm for m, us for s, g for kg, deg for rad, ...
std::string in_other_units(const std::string& toml);

}  // namespace boresight::gauntlet
