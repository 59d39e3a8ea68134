#include "errors.hpp"

#include <fmt/format.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "draw.hpp"
#include "seed_of_text.hpp"

namespace boresight::gauntlet {
namespace {

constexpr int kMostErrors = 6;
constexpr double kSmallest = 3e-6, kLargest = 1e-4;  // of the mechanism's size, or rad

}  // namespace

std::string with_errors(const std::string& toml) {
  const Mechanism mechanism(read_mechanism_text(toml, "scene"));
  const MechanismDescription& m = mechanism.description();
  Draw draw(seed_of_text(toml));
  std::string text = toml + "\n";
  const double length = mechanism.characteristic_length();
  const int errors = draw.whole(1, kMostErrors);
  for (int e = 0; e < errors; ++e) {
    const JointDescription& joint = m.joints[draw.whole(0, mechanism.joints() - 1)];
    const double size = draw.sign() * draw.log_between(kSmallest, kLargest);
    text += fmt::format("\n[[error]]\nname = \"e{}.of {}\"\n", e + 1, joint.name);
    if (joint.driven && draw.chance(0.5)) {
      const bool slides = joint.type == JointType::prismatic;
      text += fmt::format("drive = \"{}\"\nlaw = \"{}\"\nvalue = \"{:.17g} {}\"\n", joint.name,
                          draw.one_of(std::vector<std::string>{"1", "cos(3*q)", "sin(q + t)"}),
                          slides ? size * length : size, slides ? "m" : "rad");
      continue;
    }
    const int body = draw.chance(0.5) ? joint.first : joint.second;
    const Vec3 d = draw.direction();
    const bool turns = draw.chance(0.5);
    text +=
        fmt::format("joint = \"{}\"\nbody = \"{}\"\n{} = [{:.17g}, {:.17g}, {:.17g}]\nvalue = \"{:.17g} {}\"\n",
                    joint.name, body == kGround ? "ground" : m.bodies[body].name, turns ? "rotation" : "translation",
                    d.x(), d.y(), d.z(), turns ? size : size * length, turns ? "rad" : "m");
  }
  return text;
}

}  // namespace boresight::gauntlet
