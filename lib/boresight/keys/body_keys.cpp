#include "boresight/keys/mechanism_keys.hpp"

namespace boresight {

const KeyTable& body_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "body",
      .says = "A rigid body, at home in world axes.",
      .keys = {
          text("name").says("Its name, by which joints and paths know it: body.NAME.mass."),
          quantity("mass", kMassRange).above(0.0, "a mass above zero").says("Its mass, without the payload."),
          vector("center_of_mass", kCoordinateRange).says("Its centre of mass at home, in world coordinates."),
          quantities("inertia", kInertiaRange)
              .named({"xx", "yy", "zz", "xy", "xz", "yz"})
              .of_length({3, 6}, "3 or 6 moments of inertia (xx yy zz xy xz yz)")
              .says("Its inertia about the centre of mass, along the body's axes: three principal moments, or the six "
                    "elements xx yy zz xy xz yz of the matrix with their signs."),
          table("axes", body_axes_keys)
              .sometimes("left out, the body's axes are the world's at home")
              .says("The body's axes at home, two or three of them."),
          direction("boresight")
              .sometimes("on exactly one body of the mechanism")
              .says("Where the mechanism points at home, in world axes; turns with the body.")}};
  return table_of_keys;
}

const KeyTable& body_axes_keys() {
  using namespace keys;
  static const std::string when = "two of the three, or all";
  static const KeyTable table_of_keys{.name = "body.axes",
                                      .says =
                                          "Axes of a body in world components: the first that is given is kept, the "
                                          "next made exactly perpendicular to it.",
                                      .keys = {direction("x").sometimes(when).says("The body's x axis at home."),
                                               direction("y").sometimes(when).says("The body's y axis at home."),
                                               direction("z").sometimes(when).says("The body's z axis at home.")}};
  return table_of_keys;
}

const KeyTable& payload_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "payload",
      .says = "A mass that one body carries, and that sweeps and studies vary: its inertia grows with it.",
      .keys = {text("body").says("The body that carries it."),
               quantity("mass", kMassRange).at_least(0.0, "a mass of zero or more").says("Its mass."),
               vector("center_of_mass", kCoordinateRange).says("Its centre of mass at home, in world coordinates."),
               quantities("gyration", kSizeRange)
                   .named({"x", "y", "z"})
                   .of_length({3}, "three radii of gyration such as \"141.42 mm\"")
                   .says("Its radii of gyration about the carrying body's axes: inertia = mass * gyration^2.")}};
  return table_of_keys;
}

}  // namespace boresight
