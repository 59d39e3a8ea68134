#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/mechanism/description.hpp"

namespace boresight {
namespace {

// Laws by their names, with source and formula.
template <typename Laws>
std::vector<KeyChoice> cited(const Laws& laws) {
  std::vector<KeyChoice> choices;
  for (const auto& law : laws) choices.push_back({law.name, std::string(law.source) + ": " + law.formula});
  return choices;
}

std::vector<KeyChoice> cited_dissipations() {
  std::vector<KeyChoice> choices;
  for (const NormalLawEntry& law : normal_laws())
    if (law.geometry == ContactGeometry::point)
      choices.push_back({law.name, std::string(law.source) + ": " + law.formula});
  return choices;
}

}  // namespace

const KeyTable& clearance_keys() {
  using namespace keys;
  static const char* kOfGuide = "needed of a rectangular guide, and of no other";
  static const char* kOfRectangle = "needed of a rectangular guide and of a rectangular pad, and of no other";
  static const KeyTable table_of_keys{
      .name = "clearance",
      .says =
          "Play of a joint: of a revolute, cylindrical or prismatic one a journal, carried by one body, in a sleeve, "
          "carried by the other; of a spherical one a ball in its socket; of a planar one a pad in the slot between "
          "two faces; of a prismatic one with a rectangular guide the slider in it.",
      .keys = with_two_bearings(
          {text("joint").says("The joint that has play; its paths are clearance.JOINT.radial and so on."),
           text("journal")
               .sometimes("needed but of a universal joint, whose cross carries the journals")
               .says("Which of the joint's bodies carries the journal, the ball, the pad or the slider; the other one "
                     "carries the sleeve, socket, slot or guide."),
           choice("guide", std::vector<KeyChoice>{{"round", "a journal in a sleeve, held against turning by a key"},
                                                  {"rectangular", "a slider between two pairs of faces"}})
               .otherwise("round")
               .says("Of a prismatic joint: the shape of its guide."),
           quantity("radial", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes("needed but of a planar joint and of a rectangular guide")
               .says("Radial clearance: the sleeve's radius less the journal's, half the difference of the "
                     "diameters; of a ball "
                     "likewise."),
           quantity("axial", kSizeRange)
               .at_least(0.0, "a length of zero or more")
               .sometimes(
                   "needed of a revolute or planar joint; a cylindrical or prismatic one slides through its sleeve and "
                   "has none, nor has a ball")
               .says("Axial clearance on each side, between end face and cap; of a pad, the gap between it and each "
                     "face."),
           quantity("journal_radius", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes("needed but of a planar joint and of a rectangular guide")
               .says("Radius of the journal, or of the ball."),
           quantity("cap_radius", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes("needed of a revolute joint")
               .says("Radius of the caps that hold the journal along its axis; more than the sleeve's radius."),
           quantity("sleeve_length", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes("needed of a revolute joint, of a journal that tilts and of laws for cylinders")
               .says("Length of the sleeve; its end faces lie at half of it on both sides of the joint's point."),
           quantity("pad_radius", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes("needed of a planar joint whose pad is not rectangular, and of no other")
               .says("Radius of the round pad between the faces. Such a pad that tilts bears on its rim, and turns "
                     "about it "
                     "where it lifts off."),
           quantity("width_gap", kSizeRange)
               .at_least(0.0, "a length of zero or more")
               .sometimes(kOfGuide)
               .says("Gap between slider and guide on each side, along the width."),
           quantity("height_gap", kSizeRange)
               .at_least(0.0, "a length of zero or more")
               .sometimes(kOfGuide)
               .says("Gap between slider and guide on each side, along the height."),
           quantity("width", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes(kOfRectangle)
               .says(
                   "The slider's size along width_direction, or that of a rectangular pad, which bears on its corners "
                   "and turns with its joint."),
           quantity("height", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes(kOfGuide)
               .says("The slider's size across its width and the joint's axis."),
           quantity("length", kSizeRange)
               .above(0.0, "a length above zero")
               .sometimes(kOfRectangle)
               .says("Of a rectangular pad, its size across width_direction. The slider's size along the joint's axis; "
                     "the joint's point is in its middle, and the guide is "
                     "as long "
                     "as it goes. A slider that tilts touches with the edges at its ends."),
           direction("width_direction")
               .sometimes(kOfRectangle)
               .says("Direction of the width at home, in world axes, across the joint's axis."),
           choice("axes", std::vector<KeyChoice>{{"parallel", "the journal stays parallel to the sleeve"},
                                                 {"free", "the journal may tilt in the sleeve"}})
               .usually("\"parallel\"; of a bearing pair \"free\"")
               .says("Whether the journal may tilt in its sleeve, or the pad in its slot."),
           table("contact", contact_keys)
               .sometimes("left out, all its defaults hold")
               .says("Normal force of the contact: law, material, restitution."),
           table("friction", friction_keys)
               .sometimes("left out, all its defaults hold: no friction")
               .says("Friction of the contact.")})};
  return table_of_keys;
}

const KeyTable& contact_keys() {
  using namespace keys;
  static const ContactParameters p;
  static const ClearanceDescription c;
  static const std::string of_kelvin_voigt = "of the law \"kelvin-voigt\" only";
  static const KeyTable table_of_keys{
      .name = "clearance.contact",
      .says = "The normal force between journal and sleeve; `boresight laws MECHANISM` compares the laws.",
      .keys = {
          choice("law", cited(normal_laws()))
              .otherwise(c.contact_law.c_str())
              .says(
                  "Law of the normal force over penetration d and its rate. The first laws share Hertz's force K d^1.5 "
                  "(1 + h d' / v0) and differ in the damping factor h, which the restitution e decides."),
          choice("dissipation", cited_dissipations())
              .sometimes("with a law for cylinders: johnson, ...; left out, the law's own")
              .says("The law whose damping factor h a law for cylinders takes."),
          number("restitution")
              .otherwise(p.restitution)
              .between(0.0, 1.0, "a number from 0 to 1")
              .says("Coefficient of restitution e: speed after an impact over speed before it. Not of a journal's end "
                    "faces: these are "
                    "springs without losses (Sun et al., Eq. 32), which give back all of it."),
          quantities("young", kYoungRange)
              .named({"journal", "sleeve"})
              .of_length({2}, "two values: journal, sleeve")
              .above(0.0, "elastic moduli above zero")
              .otherwise(std::vector<double>(p.young.begin(), p.young.end()), "GPa")
              .says("Young's moduli of journal and sleeve; the default is aluminium."),
          numbers("poisson")
              .named({"journal", "sleeve"})
              .of_length({2}, "two values: journal, sleeve")
              .bounded({.least = 0.0, .most = 0.5, .below = true, .expected = "numbers of at least 0, below 0.5"})
              .otherwise(std::vector<double>(p.poisson.begin(), p.poisson.end()))
              .says("Poisson's ratios of journal and sleeve."),
          quantity("density", kDensityRange)
              .above(0.0, "a density above zero")
              .otherwise(p.density)
              .says("Density of the material; it decides only up to which impact speed the law is said to hold."),
          quantity("minimum_impact_speed", kContactSpeedRange)
              .above(0.0, "a speed above zero")
              .otherwise(p.minimum_impact_speed, "mm/s")
              .says("Least impact speed v0 that the damping is computed with; slower impacts are damped as this one."),
          number("stiffness_scale")
              .above(0.0, "a number above zero")
              .between(kStiffnessScaleRange[0], kStiffnessScaleRange[1], "a number from 1e-6 to 1e6")
              .otherwise(p.stiffness_scale)
              .says("Factor on the stiffness K of the law; `calibrate` fits it to measured data."),
          quantity("stiffness", kStiffnessRange)
              .above(0.0, "a stiffness above zero")
              .sometimes("needed " + of_kelvin_voigt)
              .says("Stiffness K of the Kelvin-Voigt law F = K d + D d'."),
          quantity("damping", kDampingRange)
              .at_least(0.0, "a damping of zero or more")
              .otherwise(p.linear_damping)
              .says("Damping D of the Kelvin-Voigt law F = K d + D d'; " + of_kelvin_voigt + ".")}};
  return table_of_keys;
}

const KeyTable& friction_keys() {
  using namespace keys;
  static const FrictionParameters p;
  static const ClearanceDescription c;
  static const std::string peaked = "of the laws with a static peak: bengisu-akay, brown-mcphee, lugre";
  static const std::string lugre = "of the law \"lugre\" (Canudas de Wit and others 1995)";
  static const KeyTable table_of_keys{
      .name = "clearance.friction",
      .says = "The friction force over the normal force, as a function of the sliding speed v.",
      .keys = {
          choice("law", cited(friction_laws())).otherwise(c.friction_law.c_str()).says("The law of friction."),
          number("coefficient")
              .at_least(0.0, "a number of zero or more")
              .at_most(kLargestFrictionCoefficient, "a number from 0 to 100")
              .otherwise(p.coefficient)
              .says("Kinetic coefficient of friction mu; zero is no friction."),
          quantity("static_speed", kContactSpeedRange)
              .at_least(0.0, "a speed of zero or more")
              .otherwise(p.static_speed, "mm/s")
              .says("Sliding speed v_s below which modified Coulomb friction is zero (Ambrosio 2002)."),
          quantity("dynamic_speed", kContactSpeedRange)
              .otherwise(p.dynamic_speed, "mm/s")
              .says("Sliding speed v_d from which friction is fully developed, and beyond which LuGre's bristles are "
                    "not damped; "
                    "more than static_speed."),
          number("static_coefficient")
              .at_most(kLargestFrictionCoefficient, "a number of at most 100")
              .usually("that of coefficient")
              .says("Static coefficient of friction mu_s, at least the kinetic one; " + peaked + "."),
          quantity("stribeck_speed", kContactSpeedRange)
              .above(0.0, "a speed above zero")
              .otherwise(p.stribeck_speed, "mm/s")
              .says("Stribeck speed v_st, over which friction falls from its static peak to the kinetic value; " +
                    peaked + "."),
          quantity("bristle_stiffness", kBristleStiffnessRange)
              .above(0.0, "a stiffness per normal force above zero")
              .otherwise(p.bristle_stiffness)
              .says("Stiffness s0 of the bristles per normal force, " + lugre + "."),
          quantity("bristle_damping", kBristleDampingRange)
              .at_least(0.0, "a damping of zero or more")
              .otherwise(p.bristle_damping)
              .says("Damping s1 of the bristles per normal force, which dies out beyond dynamic_speed, " + lugre + "."),
          quantity("viscosity", kBristleDampingRange)
              .at_least(0.0, "a viscosity of zero or more")
              .otherwise(p.viscosity)
              .says("Viscous friction s2 per normal force, " + lugre + ".")}};
  return table_of_keys;
}

}  // namespace boresight
