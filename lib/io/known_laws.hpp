// The names that `contact.law` and `friction.law` may have in a mechanism file.
#pragma once

#include <string>
#include <vector>

namespace boresight {

inline const std::vector<std::string>& contact_law_names() {
  static const std::vector<std::string> names = {"flores"};
  return names;
}

inline const std::vector<std::string>& friction_law_names() {
  static const std::vector<std::string> names = {"none", "modified-coulomb"};
  return names;
}

}  // namespace boresight
