#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/mechanism/parameters.hpp"

namespace boresight {

const KeyTable& spring_keys() {
  using namespace keys;
  static const SpringParameters p;
  static const KeyTable table_of_keys{
      .name = "spring",
      .says = "A spring and a damper along the line between two points.",
      .keys = {texts("connects")
                   .named({"first", "second"})
                   .of_length({2}, "two names of bodies")
                   .says("The two bodies, or \"ground\" and a body, that it acts between."),
               points("points", 2, kCoordinateRange)
                   .says("Where it is fixed on the first and on the second body, at home in world coordinates."),
               quantity("stiffness", kStiffnessRange)
                   .at_least(0.0, "a stiffness of zero or more")
                   .says("Force over lengthening."),
               quantity("damping", kDampingRange)
                   .at_least(0.0, "a damping of zero or more")
                   .otherwise(p.damping)
                   .says("Force over speed of lengthening."),
               quantity("free_length", kSizeRange)
                   .at_least(0.0, "a length of zero or more")
                   .says("Length at which the spring has no force.")}};
  return table_of_keys;
}

const KeyTable& load_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "load",
      .says =
          "A load from outside: a torque about a revolute joint, a force along a prismatic one, or a force at a point "
          "of a body. A blow that is over within 50 us, or within a millionth of a long motion, may not be seen.",
      .keys = {text("joint")
                   .sometimes("this, or body")
                   .says("The revolute or prismatic joint that it acts on: on its second body, and back on its first."),
               expression("torque", kTorque).sometimes("of a revolute joint").says("Torque about the joint's axis."),
               expressions("force", kForce)
                   .named({"x", "y", "z"})
                   .of_length({3}, "three expressions of t [N], along the world's x, y, z")
                   .or_single()
                   .sometimes("of a prismatic joint, or of a body")
                   .says("Of a prismatic joint: one expression, the force along its axis. Of a body: three, the force "
                         "along the "
                         "world's x, y, z."),
               text("body").sometimes("this, or joint").says("The body that a force acts on."),
               vector("point", kCoordinateRange)
                   .sometimes("needed with body")
                   .says("The point of the body where the force acts, at home in world coordinates.")}};
  return table_of_keys;
}

}  // namespace boresight
