#include "boresight/io/mechanism_sections.hpp"
#include "boresight/io/physical_ranges.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

SpringDescription read_spring(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only({"connects", "points", "stiffness", "damping", "free_length"});
  SpringDescription spring;
  spring.origin = cursor.origin();
  std::tie(spring.first, spring.second) = read_connects(cursor, so_far);
  const auto points = points_in(cursor, "points", 2);
  spring.first_point = points[0];
  spring.second_point = points[1];
  if ((points[1] - points[0]).stableNorm() < 1e-12) {
    cursor.fail_found("points", "the same point twice",
                      "two points apart: the spring acts along the line between them");
  }
  SpringParameters& p = spring.parameters;
  p.stiffness = quantity_in(cursor, "stiffness", kStiffnessRange);
  cursor.require(p.stiffness >= 0.0, "stiffness", "a stiffness of zero or more");
  p.damping = quantity_in(cursor, "damping", kDampingRange, 0.0);
  cursor.require(p.damping >= 0.0, "damping", "a damping of zero or more");
  p.free_length = quantity_in(cursor, "free_length", kSizeRange);
  cursor.require(p.free_length >= 0.0, "free_length", "a length of zero or more");
  cursor.finish();
  return spring;
}

LoadDescription read_load(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only({"joint", "torque", "force", "body", "point"});
  const double duration = so_far.motion.duration;
  LoadDescription load;
  load.origin = cursor.origin();
  if (cursor.has("joint")) {
    load.joint = joint_index(so_far, cursor, "joint", cursor.text("joint"));
    const JointDescription& joint = so_far.joints[*load.joint];
    if (joint.type == JointType::revolute) {
      load.along_joint = read_expression(cursor, "torque", duration);
    } else if (joint.type == JointType::prismatic) {
      load.along_joint = read_expression(cursor, "force", duration);
    } else {
      cursor.fail_found("joint", in_quotes(joint.name) + ", a " + to_string(joint.type) + " joint",
                        "a revolute or prismatic joint");
    }
  } else {
    if (!cursor.has("body"))
      cursor.fail_found("body", "neither joint nor body", "the joint or the body that the load acts on");
    load.body = body_index(so_far, cursor, "body", cursor.text("body"), false);
    load.point = vector_in(cursor, "point", kCoordinateRange);
    const auto texts = cursor.texts("force", {"x", "y", "z"});
    cursor.require(texts.size() == 3, "force", "three expressions of t [N], along the world's x, y, z");
    std::array<TimeFunctionPtr, 3> force;
    for (int k = 0; k < 3; ++k) force[k] = compile_expression(cursor, "force", texts[k], duration);
    load.force = force;
    if (!cursor.turn().isIdentity(0.0)) {  // a pattern's copy: the force is turned with its body
      for (int row = 0; row < 3; ++row) {
        std::vector<std::pair<double, TimeFunctionPtr>> parts;
        for (int k = 0; k < 3; ++k) {
          if (cursor.turn()(row, k) != 0.0) parts.emplace_back(cursor.turn()(row, k), force[k]);
        }
        load.force[row] = combination(std::move(parts));
      }
    }
  }
  cursor.finish();
  return load;
}

}  // namespace boresight
