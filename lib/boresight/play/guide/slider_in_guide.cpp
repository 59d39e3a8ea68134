#include "boresight/play/guide/slider_in_guide.hpp"

#include <cmath>

#include "boresight/play/elastic_part.hpp"
#include "boresight/play/flat_face_stiffness.hpp"

namespace boresight {

// A law for points lends its damping; a spring is a spring, the same on every face.
SliderInGuide::SliderInGuide(const ClearanceDescription& description, JointType, const ClearanceParameters& p) {
  gap = {p.width_gap, p.height_gap};
  half = {0.5 * p.width, 0.5 * p.height};
  half_length = 0.5 * p.length;
  const NormalLawEntry& entry = boresight::normal_law(description.contact_law);
  if (entry.geometry == ContactGeometry::linear) {
    const NormalLaw spring = entry.elastic(p);
    stiffness = {spring.stiffness, spring.stiffness};
    dashpot = spring.dashpot;
  } else {
    stiffness = {flat_face_stiffness(p.contact, p.length, p.height), flat_face_stiffness(p.contact, p.length, p.width)};
  }
  if (entry.damping_factor != nullptr) damping_factor = entry.damping_factor(p.contact.restitution);
  friction = make_friction_law(description.friction_law, p.friction);
  tilts = description.axes == JournalAxes::free;
  law.curve = ElasticCurve::linear;
  law.stiffness = std::min(stiffness[0], stiffness[1]);
  law.damping_factor = damping_factor;
  law.dashpot = dashpot;
}

std::vector<ContactPlace> SliderInGuide::places() const {
  std::vector<ContactPlace> all;
  each_contact([&](int across, int side, int end) { all.push_back(place_of(across, side, end)); });
  return all;
}

double SliderInGuide::elastic_energy(const PlayMotion<double>& motion) const {
  double energy = 0.0;
  each_contact([&](int across, int side, int end) {
    const Edge<double> on = edge(motion, across, side, end);
    energy += edge_contact((tilts ? 0.5 : 1.0) * stiffness[across], on.depth, on.swing).energy;
  });
  return energy;
}

PlayOffsets SliderInGuide::elastic_force(const PlayMotion<double>& motion) const {
  PlayOffsets force = PlayOffsets::Zero();
  each_contact([&](int across, int side, int end) {
    const Edge<double> on = edge(motion, across, side, end);
    const EdgeForce<double> pressed = edge_contact((tilts ? 0.5 : 1.0) * stiffness[across], on.depth, on.swing);
    force[2 * across] -= side * pressed.force;
    force[3 + across] -= side * on.reach * pressed.force;
    force[5] -= std::copysign(on.width * pressed.moment_arm, motion.roll) * pressed.force;
  });
  return force;
}

SliderInGuide SliderInGuide::elastic_only() const {
  SliderInGuide elastic = *this;
  keep_elastic(elastic.law);
  keep_elastic(elastic.friction);
  elastic.damping_factor = elastic.dashpot = 0.0;
  return elastic;
}

// The penetration is linear along the touching part of an edge: two points of Gauss's rule give the sum of its stiffness exactly.
ContactTangent SliderInGuide::tangent(const PlayMotion<double>& motion) const {
  ContactTangent tangent;
  each_contact([&](int across, int side, int end) {
    const Edge<double> on = edge(motion, across, side, end);
    if (!(on.depth + on.swing > 0.0)) return;
    const ContactPlace place = place_of(across, side, end);
    PlayOffsets n = PlayOffsets::Zero();
    n[2 * across] = side;
    if (!tilts) {
      tangent.add(place, std::sqrt(stiffness[across]) * n);
      return;
    }
    n[3 + across] = side * on.reach;
    const double part =
        std::min(1.0, on.swing > on.depth ? (on.depth + on.swing) / (2.0 * on.swing) : 1.0);  // of the edge
    for (const double g : {-1.0, 1.0}) {
      const double at = 1.0 - part + g * part / std::sqrt(3.0);  // from 1 - 2 part to 1
      n[5] = std::copysign(on.width, motion.roll) * at;
      tangent.add(place, std::sqrt(0.25 * stiffness[across] * part) * n);
    }
  });
  return tangent;
}

// Lines for each end in each direction, with how deep it is pressed there, and one for the roll as far as both gaps leave it: together no less
// than the room there is, in which a slider that rolls has less of the rest.
std::vector<GapPart> SliderInGuide::gap_parts(const RestingPlay& rest, const JointCoordinates&) const {
  std::vector<GapPart> parts;
  const auto pressed = [&](int across, int end) {
    double deepest = 0.0;
    for (const int side : {-1, 1})
      deepest = std::max(deepest, rest.contact[static_cast<int>(place_of(across, side, end))].penetration);
    return gap[across] + deepest;
  };
  const auto line = [&](double reach) {
    return GapPart{.offset = Eigen::Matrix<double, kMostOffsets, 3>::Zero(), .radial = 0.0, .axial = reach};
  };
  for (const int across : {0, 1})
    for (const int end : {-1, 1}) {
      if (!tilts && end > 0) continue;
      GapPart part = line(pressed(across, tilts ? end : 0));
      // e = (rho+ + rho-) / 2, sigma = (rho+ - rho-) / 2L.
      part.offset(2 * across, 1) = tilts ? 0.5 : 1.0;
      if (tilts) part.offset(3 + across, 1) = 0.5 * end / half_length;
      parts.push_back(part);
    }
  if (!tilts) return parts;
  // Both ends roll alike: the deeper one of each direction.
  const auto roll_room = [&](int across) {
    return std::max(pressed(across, -1), pressed(across, 1)) / half[across == 0 ? 1 : 0];
  };
  GapPart roll = line(std::min(roll_room(0), roll_room(1)) * half_length);
  roll.offset(5, 1) = 1.0 / half_length;
  parts.push_back(roll);
  return parts;
}

PlayOffsets SliderInGuide::widths(double other) const {
  const double x = gap[0] > 0.0 ? gap[0] : other, z = gap[1] > 0.0 ? gap[1] : other;
  PlayOffsets width = PlayOffsets::Ones();
  width.head<3>() << x, other, z;
  if (tilts) width.tail<3>() << x / half_length, z / half_length, std::min(x / half[1], z / half[0]);
  return width;
}

// Both ends at half the stiffness each, and what a face in full contact resists a roll by, K w^2 / 3.
PlayOffsets SliderInGuide::root_stiffness(double) const {
  const double x = std::sqrt(stiffness[0]), z = std::sqrt(stiffness[1]);
  PlayOffsets root = PlayOffsets::Zero();
  root[0] = x;
  root[2] = z;
  if (tilts) root.tail<3>() << x * half_length, z * half_length, std::hypot(x * half[1], z * half[0]) / std::sqrt(3.0);
  return root;
}

}  // namespace boresight
