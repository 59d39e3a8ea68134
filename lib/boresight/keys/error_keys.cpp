#include "boresight/keys/mechanism_keys.hpp"

namespace boresight {

const KeyTable& error_keys() {
  using namespace keys;
  static const std::string one = "exactly one of translation, rotation, drive and expansion is given";
  static const std::string either = "\"towards JOINT\", or \"axis\" for the joint's own";
  static const KeyTable table_of_keys{
      .name = "error",
      .says =
          "A standing error of the built mechanism: one number, whose parameter path is error.NAME. The drives are "
          "told what the drawn mechanism needs; what the built one makes of that, less what was commanded, is the "
          "error that is computed.",
      .keys = {
          text("name").says("Its name; it may have dots in it (\"rod1.length\")."),
          text("joint")
              .sometimes("needed with translation and rotation")
              .says("The joint whose frame is not where the drawing has it. A bearing pair is the one joint that it is "
                    "drawn as: both its seats are displaced together; JOINT.floating is its floating bearing alone."),
          text("body")
              .sometimes("needed with translation, rotation and expansion")
              .says("The part that the error is in: one of the two that the joint connects, or the part that grows. "
                    "\"ground\" too."),
          direction("translation")
              .or_text(either)
              .sometimes(one)
              .says("The joint's frame is displaced in this direction of the world's axes at home; value is a length."),
          direction("rotation")
              .or_text(either)
              .sometimes(one)
              .says("The joint's frame is turned about this direction of the world's axes at home, through the joint's "
                    "point; value is an angle."),
          text("drive").sometimes(one).says("The driven joint that does not do what it is told."),
          expression("law", kRatio)
              .otherwise("1")
              .says("Of a drive: what value is multiplied by, an expression of t [s] and of the drive's coordinate q "
                    "(from home, m or rad). \"1\" is an offset, \"q\" an error of scale, \"sin(2*pi*q/0.005)\" the "
                    "ripple of a screw."),
          quantity("expansion", kExpansionRange)
              .sometimes(one)
              .says("The part grows: its joint frames move apart by this times value, a difference of temperatures, of "
                    "their distances; from its centre of mass, or on the ground from the middle of its joints. What "
                    "else is "
                    "fixed to it, springs and the place that it points from, stays where it is drawn."),
          value("value", "the error (a length, an angle or a difference of temperatures)")
              .usually("zero: the drawing itself")
              .says("How large the error is; studies scatter, sweep and allocate it. Of a drive it may be a number, of "
                    "m or rad. With a law in proportion to q it is a share, and may be written as one: \"250 ppm\", "
                    "\"0.025 %\", 2.5e-4; studies write it so too.")}};
  return table_of_keys;
}

}  // namespace boresight
