#include "boresight/keys/mechanism_keys.hpp"

namespace boresight {
namespace {

// "XYX", "XYZ", ...: three axes, no two neighbours alike.
std::vector<std::string> conventions() {
  std::vector<std::string> all;
  for (char a = 'X'; a <= 'Z'; ++a)
    for (char b = 'X'; b <= 'Z'; ++b)
      for (char c = 'X'; c <= 'Z'; ++c)
        if (a != b && b != c) all.push_back({a, b, c});
  return all;
}

}  // namespace

const KeyTable& motion_keys() {
  using namespace keys;
  static const std::string pose = "with driven joints: body, angles and position, or drives";
  static const KeyTable table_of_keys{
      .name = "motion",
      .says =
          "The ideal motion: the pose of one body, from which the drives follow by inverse kinematics, or each drive's "
          "own law.",
      .keys = {
          quantity("duration", kDurationRange)
              .above(0.0, "a time above zero")
              .says("How long the motion lasts, from t = 0."),
          text("body").sometimes(pose).says("The body whose pose is prescribed."),
          table("angles", angles_keys).sometimes(pose).says("Orientation of the body over time."),
          table("position", position_keys).sometimes(pose).says("Position of the body's centre of mass over time."),
          table("drives", drives_keys).sometimes(pose).says("The law of every driven joint over time.")}};
  return table_of_keys;
}

const KeyTable& angles_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "motion.angles",
      .says =
          "R = R1(psi) R2(theta) R3(phi) turns the body from its home orientation, about the axes that the convention "
          "names.",
      .keys = {choice("convention", conventions())
                   .says("The axes of the three turns, such as \"ZYZ\": each is an axis of the body as turned so far."),
               expression("psi", kAngle).says("Angle of the first turn."),
               expression("theta", kAngle).says("Angle of the second turn; may use psi."),
               expression("phi", kAngle).says("Angle of the third turn; may use psi and theta.")}};
  return table_of_keys;
}

const KeyTable& position_keys() {
  using namespace keys;
  static const SiUnit own{"a length", "the unit that `unit` names", ""};
  static const KeyTable table_of_keys{
      .name = "motion.position",
      .says = "The body's centre of mass in world coordinates; the expressions may use psi, theta and phi.",
      .keys = {text("unit").says("Unit of length of the three expressions, such as \"mm\"."),
               expression("x", own).says("Coordinate along the world's x."),
               expression("y", own).says("Coordinate along the world's y."),
               expression("z", own).says("Coordinate along the world's z.")}};
  return table_of_keys;
}

const KeyTable& drives_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{.name = "motion.drives",
                                      .says = "One law for every driven joint, under the joint's name.",
                                      .keys = {expression("JOINT", {"", "rad (of a prismatic joint: m)", ""})
                                                   .sometimes("one for every driven joint")
                                                   .says("Angle or displacement of this joint from home over time.")},
                                      .any_name = true};
  return table_of_keys;
}

const KeyTable& initial_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "initial",
      .says = "How the motion starts at t = 0.",
      .keys = {table("rates", rates_keys)
                   .sometimes("left out, free joints start at rest")
                   .says("Starting rates of the joints that no drive moves."),
               choice("journals",
                      std::vector<KeyChoice>{
                          {"rest", "on their sleeves, in balance under the loads of t = 0, friction left out"},
                          {"centred", "in the middle of their sleeves, from where they fall"}})
                   .otherwise("rest")
                   .says("Where journals start; at the rates of the ideal motion either way.")}};
  return table_of_keys;
}

const KeyTable& freedom_rates_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{.name = "initial.rates.joint",
                                      .says = "Starting rates of the two freedoms of a cylindrical joint.",
                                      .keys = {quantity_of("FREEDOM", "the freedom, rad/s or m/s")
                                                   .sometimes("one of the two, or both")
                                                   .says("Rate of `angle` or of `displacement`.")},
                                      .any_name = true};
  return table_of_keys;
}

const KeyTable& rates_keys() {
  using namespace keys;
  static const KeyTable table_of_keys = [] {
    Key joint = quantity_of("JOINT", "the joint, rad/s or m/s")
                    .sometimes("of free joints only")
                    .says(
                        "Rate of a revolute joint's angle or a prismatic joint's displacement; of a cylindrical joint "
                        "\"JOINT.angle\" and \"JOINT.displacement\".");
    joint.inside = freedom_rates_keys;
    return KeyTable{.name = "initial.rates",
                    .says = "Starting rates of free joints, each under the joint's name.",
                    .keys = {joint},
                    .any_name = true};
  }();
  return table_of_keys;
}

const KeyTable& pointing_keys() {
  using namespace keys;
  static const std::string one = "target, or distance";
  static const KeyTable table_of_keys{
      .name = "pointing",
      .says =
          "A line of sight from a reference point, which moves with the boresight body, to a target that stands still.",
      .keys = {vector("target", kTargetRange).sometimes(one).says("The target in world coordinates."),
               quantity("distance", kTargetRange)
                   .above(0.0, "a length above zero")
                   .sometimes(one)
                   .says("Distance of the target from the reference point, along the boresight at home."),
               vector("from", kCoordinateRange)
                   .usually("the centre of mass of the boresight body")
                   .says("The reference point, at home in world coordinates.")}};
  return table_of_keys;
}

}  // namespace boresight
