// Which paths name a number of a contact: what the tables of a scene do not hold, and what exact slopes are by.
#pragma once

#include <string>

namespace boresight {

// A bearing's preload stands among the numbers of its clearance, and is a spring's.
inline bool is_contact_path(const std::string& path) {
  return path.starts_with("clearance.") && !path.ends_with(".preload");
}

}  // namespace boresight
