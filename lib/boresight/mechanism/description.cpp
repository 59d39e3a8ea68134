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

}  // namespace boresight
