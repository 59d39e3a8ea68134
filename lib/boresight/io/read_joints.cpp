#include <cmath>
#include <cstdio>

#include "boresight/io/known_laws.hpp"
#include "boresight/io/mechanism_sections.hpp"
#include "boresight/io/physical_ranges.hpp"
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

double positive(Cursor& cursor, const std::string& key, const PhysicalRange& range) {
  const double value = quantity_in(cursor, key, range);
  cursor.require(value > 0.0, key, std::string(range.unit.what) + " above zero");
  return value;
}

// One number per part, journal and sleeve; `range` null: pure numbers.
std::array<double, 2> read_pair(Cursor& cursor, const std::string& key, const PhysicalRange* range,
                                const std::array<double, 2>& otherwise) {
  const std::vector<std::string> names = {"journal", "sleeve"};
  const std::vector<double> both(otherwise.begin(), otherwise.end());
  const auto values =
      range != nullptr ? quantities_in(cursor, key, *range, names, &both) : cursor.numbers(key, names, &both);
  cursor.require(values.size() == 2, key, "two values: journal, sleeve");
  return {values[0], values[1]};
}

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

// Whether the law in force takes this restitution: its damping may grow without bound as restitution vanishes.
void check_restitution(Cursor& cursor, double restitution, const std::string& law, const std::string& dissipation) {
  cursor.require(restitution >= 0.0 && restitution <= 1.0, "restitution", "a number from 0 to 1");
  const NormalLawEntry& entry = normal_law(dissipation.empty() ? law : dissipation);
  if (entry.damping_factor == nullptr || entry.lowest_restitution < 0.0 || restitution >= kLeastRestitution) return;
  std::string others;
  for (const NormalLawEntry& other : normal_laws())
    if (other.geometry == ContactGeometry::point && other.damping_factor != nullptr && other.lowest_restitution < 0.0 &&
        other.damping_factor(0.0) > 0.0)
      others += (others.empty() ? "" : ", ") + std::string(other.name);
  char least[40];
  std::snprintf(least, sizeof least, "%g", kLeastRestitution);
  cursor.fail("restitution", std::string("a number from ") + least + " to 1 beside the law " + in_quotes(entry.name) +
                                 ", whose damping grows without bound towards 0; laws that take 0: " + others);
}

ContactParameters read_contact(Cursor& cursor, std::string& law, std::string& dissipation,
                               std::vector<AssumedValue>& assumed) {
  cursor.only({"law", "dissipation", "restitution", "young", "poisson", "density", "minimum_impact_speed",
               "stiffness_scale", "stiffness", "damping"});
  ContactParameters p;
  law = cursor.choice("law", contact_law_names(), law);
  const ContactGeometry geometry = normal_law(law).geometry;
  if (cursor.has("dissipation")) {
    dissipation = cursor.choice("dissipation", dissipation_law_names(), dissipation);
    if (geometry != ContactGeometry::line)
      cursor.fail_found("dissipation", "it beside the law " + in_quotes(law),
                        "it beside a law for cylinders: johnson, ...");
  }
  if (geometry == ContactGeometry::linear) {
    p.linear_stiffness = positive(cursor, "stiffness", kStiffnessRange);
    p.linear_damping = quantity_in(cursor, "damping", kDampingRange, 0.0);
    cursor.require(p.linear_damping >= 0.0, "damping", "a damping of zero or more");
  } else {
    for (const char* key : {"stiffness", "damping"})
      if (cursor.has(key))
        cursor.fail_found(key, "it beside the law " + in_quotes(law), "it beside the law \"kelvin-voigt\"");
  }
  p.restitution = cursor.number("restitution", p.restitution);
  check_restitution(cursor, p.restitution, law, dissipation);
  p.young = read_pair(cursor, "young", &kYoungRange, p.young);
  for (const double e : p.young) cursor.require(e > 0.0, "young", "elastic moduli above zero");
  p.poisson = read_pair(cursor, "poisson", nullptr, p.poisson);
  for (const double nu : p.poisson)
    cursor.require(nu >= 0.0 && nu < 0.5, "poisson", "numbers of at least 0, below 0.5");
  p.density = quantity_in(cursor, "density", kDensityRange, p.density);
  cursor.require(p.density > 0.0, "density", "a density above zero");
  p.minimum_impact_speed = quantity_in(cursor, "minimum_impact_speed", kContactSpeedRange, p.minimum_impact_speed);
  cursor.require(p.minimum_impact_speed > 0.0, "minimum_impact_speed", "a speed above zero");
  p.stiffness_scale = cursor.number("stiffness_scale", p.stiffness_scale);
  cursor.require(p.stiffness_scale > 0.0, "stiffness_scale", "a number above zero");
  cursor.require(p.stiffness_scale >= kStiffnessScaleRange[0] && p.stiffness_scale <= kStiffnessScaleRange[1],
                 "stiffness_scale", "a number from 1e-6 to 1e6");
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
  cursor.only({"law", "coefficient", "static_speed", "dynamic_speed", "static_coefficient", "stribeck_speed",
               "bristle_stiffness", "bristle_damping", "viscosity"});
  FrictionParameters p;
  law = cursor.choice("law", friction_law_names(), law);
  p.coefficient = cursor.number("coefficient", p.coefficient);
  cursor.require(p.coefficient >= 0.0, "coefficient", "a number of zero or more");
  cursor.require(p.coefficient <= kLargestFrictionCoefficient, "coefficient", "a number from 0 to 100");
  p.static_speed = quantity_in(cursor, "static_speed", kContactSpeedRange, p.static_speed);
  cursor.require(p.static_speed >= 0.0, "static_speed", "a speed of zero or more");
  p.dynamic_speed = quantity_in(cursor, "dynamic_speed", kContactSpeedRange, p.dynamic_speed);
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
    cursor.require(p.static_coefficient <= kLargestFrictionCoefficient, "static_coefficient",
                   "a number of at most 100");
  }
  if (belongs("stribeck_speed", entry.peak, peaked))
    p.stribeck_speed = positive(cursor, "stribeck_speed", kContactSpeedRange);
  const char* bristly = "it beside the law \"lugre\"";
  if (belongs("bristle_stiffness", entry.sticks, bristly))
    p.bristle_stiffness = positive(cursor, "bristle_stiffness", kBristleStiffnessRange);
  if (belongs("bristle_damping", entry.sticks, bristly)) {
    p.bristle_damping = quantity_in(cursor, "bristle_damping", kBristleDampingRange);
    cursor.require(p.bristle_damping >= 0.0, "bristle_damping", "a damping of zero or more");
  }
  if (belongs("viscosity", entry.sticks, bristly)) {
    p.viscosity = quantity_in(cursor, "viscosity", kBristleDampingRange);
    cursor.require(p.viscosity >= 0.0, "viscosity", "a viscosity of zero or more");
  }
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

}  // namespace

JointDescription read_joint(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only({"name", "type", "connects", "point", "axis", "second_axis", "driven"});
  JointDescription joint;
  joint.origin = cursor.origin();
  joint.name = read_name(cursor, "name");
  for (const JointDescription& other : so_far.joints) {
    if (other.name == joint.name) {
      cursor.fail_found(
          "name", in_quotes(joint.name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
          "a name of its own");
    }
  }
  cursor.rename("joint." + joint.name);
  joint.type = read_type(cursor);
  std::tie(joint.first, joint.second) = read_connects(cursor, so_far);
  joint.point = vector_in(cursor, "point", kCoordinateRange);
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

ClearanceDescription read_clearance(Cursor& cursor, const MechanismDescription& so_far,
                                    std::vector<AssumedValue>* assumed) {
  cursor.only({"joint", "journal", "radial", "axial", "journal_radius", "cap_radius", "sleeve_length", "axes",
               "contact", "friction"});
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
      cursor.fail_found(
          "joint", in_quotes(joint.name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
          "one clearance per joint");
    }
  }
  cursor.rename("clearance." + joint.name);

  const std::string journal = cursor.text("journal");
  clearance.journal = body_index(so_far, cursor, "journal", journal, true);
  if (clearance.journal != joint.first && clearance.journal != joint.second) {
    const auto name = [&](int body) { return body == kGround ? std::string("ground") : so_far.bodies[body].name; };
    cursor.fail_found(
        "journal", in_quotes(journal),
        "one of the bodies of joint " + joint.name + ": " + name(joint.first) + " or " + name(joint.second));
  }
  clearance.axes =
      cursor.choice("axes", {"parallel", "free"}, "parallel") == "free" ? JournalAxes::free : JournalAxes::parallel;

  // A cylindrical joint slides along its axis: no caps, no axial clearance, and no ends unless the journal may tilt.
  ClearanceParameters& p = clearance.parameters;
  const bool caps = joint.type == JointType::revolute;
  if (!caps && cursor.has("axial"))
    cursor.fail_found("axial", "it on " + in_quotes(joint.name) + ", a cylindrical joint",
                      "no axial clearance: the journal slides through its sleeve and has no end faces");
  p.radial = positive(cursor, "radial", kSizeRange);
  p.journal_radius = positive(cursor, "journal_radius", kSizeRange);
  cursor.require(p.radial < p.journal_radius, "radial", "less than journal_radius");
  if (caps) {
    p.axial = quantity_in(cursor, "axial", kSizeRange);
    cursor.require(p.axial >= 0.0, "axial", "a length of zero or more");
  }
  if (caps || cursor.has("cap_radius")) {
    p.cap_radius = positive(cursor, "cap_radius", kSizeRange);
    cursor.require(p.cap_radius > p.journal_radius + p.radial, "cap_radius", "more than journal_radius + radial");
  }
  if (caps || clearance.axes == JournalAxes::free || cursor.has("sleeve_length")) {
    p.sleeve_length = positive(cursor, "sleeve_length", kSizeRange);
  }
  Cursor contact = cursor.table_or_empty("contact"), friction = cursor.table_or_empty("friction");
  std::vector<AssumedValue> left_out;
  if (!cursor.has("axes")) left_out.push_back({.joint = "", .key = "axes", .value = "\"parallel\""});
  p.contact = read_contact(contact, clearance.contact_law, clearance.dissipation_law, left_out);
  if (normal_law(clearance.contact_law).geometry == ContactGeometry::line && p.sleeve_length == 0.0)
    p.sleeve_length = positive(cursor, "sleeve_length", kSizeRange);
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
