// What the values of a parameter are written in, by studies as by the mechanism's file.
#pragma once

#include <string>
#include <vector>

#include "boresight/keys/units.hpp"
#include "boresight/mechanism/parameter_path.hpp"

namespace boresight {

// paths: parameters that take the same values, in si_unit. The result may point into si_unit.
inline SiUnit unit_of_parameters(const MechanismDescription& mechanism, const std::vector<std::string>& paths,
                                 const std::string& si_unit) {
  bool scales = !paths.empty();
  for (const std::string& path : paths) scales = scales && names_scales(mechanism, path);
  return unit_called(si_unit, scales);
}
SiUnit unit_of_parameters(const MechanismDescription&, const std::vector<std::string>&, std::string&&) = delete;

}  // namespace boresight
