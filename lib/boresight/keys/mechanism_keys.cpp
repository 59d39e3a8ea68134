#include "boresight/keys/mechanism_keys.hpp"

namespace boresight {

const KeyTable& mechanism_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "mechanism",
      .says =
          "A mechanism file: bodies, joints, motion and clearances, all given once in the home pose, in world axes.",
      .keys = {
          integer("format").between(1, 1, "1").says("The version of this format."),
          text("name").usually("the file's name").says("What reports call the mechanism."),
          vector("gravity", kGravityRange).says("Acceleration of gravity along the world's axes; all zero in orbit."),
          tables("body", body_keys).says("The moving parts, one table each; at least one."),
          table("payload", payload_keys)
              .sometimes("left out, nothing is carried")
              .says("What one of the bodies carries."),
          tables("pattern", pattern_keys)
              .sometimes("left out, nothing is repeated")
              .says("Parts that stand around an axis several times, as in CAD."),
          tables("joint", joint_keys)
              .sometimes("left out, all bodies are free")
              .says("What connects two bodies, one table each."),
          table("motion", motion_keys).says("How long the mechanism moves, and how its drives or one body move."),
          tables("clearance", clearance_keys)
              .sometimes("left out, all joints are ideal")
              .says("The joints with play, one table each."),
          table("initial", initial_keys)
              .sometimes("left out, free joints start at rest and journals on their sleeves")
              .says("How the motion starts."),
          tables("spring", spring_keys)
              .sometimes("left out, there are none")
              .says("Springs with dampers, one table each; their paths count from 1: spring.1.stiffness."),
          tables("load", load_keys)
              .sometimes("left out, only gravity acts")
              .says("Forces and torques that act from outside, one table each."),
          tables("error", error_keys)
              .sometimes("left out, the mechanism is built as it is drawn")
              .says("Standing errors of lengths, axes, drives and temperature, one table each."),
          table("pointing", pointing_keys)
              .sometimes("left out, there is no line-of-sight error")
              .says("The line of sight whose error is computed.")}};
  return table_of_keys;
}

const KeyTable& pattern_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "pattern",
      .says =
          "A circular pattern about an axis through the world's origin: what is inside is copied, {i} in its texts "
          "becomes the "
          "copy's number from 1, and copy i is turned by (i - 1) 360 / count degrees.",
      .keys = {
          integer("count").between(1, 360, "a number of copies from 1 to 360").says("How many copies there are."),
          choice("axis", {"x", "y", "z"}).says("The world's axis that the copies stand around."),
          tables("body", body_keys).sometimes("left out, none is copied").says("Bodies to be copied."),
          tables("joint", joint_keys).sometimes("left out, none is copied").says("Joints to be copied."),
          tables("clearance", clearance_keys).sometimes("left out, none is copied").says("Clearances to be copied."),
          tables("spring", spring_keys).sometimes("left out, none is copied").says("Springs to be copied."),
          tables("load", load_keys)
              .sometimes("left out, none is copied")
              .says("Loads to be copied; a force is turned with its body."),
          tables("error", error_keys)
              .sometimes("left out, none is copied")
              .says("Errors to be copied; a direction is turned with its joint.")}};
  return table_of_keys;
}

}  // namespace boresight
