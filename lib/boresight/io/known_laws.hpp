// The names that `contact.law`, `contact.dissipation` and `friction.law` may have in a mechanism file.
#pragma once

#include <string>
#include <vector>

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline const std::vector<std::string>& contact_law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const NormalLawEntry& law : normal_laws()) result.push_back(law.name);
    return result;
  }();
  return names;
}

// Laws whose damping factor another may take: those of Hertz's geometry.
inline const std::vector<std::string>& dissipation_law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const NormalLawEntry& law : normal_laws())
      if (law.geometry == ContactGeometry::point) result.push_back(law.name);
    return result;
  }();
  return names;
}

inline const std::vector<std::string>& friction_law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const FrictionLawEntry& law : friction_laws()) result.push_back(law.name);
    return result;
  }();
  return names;
}

}  // namespace boresight
