// What an option's value may be. All throw InputError naming the option.
#pragma once

#include <cstdint>
#include <string>

#include "boresight/keys/physical_ranges.hpp"
#include "boresight/mechanism/description.hpp"

namespace boresight::app {

// Where an error in an option is reported.
inline const Origin kCommandLine{"command line", 0};

// With its unit, within a range.
double quantity_between(const std::string& option, const std::string& text, const PhysicalRange& range);

// From least to most.
std::uint64_t whole_number(const std::string& option, const std::string& text, std::uint64_t least, std::uint64_t most);

}  // namespace boresight::app
