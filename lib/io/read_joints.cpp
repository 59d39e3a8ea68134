#include <cmath>

#include "boresight/io/known_laws.hpp"
#include "boresight/io/mechanism_sections.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

const JointType kTypes[] = {JointType::revolute,  JointType::prismatic, JointType::cylindrical, JointType::universal,
                            JointType::spherical, JointType::planar,    JointType::fixed};

JointType read_type(Cursor& cursor) {
  std::vector<std::string> names;
  for (const JointType type : kTypes) names.emplace_back(to_string(type));
  const std::string word = cursor.choice("type", names);
  for (const JointType type : kTypes) {
    if (word == to_string(type)) return type;
  }
  return JointType::fixed;
}

// A universal joint's two axes are perpendicular in every pose; the second is turned to be exactly so.
Vec3 read_second_axis(Cursor& cursor, const Vec3& axis) {
  const Vec3 second = cursor.direction("second_axis");
  const double skew = axis.dot(second);
  if (std::abs(skew) > 1e-3) {
    cursor.fail_found("second_axis", "a direction that is not perpendicular to axis", "perpendicular axes");
  }
  return (second - skew * axis).normalized();
}

double positive(Cursor& cursor, const std::string& key, const SiUnit& unit) {
  const double value = cursor.quantity(key, unit);
  cursor.require(value > 0.0, key, std::string(unit.what) + " above zero");
  return value;
}

// One number per part, journal and sleeve; `unit` null: pure numbers.
std::array<double, 2> read_pair(Cursor& cursor, const std::string& key, const SiUnit* unit,
                                const std::array<double, 2>& otherwise) {
  const std::vector<std::string> names = {"journal", "sleeve"};
  const std::vector<double> both(otherwise.begin(), otherwise.end());
  const auto values = unit != nullptr ? cursor.quantities(key, *unit, names, &both) : cursor.numbers(key, names, &both);
  cursor.require(values.size() == 2, key, "two values: journal, sleeve");
  return {values[0], values[1]};
}

ContactParameters read_contact(Cursor& cursor, std::string& law, std::string& dissipation) {
  cursor.only({"law", "dissipation", "restitution", "young", "poisson", "density", "minimum_impact_speed",
               "stiffness_scale", "stiffness", "damping"});
  ContactParameters p;
  law = cursor.choice("law", contact_law_names(), law);
  const ContactGeometry geometry = normal_law(law).geometry;
  if (cursor.has("dissipation")) {
    dissipation = cursor.choice("dissipation", dissipation_law_names(), dissipation);
    if (geometry != ContactGeometry::line)
      cursor.fail_found("dissipation", "it beside the law " + in_quotes(law), "it beside a law for cylinders: johnson, ...");
  }
  if (geometry == ContactGeometry::linear) {
    p.linear_stiffness = positive(cursor, "stiffness", kStiffness);
    p.linear_damping = cursor.quantity("damping", kDamping, 0.0);
    cursor.require(p.linear_damping >= 0.0, "damping", "a damping of zero or more");
  } else {
    for (const char* key : {"stiffness", "damping"})
      if (cursor.has(key)) cursor.fail_found(key, "it beside the law " + in_quotes(law), "it beside the law \"kelvin-voigt\"");
  }
  p.restitution = cursor.number("restitution", p.restitution);
  cursor.require(p.restitution > 0.0 && p.restitution <= 1.0, "restitution", "a number above 0, at most 1");
  p.young = read_pair(cursor, "young", &kElasticModulus, p.young);
  for (const double e : p.young) cursor.require(e > 0.0, "young", "elastic moduli above zero");
  p.poisson = read_pair(cursor, "poisson", nullptr, p.poisson);
  for (const double nu : p.poisson) cursor.require(nu >= 0.0 && nu < 0.5, "poisson", "numbers of at least 0, below 0.5");
  p.density = cursor.quantity("density", kDensity, p.density);
  cursor.require(p.density > 0.0, "density", "a density above zero");
  p.minimum_impact_speed = cursor.quantity("minimum_impact_speed", kSpeed, p.minimum_impact_speed);
  cursor.require(p.minimum_impact_speed > 0.0, "minimum_impact_speed", "a speed above zero");
  p.stiffness_scale = cursor.number("stiffness_scale", p.stiffness_scale);
  cursor.require(p.stiffness_scale > 0.0, "stiffness_scale", "a number above zero");
  cursor.finish();
  return p;
}

FrictionParameters read_friction(Cursor& cursor, std::string& law) {
  cursor.only({"law", "coefficient", "static_speed", "dynamic_speed", "static_coefficient", "stribeck_speed",
               "bristle_stiffness", "bristle_damping", "viscosity"});
  FrictionParameters p;
  law = cursor.choice("law", friction_law_names(), law);
  p.coefficient = cursor.number("coefficient", p.coefficient);
  cursor.require(p.coefficient >= 0.0, "coefficient", "a number of zero or more");
  p.static_speed = cursor.quantity("static_speed", kSpeed, p.static_speed);
  cursor.require(p.static_speed >= 0.0, "static_speed", "a speed of zero or more");
  p.dynamic_speed = cursor.quantity("dynamic_speed", kSpeed, p.dynamic_speed);
  cursor.require(p.dynamic_speed > p.static_speed, cursor.has("dynamic_speed") ? "dynamic_speed" : "static_speed",
                 "dynamic_speed above static_speed");
  const FrictionLawEntry& entry = friction_law(law);
  const auto belongs = [&](const char* key, bool allowed, const char* to) {
    if (cursor.has(key) && !allowed) cursor.fail_found(key, "it beside the law " + in_quotes(law), to);
    return cursor.has(key);
  };
  const char* peaked = "it beside a law with a static peak: bengisu-akay, brown-mcphee, lugre";
  if (belongs("static_coefficient", entry.peak, peaked)) {
    p.static_coefficient = cursor.number("static_coefficient");
    cursor.require(p.static_coefficient >= p.coefficient, "static_coefficient", "a number of at least coefficient");
  }
  if (belongs("stribeck_speed", entry.peak, peaked)) p.stribeck_speed = positive(cursor, "stribeck_speed", kSpeed);
  const char* bristly = "it beside the law \"lugre\"";
  if (belongs("bristle_stiffness", entry.sticks, bristly))
    p.bristle_stiffness = positive(cursor, "bristle_stiffness", kPerLength);
  if (belongs("bristle_damping", entry.sticks, bristly)) {
    p.bristle_damping = cursor.quantity("bristle_damping", kPerSpeed);
    cursor.require(p.bristle_damping >= 0.0, "bristle_damping", "a damping of zero or more");
  }
  if (belongs("viscosity", entry.sticks, bristly)) {
    p.viscosity = cursor.quantity("viscosity", kPerSpeed);
    cursor.require(p.viscosity >= 0.0, "viscosity", "a viscosity of zero or more");
  }
  cursor.finish();
  return p;
}

}  // namespace

JointDescription read_joint(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only({"name", "type", "connects", "point", "axis", "second_axis", "driven"});
  JointDescription joint;
  joint.origin = cursor.origin();
  joint.name = read_name(cursor, "name");
  for (const JointDescription& other : so_far.joints) {
    if (other.name == joint.name) {
      cursor.fail_found("name", in_quotes(joint.name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
                        "a name of its own");
    }
  }
  cursor.rename("joint." + joint.name);
  joint.type = read_type(cursor);
  std::tie(joint.first, joint.second) = read_connects(cursor, so_far);
  joint.point = cursor.vector("point", kLength);
  const bool has_axis = joint.type != JointType::spherical && joint.type != JointType::fixed;
  if (has_axis) joint.axis = cursor.direction("axis");
  if (joint.type == JointType::universal) joint.second_axis = read_second_axis(cursor, joint.axis);
  joint.driven = cursor.boolean("driven", false);
  if (joint.driven && joint.type != JointType::revolute && joint.type != JointType::prismatic) {
    cursor.fail_found("driven", std::string("a driven ") + to_string(joint.type) + " joint",
                      "a drive on a revolute or prismatic joint");
  }
  cursor.finish();
  return joint;
}

ClearanceDescription read_clearance(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only({"joint", "journal", "radial", "axial", "journal_radius", "cap_radius", "sleeve_length", "axes", "contact",
               "friction"});
  ClearanceDescription clearance;
  clearance.origin = cursor.origin();
  clearance.joint = joint_index(so_far, cursor, "joint", cursor.text("joint"));
  const JointDescription& joint = so_far.joints[clearance.joint];
  if (joint.type != JointType::revolute && joint.type != JointType::cylindrical) {
    cursor.fail_found("joint", in_quotes(joint.name) + ", a " + to_string(joint.type) + " joint",
                      "a revolute or cylindrical joint");
  }
  for (const ClearanceDescription& other : so_far.clearances) {
    if (other.joint == clearance.joint) {
      cursor.fail_found("joint", in_quotes(joint.name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
                        "one clearance per joint");
    }
  }
  cursor.rename("clearance." + joint.name);

  const std::string journal = cursor.text("journal");
  clearance.journal = body_index(so_far, cursor, "journal", journal, true);
  if (clearance.journal != joint.first && clearance.journal != joint.second) {
    const auto name = [&](int body) { return body == kGround ? std::string("ground") : so_far.bodies[body].name; };
    cursor.fail_found("journal", in_quotes(journal),
                      "one of the bodies of joint " + joint.name + ": " + name(joint.first) + " or " + name(joint.second));
  }
  clearance.axes = cursor.choice("axes", {"parallel", "free"}, "parallel") == "free" ? JournalAxes::free : JournalAxes::parallel;

  // A cylindrical joint slides along its axis: no caps, no axial clearance, and no ends unless the journal may tilt.
  ClearanceParameters& p = clearance.parameters;
  const bool caps = joint.type == JointType::revolute;
  if (!caps && cursor.has("axial"))
    cursor.fail_found("axial", "it on " + in_quotes(joint.name) + ", a cylindrical joint",
                      "no axial clearance: the journal slides through its sleeve and has no end faces");
  p.radial = positive(cursor, "radial", kLength);
  p.journal_radius = positive(cursor, "journal_radius", kLength);
  if (caps) {
    p.axial = cursor.quantity("axial", kLength);
    cursor.require(p.axial >= 0.0, "axial", "a length of zero or more");
  }
  if (caps || cursor.has("cap_radius")) {
    p.cap_radius = positive(cursor, "cap_radius", kLength);
    cursor.require(p.cap_radius > p.journal_radius + p.radial, "cap_radius", "more than journal_radius + radial");
  }
  if (caps || clearance.axes == JournalAxes::free || cursor.has("sleeve_length")) {
    p.sleeve_length = positive(cursor, "sleeve_length", kLength);
  }
  Cursor contact = cursor.table_or_empty("contact"), friction = cursor.table_or_empty("friction");
  p.contact = read_contact(contact, clearance.contact_law, clearance.dissipation_law);
  if (normal_law(clearance.contact_law).geometry == ContactGeometry::line && p.sleeve_length == 0.0)
    p.sleeve_length = positive(cursor, "sleeve_length", kLength);
  p.friction = read_friction(friction, clearance.friction_law);
  cursor.finish();
  return clearance;
}

}  // namespace boresight
