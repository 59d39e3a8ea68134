// Keys of a [[clearance]] that stands for two bearings: a pair on one shaft, the cross of a universal joint.
#include "boresight/keys/mechanism_keys.hpp"

namespace boresight {
namespace {

using namespace keys;

constexpr PhysicalRange kPreloadRange{kForce, "1e-9 N", "1e12 N"};
const std::string kOfPair = "of a bearing pair";
const std::string kOfUniversal = "of a universal joint";

std::vector<Key> own_keys() {
  return {
      choice("bearing", std::vector<KeyChoice>{{"single", "one bearing, at the joint's point"},
                                               {"pair",
                                                "two bearings on one shaft: a fixed one, and a floating one that "
                                                "slides along the axis"}})
          .otherwise("single")
          .says("Whether a revolute joint is one bearing or a pair. The floating bearing of a pair is a cylindrical "
                "joint "
                "JOINT.floating, with the paths clearance.JOINT.floating.radial and so on; the fixed one keeps the "
                "joint's name, its drive and the axial play."),
      quantity("span", kSizeRange)
          .above(0.0, "a length above zero")
          .sometimes("needed " + kOfPair)
          .says("Distance of the two bearings' centres along the axis; the joint's point is in the middle."),
      choice("fixed_end",
             std::vector<KeyChoice>{{"start", "half a span against the axis"}, {"end", "half a span along the axis"}})
          .otherwise("start")
          .says("At which end of a pair the fixed bearing is."),
      table("floating", floating_bearing_keys)
          .sometimes(kOfPair + "; left out, the floating bearing has the numbers of the fixed one")
          .says("What the floating bearing has of its own."),
      quantity("preload", kPreloadRange)
          .above(0.0, "a force above zero")
          .sometimes(kOfPair + "; left out, it is not preloaded")
          .says("Force of a spring between the housing at the floating bearing and the shaft at the fixed one, which "
                "presses the shaft along the axis towards the fixed bearing's end. It takes up the axial play until a "
                "load along the axis exceeds it; the radial play stays, but for what friction at the end face holds."),
      quantity("preload_stiffness", kStiffnessRange)
          .above(0.0, "a stiffness above zero")
          .sometimes("with preload; left out, the play does not change the force")
          .says("Stiffness of that spring, whose force is the preload where the shaft is drawn. It is the spring after "
                "those of the file: spring.1.stiffness and so on."),
      quantity("cross_mass", kMassRange)
          .above(0.0, "a mass above zero")
          .sometimes("needed " + kOfUniversal)
          .says(
              "Mass of the cross. It is the body JOINT.cross between two revolute joints JOINT.first and JOINT.second, "
              "along axis and second_axis, each with this play: clearance.JOINT.first.radial and so on."),
      quantity("cross_radius", kSizeRange)
          .above(0.0, "a length above zero")
          .sometimes(kOfUniversal + ", or cross_inertia")
          .says("Half the length of each arm of the cross. Its inertia is that of two thin rods: m r^2 / 6 about each, "
                "m r^2 / 3 across both."),
      quantities("cross_inertia", kInertiaRange)
          .named({"axis", "second_axis", "across"})
          .of_length({3}, "3 moments of inertia: about axis, about second_axis, across both")
          .sometimes(kOfUniversal + ", in place of cross_radius")
          .says("Moments of inertia of the cross about the joint's axis, its second_axis and the direction across "
                "both.")};
}

}  // namespace

std::vector<Key> with_two_bearings(std::vector<Key> keys_of_one) {
  for (Key& key : own_keys()) keys_of_one.push_back(std::move(key));
  return keys_of_one;
}

std::vector<std::string> two_bearing_keys() {
  std::vector<std::string> names;
  for (const Key& key : own_keys()) names.push_back(key.name);
  return names;
}

const KeyTable& floating_bearing_keys() {
  static const std::string usual = "that of the fixed bearing";
  static const KeyTable table_of_keys{
      .name = "clearance.floating",
      .says = "The floating bearing of a pair, where it differs from the fixed one.",
      .keys = {
          quantity("radial", kSizeRange).above(0.0, "a length above zero").usually(usual).says("Its radial clearance."),
          quantity("journal_radius", kSizeRange)
              .above(0.0, "a length above zero")
              .usually(usual)
              .says("Radius of its journal."),
          quantity("sleeve_length", kSizeRange)
              .above(0.0, "a length above zero")
              .usually(usual)
              .says("Length of its sleeve.")}};
  return table_of_keys;
}

}  // namespace boresight
