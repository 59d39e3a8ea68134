#include <cmath>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

const JointType kTypes[] = {JointType::revolute,  JointType::prismatic, JointType::cylindrical, JointType::universal,
                            JointType::spherical, JointType::planar,    JointType::fixed};

JointType read_type(Cursor& cursor) {
  const std::string word = cursor.choice("type");
  for (const JointType type : kTypes) {
    if (word == to_string(type)) return type;
  }
  return JointType::fixed;
}

// A universal joint's two axes are perpendicular in every pose; the second is turned to be exactly so.
Vec3 read_second_axis(Cursor& cursor, const Vec3& axis) {
  const Vec3 second = cursor.direction("second_axis");
  const double skew = axis.dot(second);
  if (std::abs(skew) > 1e-3) {
    cursor.fail_found("second_axis", "a direction that is not perpendicular to axis", "perpendicular axes");
  }
  return (second - skew * axis).normalized();
}

}  // namespace

JointDescription read_joint(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(joint_keys());
  JointDescription joint;
  joint.origin = cursor.origin();
  joint.name = read_name(cursor, "name");
  for (const JointDescription& other : so_far.joints) {
    if (other.name == joint.name) {
      cursor.fail_found(
          "name", in_quotes(joint.name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
          "a name of its own");
    }
  }
  cursor.rename("joint." + joint.name);
  joint.type = read_type(cursor);
  std::tie(joint.first, joint.second) = read_connects(cursor, so_far);
  joint.point = cursor.vector("point");
  const bool has_axis = joint.type != JointType::spherical && joint.type != JointType::fixed;
  if (has_axis) joint.axis = cursor.direction("axis");
  if (joint.type == JointType::universal) joint.second_axis = read_second_axis(cursor, joint.axis);
  joint.driven = cursor.boolean("driven");
  if (joint.driven && joint.type != JointType::revolute && joint.type != JointType::prismatic) {
    cursor.fail_found("driven", std::string("a driven ") + to_string(joint.type) + " joint",
                      "a drive on a revolute or prismatic joint");
  }
  if (!has_axis && cursor.has("axis"))
    cursor.fail_found(
        "axis", std::string("an axis on a ") + to_string(joint.type) + " joint",
        joint.type == JointType::spherical ? "no axis: it turns about every one" : "no axis: it does not turn");
  if (joint.type != JointType::universal && cursor.has("second_axis"))
    cursor.fail_found("second_axis", std::string("a second axis on a ") + to_string(joint.type) + " joint",
                      "it only on a universal joint");
  cursor.finish();
  return joint;
}

}  // namespace boresight
