#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/mechanism/description.hpp"

namespace boresight {

const KeyTable& joint_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "joint",
      .says = "An ideal joint between two bodies, given at home. A [[clearance]] gives it play.",
      .keys = {
          text("name").says("Its name, by which clearances, drives and loads know it."),
          choice("type",
                 std::vector<KeyChoice>{
                     {to_string(JointType::revolute), "turns about its axis"},
                     {to_string(JointType::prismatic), "slides along its axis"},
                     {to_string(JointType::cylindrical), "turns about its axis and slides along it"},
                     {to_string(JointType::universal), "turns about two perpendicular axes, one in each body"},
                     {to_string(JointType::spherical), "turns about its point in every way"},
                     {to_string(JointType::planar), "slides in the plane across its axis, and turns about the axis"},
                     {to_string(JointType::fixed), "holds everything"}})
              .says("What it leaves free."),
          texts("connects")
              .named({"first", "second"})
              .of_length({2}, "two names of bodies")
              .says(
                  "The two bodies, or \"ground\" and a body; its angle or displacement is that of the second seen from "
                  "the first."),
          vector("point", kCoordinateRange).says("A point of the joint at home, in world coordinates."),
          direction("axis")
              .sometimes("needed, but of a spherical or a fixed joint")
              .says("Its axis at home, in world axes; of a planar joint the normal of the plane, of a universal joint "
                    "the "
                    "axis fixed in the first body."),
          direction("second_axis")
              .sometimes("needed of a universal joint only")
              .says("A universal joint's axis fixed in the second body, perpendicular to the first one."),
          boolean("driven", false)
              .says(
                  "Whether a drive prescribes its angle (revolute) or displacement (prismatic); [motion] says how.")}};
  return table_of_keys;
}

}  // namespace boresight
