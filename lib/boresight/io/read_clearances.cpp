#include <cmath>
#include <cstdio>

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/keys/numbers_together.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// In a file; a universal joint is two revolute ones by the time that it is checked (expand_clearances.cpp).
constexpr char kTypesOfFile[] = "a revolute, cylindrical, prismatic, planar, spherical or universal joint";

// Of journal and sleeve.
std::array<double, 2> pair(const std::vector<double>& values) { return {values[0], values[1]}; }

// Notes what a table leaves out and results hang on: key, and the value taken.
class Assumed {
 public:
  Assumed(const Cursor& table, std::string prefix, std::vector<AssumedValue>& list)
      : table_(table), prefix_(std::move(prefix)), list_(list) {}
  void unless_given(const char* key, const std::string& value) {
    if (!table_.has(key)) list_.push_back({.joint = "", .key = prefix_ + key, .value = value});
  }
  void unless_given(const char* key, double value, const char* unit) {
    char text[60];
    std::snprintf(text, sizeof text, *unit != '\0' ? "%.6g %s" : "%.6g", value, unit);
    unless_given(key, text);
  }

 private:
  const Cursor& table_;
  std::string prefix_;
  std::vector<AssumedValue>& list_;
};

template <typename Owner>
void require(const Cursor& cursor, const NumbersTogether<Owner>& together, const Owner& numbers) {
  cursor.require(together.hold(numbers), together.key, together.expected);
}

ContactParameters read_contact(Cursor& cursor, std::string& law, std::string& dissipation,
                               std::vector<AssumedValue>& assumed) {
  cursor.only(contact_keys());
  ContactParameters p;
  law = cursor.choice("law");
  const ContactGeometry geometry = normal_law(law).geometry;
  if (geometry == ContactGeometry::line ? cursor.has("dissipation") : cursor.has_by_name("dissipation")) {
    dissipation = cursor.choice("dissipation");
    if (geometry != ContactGeometry::line)
      cursor.fail_found("dissipation", "it with law = " + in_quotes(law),
                        "it only with a law for cylinders: johnson, ...");
  }
  if (geometry == ContactGeometry::linear) {
    p.linear_stiffness = cursor.quantity("stiffness");
    p.linear_damping = cursor.quantity("damping");
  } else {
    for (const char* key : {"stiffness", "damping"})
      if (cursor.has_by_name(key))
        cursor.fail_found(key, "it with law = " + in_quotes(law), "it only with law = \"kelvin-voigt\"");
  }
  p.restitution = cursor.number("restitution");
  if (const auto expected = refused_restitution(law, dissipation, p.restitution)) cursor.fail("restitution", *expected);
  p.young = pair(cursor.quantities("young"));
  p.poisson = pair(cursor.numbers("poisson"));
  p.density = cursor.quantity("density");
  p.minimum_impact_speed = cursor.quantity("minimum_impact_speed");
  p.stiffness_scale = cursor.number("stiffness_scale");
  cursor.finish();

  Assumed left_out(cursor, "contact.", assumed);
  left_out.unless_given("law", in_quotes(law));
  // The end faces are elastic whatever the law of the bore.
  left_out.unless_given("young", 1e-9 * p.young[0], "GPa");
  left_out.unless_given("poisson", p.poisson[0], "");
  const NormalLawEntry& damping = normal_law(dissipation.empty() ? law : dissipation);
  if (damping.damping_factor != nullptr && std::string(damping.name) != "hertz") {
    left_out.unless_given("restitution", p.restitution, "");
    left_out.unless_given("minimum_impact_speed", 1e3 * p.minimum_impact_speed, "mm/s");
    left_out.unless_given("density", p.density, "kg/m^3");
  }
  if (geometry == ContactGeometry::linear) left_out.unless_given("damping", p.linear_damping, "N s/m");
  return p;
}

FrictionParameters read_friction(Cursor& cursor, std::string& law, std::vector<AssumedValue>& assumed) {
  cursor.only(friction_keys());
  FrictionParameters p;
  law = cursor.choice("law");
  p.coefficient = cursor.number("coefficient");
  p.static_speed = cursor.quantity("static_speed");
  p.dynamic_speed = cursor.quantity("dynamic_speed");
  cursor.require(kSpeedsInOrder.hold(p), cursor.has("dynamic_speed") ? "dynamic_speed" : "static_speed",
                 kSpeedsInOrder.expected);
  const FrictionLawEntry& entry = friction_law(law);
  const auto belongs = [&](const char* key, bool allowed, const char* to) {
    if (cursor.has_by_name(key) && !allowed) cursor.fail_found(key, "it with law = " + in_quotes(law), to);
    return allowed && cursor.has(key);
  };
  const char* peaked = "it only with a law that has a static peak: bengisu-akay, brown-mcphee, lugre";
  if (belongs("static_coefficient", entry.peak, peaked)) {
    p.static_coefficient = cursor.number("static_coefficient");
    require(cursor, kStictionAboveFriction, p);
  }
  if (belongs("stribeck_speed", entry.peak, peaked)) p.stribeck_speed = cursor.quantity("stribeck_speed");
  const char* bristly = "it only with law = \"lugre\"";
  if (belongs("bristle_stiffness", entry.sticks, bristly)) p.bristle_stiffness = cursor.quantity("bristle_stiffness");
  if (belongs("bristle_damping", entry.sticks, bristly)) p.bristle_damping = cursor.quantity("bristle_damping");
  if (belongs("viscosity", entry.sticks, bristly)) p.viscosity = cursor.quantity("viscosity");
  cursor.finish();

  Assumed left_out(cursor, "friction.", assumed);
  if (law == "none") return p;
  left_out.unless_given("coefficient", p.coefficient, "");
  if (p.coefficient == 0.0 && p.static_coefficient == 0.0) return p;
  left_out.unless_given("law", in_quotes(law));
  if (entry.kind == FrictionKind::modified_coulomb) left_out.unless_given("static_speed", 1e3 * p.static_speed, "mm/s");
  left_out.unless_given("dynamic_speed", 1e3 * p.dynamic_speed, "mm/s");
  if (entry.peak) left_out.unless_given("static_coefficient", p.coefficient, "");
  if (entry.peak && entry.kind != FrictionKind::brown_mcphee)
    left_out.unless_given("stribeck_speed", 1e3 * p.stribeck_speed, "mm/s");
  if (entry.sticks) {
    left_out.unless_given("bristle_stiffness", p.bristle_stiffness, "m^-1");
    left_out.unless_given("bristle_damping", p.bristle_damping, "s/m");
    left_out.unless_given("viscosity", p.viscosity, "s/m");
  }
  return p;
}

// Where the width of a slider or a pad lies.
void read_width_direction(Cursor& cursor, const JointDescription& joint, ClearanceDescription& clearance) {
  const Vec3 width = cursor.direction("width_direction");
  const double skew = width.dot(joint.axis);
  if (std::abs(skew) > 1e-3)
    cursor.fail_found("width_direction",
                      "a direction that is not perpendicular to the axis of " + in_quotes(joint.name),
                      "perpendicular directions");
  clearance.width_direction = (width - skew * joint.axis).normalized();
}

// A slider in a rectangular guide: its size and gaps, and where its width lies.
void read_slider(Cursor& cursor, const JointDescription& joint, ClearanceDescription& clearance) {
  ClearanceParameters& p = clearance.parameters;
  clearance.guide = GuideShape::rectangular;
  p.width = cursor.quantity("width");
  p.height = cursor.quantity("height");
  p.length = cursor.quantity("length");
  p.width_gap = cursor.quantity("width_gap");
  p.height_gap = cursor.quantity("height_gap");
  require(cursor, kGapWithinWidth, p);
  require(cursor, kGapWithinHeight, p);
  read_width_direction(cursor, joint, clearance);
}

// A pad between two faces: a round one, or one whose corners turn with it.
void read_pad(Cursor& cursor, const JointDescription& joint, ClearanceDescription& clearance) {
  ClearanceParameters& p = clearance.parameters;
  p.axial = cursor.quantity("axial");
  const bool corners =
      cursor.has_by_name("width") || cursor.has_by_name("length") || cursor.has_by_name("width_direction");
  if (!corners) {
    p.pad_radius = cursor.quantity("pad_radius");
    return;
  }
  if (cursor.has_by_name("pad_radius"))
    cursor.fail_found("pad_radius", "it on " + in_quotes(joint.name) + ", whose pad is rectangular",
                      "either pad_radius, of a round pad, or width, length and width_direction");
  clearance.pad = PadShape::rectangular;
  p.width = cursor.quantity("width");
  p.length = cursor.quantity("length");
  read_width_direction(cursor, joint, clearance);
}

}  // namespace

ClearanceDescription read_clearance(Cursor& cursor, const MechanismDescription& so_far,
                                    std::vector<AssumedValue>* assumed) {
  cursor.only(clearance_keys());
  ClearanceDescription clearance;
  clearance.origin = cursor.origin();
  clearance.joint = joint_index(so_far, cursor, "joint", cursor.text("joint"));
  const JointDescription& joint = so_far.joints[clearance.joint];
  if (!can_have_play(joint.type))
    cursor.fail_found("joint", in_quotes(joint.name) + ", a " + to_string(joint.type) + " joint", kTypesOfFile);
  for (const ClearanceDescription& other : so_far.clearances) {
    if (other.joint == clearance.joint) {
      cursor.fail_found(
          "joint", in_quotes(joint.name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
          "one clearance per joint");
    }
  }
  cursor.rename("clearance." + joint.name);

  cursor.choice("bearing");  // one by now
  clearance.journal = read_journal(cursor, so_far, joint);
  const bool ball = joint.type == JointType::spherical, pad = joint.type == JointType::planar;
  const bool slider = joint.type == JointType::prismatic && cursor.choice("guide") == "rectangular";
  if (cursor.has_by_name("guide") && joint.type != JointType::prismatic)
    cursor.fail_found("guide", "it on " + in_quotes(joint.name) + ", a " + to_string(joint.type) + " joint",
                      "it only on a prismatic joint");
  for (const char* key : {"radial", "axial", "journal_radius", "cap_radius", "sleeve_length"})
    if (slider && cursor.has_by_name(key))
      cursor.fail_found(key, "it on " + in_quotes(joint.name) + ", whose guide is rectangular",
                        "width, height, length, width_gap and height_gap: the slider's size and its gaps");
  const std::string of_guide = "it only on a prismatic joint with guide = \"rectangular\"";
  for (const char* key : {"width", "length", "width_direction"})
    if (!slider && !pad && cursor.has_by_name(key))
      cursor.fail_found(key, "it on " + in_quotes(joint.name) + ", which has no rectangular guide",
                        of_guide + ", or on a planar one with a rectangular pad");
  for (const char* key : {"height", "width_gap", "height_gap"})
    if (!slider && cursor.has_by_name(key))
      cursor.fail_found(key, "it on " + in_quotes(joint.name) + ", which has no rectangular guide", of_guide);
  for (const char* key : {"radial", "journal_radius", "cap_radius", "sleeve_length"})
    if (pad && cursor.has_by_name(key))
      cursor.fail_found(
          key, "it on " + in_quotes(joint.name) + ", a planar joint",
          "axial with pad_radius, or with width, length and width_direction: the gap on each side of a pad, "
          "and the pad's size");
  if (!pad && cursor.has_by_name("pad_radius"))
    cursor.fail_found("pad_radius", "it on " + in_quotes(joint.name) + ", a " + to_string(joint.type) + " joint",
                      "it only on a planar joint, which has a pad");
  for (const char* key : {"axial", "cap_radius", "sleeve_length", "axes"})
    if (ball && cursor.has_by_name(key))
      cursor.fail_found(key, "it on " + in_quotes(joint.name) + ", a spherical joint",
                        "radial and journal_radius alone: the play of a ball and its radius");
  const bool free = !ball && cursor.choice("axes", {"parallel", "free"}, "parallel") == "free";
  clearance.axes = free ? JournalAxes::free : JournalAxes::parallel;

  // A cylindrical or prismatic joint slides along its axis: no caps, no axial clearance, and no ends unless the journal may tilt.
  ClearanceParameters& p = clearance.parameters;
  const bool caps = joint.type == JointType::revolute;
  if (slides_along_axis(joint.type) && cursor.has_by_name("axial"))
    cursor.fail_found("axial", "it on " + in_quotes(joint.name) + ", a " + to_string(joint.type) + " joint",
                      "no axial clearance: the journal slides through its sleeve and has no end faces");
  if (slider) {
    read_slider(cursor, joint, clearance);
  } else if (pad) {
    read_pad(cursor, joint, clearance);
  } else {
    p.radial = cursor.quantity("radial");
    p.journal_radius = cursor.quantity("journal_radius");
    require(cursor, kPlayWithinJournal, p);
  }
  if (caps) p.axial = cursor.quantity("axial");
  const bool sleeve = !ball && !pad && !slider;
  if (caps || (sleeve && cursor.has("cap_radius"))) {
    p.cap_radius = cursor.quantity("cap_radius");
    require(cursor, kCapsBeyondBore, p);
  }
  if (caps || (sleeve && (clearance.axes == JournalAxes::free || cursor.has("sleeve_length")))) {
    p.sleeve_length = cursor.quantity("sleeve_length");
  }
  Cursor contact = cursor.table_or_empty("contact"), friction = cursor.table_or_empty("friction");
  std::vector<AssumedValue> left_out;
  if (!ball && !cursor.has("axes")) left_out.push_back({.joint = "", .key = "axes", .value = "\"parallel\""});
  p.contact = read_contact(contact, clearance.contact_law, clearance.dissipation_law, left_out);
  if ((ball || pad || slider) && normal_law(clearance.contact_law).geometry == ContactGeometry::line)
    contact.fail_found("law", in_quotes(clearance.contact_law) + ", a law for cylinders",
                       "a law for points or a spring: " + in_quotes(joint.name) + " is a " +
                           (ball     ? "ball in its socket"
                            : slider ? "slider between faces, to which it lends its damping"
                                     : "pad between faces, to which it lends its damping"));
  if (normal_law(clearance.contact_law).geometry == ContactGeometry::line && p.sleeve_length == 0.0)
    p.sleeve_length = cursor.quantity("sleeve_length");
  p.friction = read_friction(friction, clearance.friction_law, left_out);
  cursor.finish();
  if (assumed == nullptr) return clearance;
  for (AssumedValue& value : left_out) {
    value.joint = joint.name;
    assumed->push_back(value);
  }
  return clearance;
}

}  // namespace boresight
