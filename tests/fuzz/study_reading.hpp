// What a user's study and data files go through before anything is computed, and what must hold of everything that is let through,
// checked independently of the readers.
#pragma once

#include <string>
#include <string_view>

namespace boresight {

// Reads a study on the crank-slider, and the plan of every verb whose table it has. The first thing that is wrong with what was read, in
// words; "" if nothing is. Throws InputError.
std::string fault_of_study(std::string_view text, const std::string& folder);

// Reads a table of measured pointing data. The same; throws InputError.
std::string fault_of_data(const std::string& file);

}  // namespace boresight
