// What a mechanism file leaves out of its clearances although results hang on it, and what is taken in its place.
//
// A file may leave out a contact's material, its restitution, its friction and whether the journal tilts. It is then computed with
// values that may have nothing to do with the joint at hand, so they are named wherever results are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "boresight/io/document.hpp"

namespace boresight {

struct AssumedValue {
  std::string joint;  // "F1"
  std::string key;    // within the clearance: "contact.young"
  std::string value;  // as it would stand in the file
};

// In the order of the file. Throws what read_mechanism throws.
std::vector<AssumedValue> assumed_values(const std::string& path, const std::vector<Setting>& settings = {});
std::vector<AssumedValue> assumed_values_of_text(std::string_view text, const std::string& filename,
                                                 const std::vector<Setting>& settings = {});

// A sentence for all joints that lack the same: "F1, F2: not given, so assumed: contact.young = 72 GPa (aluminium), ...".
std::vector<std::string> in_words(const std::vector<AssumedValue>& assumed);

}  // namespace boresight
