#include "boresight/play/pad/pad_in_slot.hpp"

#include <cmath>

#include "boresight/contact/hertz.hpp"
#include "boresight/play/elastic_part.hpp"
#include "boresight/play/journal/ring_tangent.hpp"

namespace boresight {
namespace {

// A law for points lends its damping; a spring is a spring.
NormalLaw law_of(const ClearanceDescription& description, const ClearanceParameters& p) {
  const NormalLawEntry& entry = normal_law(description.contact_law);
  NormalLaw law;
  if (entry.elastic != nullptr) law = entry.elastic(p);
  law.curve = ElasticCurve::linear;
  if (entry.geometry != ContactGeometry::linear) law.stiffness = pad_stiffness(p);
  if (entry.damping_factor != nullptr) law.damping_factor = entry.damping_factor(p.contact.restitution);
  return law;
}

}  // namespace

PadInSlot::PadInSlot(const ClearanceDescription& description, JointType, const ClearanceParameters& p) {
  clearance = p.axial;
  radius = p.pad_radius;
  law = law_of(description, p);
  friction = make_friction_law(description.friction_law, p.friction);
  tilts = description.axes == JournalAxes::free;
}

double PadInSlot::elastic_energy(const PlayMotion<double>& motion) const {
  double energy = 0.0;
  for (const int side : {-1, 1}) {
    const Face<double> on = face(motion, side);
    energy += ring_contact(law.stiffness, on.depth, on.swing).energy;
  }
  return energy;
}

PadInSlot PadInSlot::elastic_only() const {
  PadInSlot elastic = *this;
  keep_elastic(elastic.law);
  keep_elastic(elastic.friction);
  return elastic;
}

ContactTangent PadInSlot::tangent(const PlayMotion<double>& motion) const {
  ContactTangent tangent;
  for (const int side : {-1, 1}) {
    const Face<double> on = face(motion, side);
    const double penetration = on.depth + on.swing;
    if (!(penetration > 0.0)) continue;
    if (tilts) {
      add_ring_tangent(law.stiffness, radius, penetration, motion.slope, side, place_of(side), tangent);
    } else {
      PlayOffsets n = PlayOffsets::Zero();
      n[1] = side * std::sqrt(law.stiffness);
      tangent.add(place_of(side), n);
    }
  }
  return tangent;
}

// A line along the normal; where the pad tilts, |e_y| + R |sigma| <= c.
std::vector<GapPart> PadInSlot::gap_parts(const RestingPlay& rest, const JointCoordinates&) const {
  GapPart part{.offset = Eigen::Matrix<double, kMostOffsets, 3>::Zero(), .radial = 0.0, .axial = rest.axial_reach};
  part.offset(1, 1) = 1.0;
  if (tilts) {
    part.offset(3, 0) = part.offset(4, 2) = 1.0 / radius;
    part.radial = part.axial;
    part.shape = GapPart::Shape::double_cone;
  }
  return {part};
}

PlayOffsets PadInSlot::widths(double other) const {
  const double gap = clearance > 0.0 ? clearance : other, slope = tilts ? gap / radius : 1.0;
  PlayOffsets width;
  width << other, gap, other, slope, slope, 1.0;
  return width;
}

PlayOffsets PadInSlot::root_stiffness(double) const {
  PlayOffsets root = PlayOffsets::Zero();
  root[1] = std::sqrt(law.stiffness);
  if (tilts) root.segment<2>(3).setConstant(std::sqrt(0.5 * law.stiffness) * radius);
  return root;
}

}  // namespace boresight
