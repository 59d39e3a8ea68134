#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

SpringDescription read_spring(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(spring_keys());
  SpringDescription spring;
  spring.origin = cursor.origin();
  std::tie(spring.first, spring.second) = read_connects(cursor, so_far);
  const auto points = cursor.points("points");
  spring.first_point = points[0];
  spring.second_point = points[1];
  if ((points[1] - points[0]).stableNorm() < 1e-12) {
    cursor.fail_found("points", "the same point twice",
                      "two points apart: the spring acts along the line between them");
  }
  SpringParameters& p = spring.parameters;
  p.stiffness = cursor.quantity("stiffness");
  p.damping = cursor.quantity("damping");
  p.free_length = cursor.quantity("free_length");
  cursor.finish();
  return spring;
}

LoadDescription read_load(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(load_keys());
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
    load.point = cursor.vector("point");
    const auto texts = cursor.texts("force");
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
