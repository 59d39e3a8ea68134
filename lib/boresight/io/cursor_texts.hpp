// How the cursor names values and what it expects of them. Internal to this room.
#pragma once

#include <string>
#include <vector>

#include "boresight/keys/units.hpp"

namespace boresight::cursor {

inline std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

inline std::string element_path(const std::string& path, const std::vector<std::string>& names, std::size_t k) {
  return joined(path, k < names.size() ? names[k] : std::to_string(k + 1));
}

// unit null: a pure number.
inline std::string expected_value(const SiUnit* unit) { return unit != nullptr ? expectation(*unit) : "a number"; }

}  // namespace boresight::cursor
