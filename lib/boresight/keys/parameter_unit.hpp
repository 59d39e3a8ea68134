// What the values of a parameter are written in, by studies as by the mechanism's file.
#pragma once

#include <string>
#include <vector>

#include "boresight/keys/units.hpp"
#include "boresight/mechanism/parameter_path.hpp"

namespace boresight {

// Whether all of them are scales of drives.
inline bool are_scales(const MechanismDescription& mechanism, const std::vector<std::string>& paths) {
  bool scales = !paths.empty();
  for (const std::string& path : paths) scales = scales && names_scales(mechanism, path);
  return scales;
}

// paths: parameters that take the same values, in si_unit. The result may point into si_unit.
inline SiUnit unit_of_parameters(const MechanismDescription& mechanism, const std::vector<std::string>& paths,
                                 const std::string& si_unit) {
  return unit_called(si_unit, are_scales(mechanism, paths));
}
SiUnit unit_of_parameters(const MechanismDescription&, const std::vector<std::string>&, std::string&&) = delete;

// In which unit people are told their values: as `written`; a scale written as a plain number, or not at all, in ppm and not in the unit of
// its drive, in which it is computed. "": as people read the SI unit.
inline std::string unit_to_say(const MechanismDescription& mechanism, const std::vector<std::string>& paths,
                               const std::string& written) {
  return written.empty() && are_scales(mechanism, paths) ? "ppm" : written;
}

}  // namespace boresight
