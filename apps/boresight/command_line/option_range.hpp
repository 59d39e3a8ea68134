// An option's value with its unit, within a range. Throws InputError naming the option.
#pragma once

#include <string>

#include "boresight/keys/physical_ranges.hpp"

namespace boresight::app {

double quantity_between(const std::string& option, const std::string& text, const PhysicalRange& range);

}  // namespace boresight::app
