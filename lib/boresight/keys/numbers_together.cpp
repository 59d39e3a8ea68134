#include "boresight/keys/numbers_together.hpp"

#include <cstdio>
#include <initializer_list>
#include <utility>

#include "boresight/contact/normal_law.hpp"
#include "boresight/keys/physical_ranges.hpp"

namespace boresight {
namespace {

std::string in_unit(double value, double scale, const char* unit) {
  char text[60];
  std::snprintf(text, sizeof text, "%.6g%s", value * scale, unit);
  return text;
}
std::string length(double value) { return in_unit(value, 1e3, " mm"); }
std::string speed(double value) { return in_unit(value, 1e3, " mm/s"); }
std::string number(double value) { return in_unit(value, 1.0, ""); }

using Named = std::pair<const char*, std::string>;

// "9 mm with journal_radius = 8 mm, radial = 2 mm".
std::string beside(std::string found, std::initializer_list<Named> others) {
  const char* before = " with ";
  for (const auto& [name, value] : others) {
    found += std::string(before) + name + " = " + value;
    before = ", ";
  }
  return found;
}

// Of the bearing that floats, the one at the fixed end, as the file's pair is written out: its joint comes right before.
const ClearanceParameters* fixed_end_of(const MechanismDescription& m, const Parameters& p, int floating) {
  const std::string& name = m.joints[static_cast<std::size_t>(floating)].name;
  if (floating == 0 || !name.ends_with(".floating")) return nullptr;
  for (std::size_t c = 0; c < m.clearances.size(); ++c)
    if (m.clearances[c].joint == floating - 1 &&
        m.joints[static_cast<std::size_t>(floating) - 1].name + ".floating" == name)
      return &p.clearance[c];
  return nullptr;
}

// Of one clearance: paths within it.
std::optional<ImpossibleNumbers> impossible_sizes(const MechanismDescription& m, const ClearanceDescription& d,
                                                  const ClearanceParameters& p) {
  const auto of = [](const NumbersTogether<ClearanceParameters>& together, const std::string& found) {
    return ImpossibleNumbers{together.key, found, together.expected};
  };
  if (d.guide == GuideShape::rectangular) {
    if (!kGapWithinWidth.hold(p)) return of(kGapWithinWidth, beside(length(p.width_gap), {{"width", length(p.width)}}));
    if (!kGapWithinHeight.hold(p))
      return of(kGapWithinHeight, beside(length(p.height_gap), {{"height", length(p.height)}}));
    return {};
  }
  if (m.joints[static_cast<std::size_t>(d.joint)].type == JointType::planar) return {};
  if (!kPlayWithinJournal.hold(p))
    return of(kPlayWithinJournal, beside(length(p.radial), {{"journal_radius", length(p.journal_radius)}}));
  if (!kCapsBeyondBore.hold(p))
    return of(kCapsBeyondBore, beside(length(p.cap_radius),
                                      {{"journal_radius", length(p.journal_radius)}, {"radial", length(p.radial)}}));
  return {};
}

std::optional<ImpossibleNumbers> impossible_friction(const FrictionParameters& p) {
  const auto of = [](const NumbersTogether<FrictionParameters>& together, const std::string& found) {
    return ImpossibleNumbers{std::string("friction.") + together.key, found, together.expected};
  };
  if (!kSpeedsInOrder.hold(p))
    return of(kSpeedsInOrder, beside(speed(p.dynamic_speed), {{"static_speed", speed(p.static_speed)}}));
  // One that is left out is the kinetic one.
  if (p.static_coefficient != 0.0 && !kStictionAboveFriction.hold(p))
    return of(kStictionAboveFriction, beside(number(p.static_coefficient), {{"coefficient", number(p.coefficient)}}));
  return {};
}

// Two sleeves on one shaft must lie further apart than they are long.
std::optional<ImpossibleNumbers> impossible_pair(const MechanismDescription& m, const Parameters& p, std::size_t c) {
  constexpr double kRounding = 1e-9;  // of a span that joints' points tell
  const int floating = m.clearances[c].joint;
  const ClearanceParameters* fixed = fixed_end_of(m, p, floating);
  if (fixed == nullptr) return {};
  const JointDescription *other = &m.joints[static_cast<std::size_t>(floating)], *first = other - 1;
  const double span = (other->point - first->point).norm(), own = p.clearance[c].sleeve_length;
  if (span >= 0.5 * (fixed->sleeve_length + own) * (1.0 - kRounding)) return {};
  return ImpossibleNumbers{
      "clearance." + first->name + ".span",
      beside(length(span), {{"sleeve_length", length(fixed->sleeve_length)}, {"floating.sleeve_length", length(own)}}),
      kSleevesApart};
}

std::optional<ImpossibleNumbers> impossible_alone(const MechanismDescription& m, const ClearanceDescription& d,
                                                  const ClearanceParameters& p) {
  if (auto sizes = impossible_sizes(m, d, p)) return sizes;
  if (auto expected = refused_restitution(d.contact_law, d.dissipation_law, p.contact.restitution))
    return ImpossibleNumbers{"contact.restitution", number(p.contact.restitution), *expected};
  return impossible_friction(p.friction);
}

}  // namespace

std::optional<std::string> refused_restitution(const std::string& law, const std::string& dissipation,
                                               double restitution) {
  if (restitution >= kLeastRestitution) return {};
  const NormalLawEntry& entry = normal_law(dissipation.empty() ? law : dissipation);
  if (entry.damping_factor == nullptr || entry.lowest_restitution < 0.0) return {};
  std::string others;
  for (const NormalLawEntry& other : normal_laws())
    if (other.geometry == ContactGeometry::point && other.damping_factor != nullptr && other.lowest_restitution < 0.0 &&
        other.damping_factor(0.0) > 0.0)
      others += (others.empty() ? "" : ", ") + std::string(other.name);
  char least[40];
  std::snprintf(least, sizeof least, "%g", kLeastRestitution);
  return std::string("a number from ") + least + " to 1 with law = \"" + entry.name +
         "\", whose damping grows without bound towards 0; laws that take 0: " + others;
}

std::optional<ImpossibleNumbers> impossible_numbers(const MechanismDescription& mechanism,
                                                    const Parameters& parameters) {
  for (std::size_t c = 0; c < mechanism.clearances.size(); ++c) {
    const ClearanceDescription& d = mechanism.clearances[c];
    if (auto impossible = impossible_alone(mechanism, d, parameters.clearance[c])) {
      impossible->path =
          "clearance." + mechanism.joints[static_cast<std::size_t>(d.joint)].name + "." + impossible->path;
      return impossible;
    }
    if (auto impossible = impossible_pair(mechanism, parameters, c)) return impossible;
  }
  return {};
}

}  // namespace boresight
