#include "boresight/mechanism/description.hpp"

#include <cmath>

namespace boresight {

const char* to_string(JointType type) {
  switch (type) {
    case JointType::revolute:
      return "revolute";
    case JointType::prismatic:
      return "prismatic";
    case JointType::cylindrical:
      return "cylindrical";
    case JointType::universal:
      return "universal";
    case JointType::spherical:
      return "spherical";
    case JointType::planar:
      return "planar";
    case JointType::fixed:
      return "fixed";
  }
  return "unknown";
}

const char* unit_of(const ErrorDescription& error, const std::vector<JointDescription>& joints) {
  switch (error.kind) {
    case ErrorDescription::Kind::translation:
      return "m";
    case ErrorDescription::Kind::rotation:
      return "rad";
    case ErrorDescription::Kind::drive:
      return joints[error.joint].type == JointType::prismatic ? "m" : "rad";
    case ErrorDescription::Kind::expansion:
      return "K";
  }
  return "1";
}

bool is_scale(const ErrorDescription& error) {
  if (error.kind != ErrorDescription::Kind::drive || !error.law) return false;
  bool moves = false;
  // At uneven places, so that no ripple passes for it.
  for (const double t : {0.0, 0.317, 2.71}) {
    const double slope = error.law->at({1.0, 0.0, 0.0}, t).value;
    moves = moves || slope != 0.0;
    for (const double q : {-1.7321, -0.3, 0.0, 0.2236, 2.236, 11.3})
      if (!(std::abs(error.law->at({q, 0.0, 0.0}, t).value - slope * q) <= 1e-9 * std::abs(slope * q))) return false;
  }
  return moves;
}

const char* said_unit_of(const ErrorDescription& error, const std::vector<JointDescription>& joints) {
  return is_scale(error) ? "1" : unit_of(error, joints);
}

}  // namespace boresight
