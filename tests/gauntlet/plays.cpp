#include "plays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "draw.hpp"
#include "seed_of_text.hpp"

namespace boresight::gauntlet {
namespace {

std::string meters(const char* key, double value) { return fmt::format("{} = \"{:.17g} m\"\n", key, value); }

struct Sizes {
  double journal = 0.0, gap = 0.0;  // [m]
};

// A bearing with end faces, of a shaft or of a cross.
std::string bearing(Draw& draw, const Sizes& s) {
  return meters("radial", s.gap) + meters("axial", s.gap * draw.log_between(0.3, 3.0)) +
         meters("journal_radius", s.journal) + meters("cap_radius", (s.journal + s.gap) * draw.between(1.2, 1.8));
}

// Balls and pads take laws for points and springs; a ball no friction that remembers directions.
std::string contact_of(Draw& draw, double smallest_mass, double gap, bool ball, bool pad) {
  std::vector<std::string> laws, frictions;
  for (const NormalLawEntry& law : normal_laws())
    if (!(ball || pad) || law.geometry != ContactGeometry::line) laws.push_back(law.name);
  for (const FrictionLawEntry& law : friction_laws())
    if (!ball || law.kind != FrictionKind::lugre) frictions.push_back(law.name);
  const std::string law = draw.chance(0.5) ? "flores" : draw.one_of(laws);
  std::string text = fmt::format("[clearance.contact]\nlaw = \"{}\"\nrestitution = {:.6g}\n", law,
                                 draw.chance(0.1) ? 1.0 : draw.between(0.3, 0.95));
  if (normal_law(law).geometry == ContactGeometry::linear) {
    // A deflection of a twentieth of the play under a few weights, damped by a tenth to a half.
    const double stiffness = 400.0 * smallest_mass / gap;
    text += fmt::format("stiffness = \"{:.6g} N/m\"\ndamping = \"{:.6g} N s/m\"\n", stiffness,
                        2.0 * draw.between(0.05, 0.5) * std::sqrt(stiffness * smallest_mass));
  }
  const std::string friction = draw.chance(0.4) ? "modified-coulomb" : draw.one_of(frictions);
  text += fmt::format("[clearance.friction]\nlaw = \"{}\"\n", friction);
  if (friction != "none") text += fmt::format("coefficient = {:.6g}\n", draw.log_between(0.01, 0.4));
  return text;
}

}  // namespace

std::string with_plays(const std::string& toml, bool corners) {
  const Mechanism mechanism(read_mechanism_text(toml, "scene"));
  const MechanismDescription& m = mechanism.description();
  Draw draw(seed_of_text(toml));
  double smallest_mass = 1e300;
  for (const BodyDescription& body : m.bodies) smallest_mass = std::min(smallest_mass, body.mass);
  std::string text = toml + "\n";
  for (int j = 0; j < mechanism.joints(); ++j) {
    const JointDescription& joint = m.joints[j];
    const bool taken = std::any_of(m.clearances.begin(), m.clearances.end(),
                                   [&](const ClearanceDescription& c) { return c.joint == j; });
    if (taken || joint.type == JointType::fixed || joint.type == JointType::cylindrical) continue;
    if (!draw.chance(joint.type == JointType::revolute ? 0.2 : 0.7)) continue;
    Sizes s;
    s.journal = mechanism.characteristic_length() * draw.between(0.02, 0.06);
    s.gap = s.journal * draw.log_between(1e-3, 2e-2);
    const bool tilts = draw.chance(0.5);
    const double length = s.journal * draw.between(1.5, 8.0);
    const std::string sleeve = meters("sleeve_length", length);
    std::string sizes;
    switch (joint.type) {
      case JointType::revolute:
        sizes = "bearing = \"pair\"\n" + meters("span", length * draw.between(1.2, 5.0)) + bearing(draw, s) + sleeve;
        break;
      case JointType::prismatic:
        if (draw.chance(0.5)) {
          sizes = meters("radial", s.gap) + meters("journal_radius", s.journal) + sleeve;
        } else {
          const Vec3 across = joint.axis.unitOrthogonal();
          sizes = "guide = \"rectangular\"\n" + meters("width", 2.0 * s.journal) +
                  meters("height", s.journal * draw.between(1.0, 2.0)) +
                  meters("length", s.journal * draw.between(2.0, 8.0)) + meters("width_gap", s.gap) +
                  meters("height_gap", s.gap * draw.log_between(0.3, 3.0)) +
                  fmt::format("width_direction = [{:.17g}, {:.17g}, {:.17g}]\n", across.x(), across.y(), across.z());
        }
        break;
      case JointType::spherical:
        sizes = meters("radial", s.gap) + meters("journal_radius", s.journal);
        break;
      case JointType::universal:
        sizes = bearing(draw, s) + fmt::format("cross_mass = \"{:.17g} kg\"\n", 0.1 * smallest_mass) +
                meters("cross_radius", s.journal * draw.between(2.0, 4.0)) + sleeve;
        break;
      default:
        if (corners && draw.chance(0.5)) {
          const Vec3 along = turned(across(joint.axis), joint.axis, draw.between(0.0, 3.0));
          sizes = meters("axial", s.gap) + meters("width", s.journal * draw.between(1.5, 5.0)) +
                  meters("length", s.journal * draw.between(1.5, 5.0)) +
                  fmt::format("width_direction = [{:.17g}, {:.17g}, {:.17g}]\n", along.x(), along.y(), along.z());
        } else {
          sizes = meters("axial", s.gap) + meters("pad_radius", s.journal * draw.between(1.0, 3.0));
        }
        break;
    }
    const int journal = draw.chance(0.5) ? joint.first : joint.second;
    text += fmt::format("\n[[clearance]]\njoint = \"{}\"\n", joint.name);
    if (joint.type != JointType::universal)
      text += fmt::format("journal = \"{}\"\n", journal == kGround ? "ground" : m.bodies[journal].name);
    text += sizes;
    if (joint.type != JointType::spherical) text += tilts ? "axes = \"free\"\n" : "axes = \"parallel\"\n";
    text += contact_of(draw, smallest_mass, s.gap, joint.type == JointType::spherical, joint.type == JointType::planar);
  }
  return text;
}

}  // namespace boresight::gauntlet
