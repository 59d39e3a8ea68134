#include "boresight/play/pad/rectangular_pad_in_slot.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/play/elastic_part.hpp"
#include "boresight/play/flat_face_stiffness.hpp"
#include "boresight/play/pressed_insert.hpp"

namespace boresight {

// A law for points lends its damping; a spring is a spring.
RectangularPadInSlot::RectangularPadInSlot(const ClearanceDescription& description, JointType,
                                           const ClearanceParameters& p) {
  clearance = p.axial;
  half = {0.5 * p.width, 0.5 * p.length};
  const NormalLawEntry& entry = boresight::normal_law(description.contact_law);
  if (entry.geometry == ContactGeometry::linear) {
    const NormalLaw spring = entry.elastic(p);
    stiffness = spring.stiffness;
    dashpot = spring.dashpot;
  } else {
    stiffness = flat_face_stiffness(p.contact, p.width, p.length);
  }
  if (entry.damping_factor != nullptr) damping_factor = entry.damping_factor(p.contact.restitution);
  friction = make_friction_law(description.friction_law, p.friction);
  tilts = description.axes == JournalAxes::free;
  law.curve = ElasticCurve::linear;
  law.stiffness = stiffness;
  law.damping_factor = damping_factor;
  law.dashpot = dashpot;
}

std::vector<ContactPlace> RectangularPadInSlot::places() const {
  std::vector<ContactPlace> all;
  each_corner([&](int k) { all.push_back(place_of(k)); });
  return all;
}

PlayOffsets RectangularPadInSlot::gradient(const PlayMotion<double>& motion, int k) const {
  const Corner<double> at = corner(motion, k);
  PlayOffsets n = PlayOffsets::Zero();
  n[1] = at.side;
  if (tilts) n.segment<2>(3) << -at.side * at.X, -at.side * at.Z;
  return n;
}

double RectangularPadInSlot::elastic_energy(const PlayMotion<double>& motion) const {
  double energy = 0.0;
  each_corner([&](int k) {
    const double depth = std::max(0.0, corner(motion, k).depth);
    energy += 0.125 * stiffness * depth * depth;
  });
  return energy;
}

PlayOffsets RectangularPadInSlot::elastic_force(const PlayMotion<double>& motion) const {
  PlayOffsets force = PlayOffsets::Zero();
  each_corner([&](int k) { force -= 0.25 * stiffness * std::max(0.0, corner(motion, k).depth) * gradient(motion, k); });
  return force;
}

RectangularPadInSlot RectangularPadInSlot::elastic_only() const {
  RectangularPadInSlot elastic = *this;
  keep_elastic(elastic.law);
  keep_elastic(elastic.friction);
  elastic.damping_factor = elastic.dashpot = 0.0;
  return elastic;
}

ContactTangent RectangularPadInSlot::tangent(const PlayMotion<double>& motion) const {
  ContactTangent tangent;
  each_corner([&](int k) {
    if (corner(motion, k).depth > 0.0) tangent.add(place_of(k), std::sqrt(0.25 * stiffness) * gradient(motion, k));
  });
  return tangent;
}

// |e_y| = c + |F| / K where it keeps parallel; where it tilts, at the least energy. What no force moves stays where it was, in its gap.
RestingPlay RectangularPadInSlot::rest_under(const PlayOffsets& load, const JointCoordinates& joint,
                                             const RestingPlay& before) const {
  RestingPlay rest;
  PlayOffsets pushes = PlayOffsets::Zero(), at = PlayOffsets::Zero();
  pushes[1] = load[1];
  at[1] = before.motion.e.y();
  if (tilts) {
    pushes.segment<2>(3) = load.segment<2>(3);
    at.segment<2>(3) = before.motion.slope;
  }
  const double force = std::abs(load[1]);
  if (pushes.isZero(0.0)) {
    at[1] = std::clamp(at[1], -clearance, clearance);
    // By so much a corner would be in, the pad twisted and not turned back from its tilt.
    double tilt = 0.0;
    const PlayMotion<double> still = at_rest_at(at, joint);
    each_corner([&](int k) {
      const Corner<double> there = corner(still, k);
      tilt = std::max(tilt, there.depth + clearance - there.side * at[1]);
    });
    const double room = clearance - std::abs(at[1]);
    if (tilt > room) at.segment<2>(3) *= room / tilt;
  } else if (tilts) {
    at = PressedInsert(*this, pushes, joint).rest_near(at);
  } else {
    at[1] = std::copysign(clearance + force / stiffness, load[1]);
  }
  rest.motion = at_rest_at(at, joint);
  const RectangularPadInSlot elastic = elastic_only();
  PlayWrench<double> wrench;
  elastic.wrench(rest.motion, kSlowImpacts, SlidingFriction<double>{elastic.friction}, wrench);
  rest.contact = wrench.contact;
  rest.axial_reach = clearance + std::max(force / stiffness, rest.penetration());
  return rest;
}

// A line along the normal; where the pad tilts, |e_y| + w |sigma_1| + l |sigma_2| <= c, the slopes along its width and its length.
std::vector<GapPart> RectangularPadInSlot::gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const {
  GapPart part{.offset = Eigen::Matrix<double, kMostOffsets, 3>::Zero(), .radial = 0.0, .axial = rest.axial_reach};
  part.offset(1, 1) = 1.0;
  if (tilts) {
    const double cosine = joint.twist[0], sine = joint.twist[1];
    part.offset.block<2, 1>(3, 0) << cosine / half[0], -sine / half[0];
    part.offset.block<2, 1>(3, 2) << sine / half[1], cosine / half[1];
    part.radial = part.axial;
    part.shape = GapPart::Shape::octahedron;
  }
  return {part};
}

// However it is twisted, by its longer side.
PlayOffsets RectangularPadInSlot::widths(double other) const {
  const double gap = clearance > 0.0 ? clearance : other, slope = tilts ? gap / lever() : 1.0;
  PlayOffsets width;
  width << other, gap, other, slope, slope, 1.0;
  return width;
}

PlayOffsets RectangularPadInSlot::root_stiffness(double) const {
  PlayOffsets root = PlayOffsets::Zero();
  root[1] = std::sqrt(stiffness);
  if (tilts) root.segment<2>(3).setConstant(std::sqrt(stiffness) * lever());
  return root;
}

}  // namespace boresight
