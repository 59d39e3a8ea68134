// Which paths name a number of a contact: what the tables of a scene do not hold, and what exact slopes are by.
#pragma once

#include <string>

namespace boresight {

// A bearing's preload stands among the numbers of its clearance, and is a spring's.
inline bool is_contact_path(const std::string& path) {
  return path.starts_with("clearance.") && !path.ends_with(".preload");
}

// The least impact speed is in force where contacts last, and no derivative of it is carried along.
inline bool has_exact_slope(const std::string& path) {
  return is_contact_path(path) && !path.ends_with(".minimum_impact_speed");
}

}  // namespace boresight
