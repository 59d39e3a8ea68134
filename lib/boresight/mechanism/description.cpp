#include "boresight/mechanism/description.hpp"

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

}  // namespace boresight
