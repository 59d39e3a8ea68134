#include "boresight/play/journal/journal_in_sleeve.hpp"

#include <cmath>

#include "boresight/contact/hertz.hpp"
#include "boresight/play/elastic_part.hpp"

namespace boresight {

JournalInSleeve::JournalInSleeve(const ClearanceDescription& description, JointType joint,
                                 const ClearanceParameters& p) {
  radial_clearance = p.radial;
  axial_clearance = p.axial;
  bore_radius = p.journal_radius + p.radial;
  half_length = 0.5 * p.sleeve_length;
  has_faces = joint == JointType::revolute;
  radial_law = make_normal_law(description.contact_law, description.dissipation_law, p);
  face_stiffness = has_faces ? end_face_stiffness(p) : 0.0;
  friction = make_friction_law(description.friction_law, p.friction);
  tilts = description.axes == JournalAxes::free;
  tilted.radial_clearance = radial_clearance;
  tilted.axial_clearance = axial_clearance;
  tilted.bore_radius = bore_radius;
  tilted.half_length = half_length;
  tilted.ring_radius = 0.5 * (bore_radius + p.cap_radius);
  tilted.has_faces = has_faces;
  tilted.slides = slides_along_axis(joint);
  tilted.end_law = radial_law.half();
  tilted.face_stiffness = face_stiffness;
  tilted.friction = friction;
}

std::vector<ContactPlace> JournalInSleeve::places() const {
  if (tilts && !has_faces) return {ContactPlace::radial_minus, ContactPlace::radial_plus};
  if (tilts)
    return {ContactPlace::radial_minus, ContactPlace::radial_plus, ContactPlace::axial_minus, ContactPlace::axial_plus};
  if (!has_faces) return {ContactPlace::radial};
  return {ContactPlace::radial, ContactPlace::axial_minus, ContactPlace::axial_plus};
}

double JournalInSleeve::elastic_energy(const PlayMotion<double>& motion) const {
  if (tilts) return tilted.elastic_energy(motion);
  ContactStates<double> contact;
  penetrations(motion, contact);
  double energy = 0.0;
  const double radial = contact[static_cast<int>(ContactPlace::radial)].penetration;
  if (radial > 0.0) energy += radial_law.elastic_energy(radial);
  for (ContactPlace place : {ContactPlace::axial_minus, ContactPlace::axial_plus}) {
    const double d = contact[static_cast<int>(place)].penetration;
    if (d > 0.0) energy += 0.5 * face_stiffness * d * d;
  }
  return energy;
}

JournalInSleeve JournalInSleeve::elastic_only() const {
  JournalInSleeve elastic = *this;
  for (NormalLaw* law : {&elastic.radial_law, &elastic.tilted.end_law}) keep_elastic(*law);
  for (FrictionLaw* law : {&elastic.friction, &elastic.tilted.friction}) keep_elastic(*law);
  return elastic;
}

std::vector<double> JournalInSleeve::clearances() const {
  if (has_faces) return {radial_clearance, axial_clearance};
  return {radial_clearance};
}

PlayOffsets JournalInSleeve::widths(double other) const {
  const double radial = radial_clearance > 0.0 ? radial_clearance : other,
               axial = axial_clearance > 0.0 ? axial_clearance : other;
  const double slope = tilts ? radial / half_length : 1.0;
  PlayOffsets width;
  width << radial, axial, radial, slope, slope, 1.0;
  return width;
}

// Both ends of a tilting journal at half the stiffness each, half a sleeve's length from its centre; and a face in full contact,
// whose ring resists tilts by K_c R^2 / 2 (ring_contact.hpp).
PlayOffsets JournalInSleeve::root_stiffness(double load) const {
  const double deepest = radial_law.depth_under(2.0 * load);
  const double radial = deepest > 0.0 ? radial_law.elastic_slope(deepest) : 0.0;
  PlayOffsets root = PlayOffsets::Zero();
  root.head<3>() << std::sqrt(radial), std::sqrt(face_stiffness), std::sqrt(radial);
  if (tilts) {
    const double ends = radial * half_length * half_length;
    const double ring = has_faces ? 0.5 * face_stiffness * tilted.ring_radius * tilted.ring_radius : 0.0;
    root.segment<2>(3).setConstant(std::sqrt(ends + ring));
  }
  return root;
}

// A journal's gap: a cylinder of centre offsets where axes are parallel; where it tilts, a disc at each end of the sleeve and the
// axial play.
std::vector<GapPart> JournalInSleeve::gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const {
  std::vector<GapPart> parts;
  Eigen::Matrix<double, kMostOffsets, 3> offset = Eigen::Matrix<double, kMostOffsets, 3>::Zero();
  if (!tilts) {
    offset.topRows<3>().setIdentity();
    return {{offset, rest.radial_reach[0], rest.axial_reach}};
  }
  // Centre e = (rho+ + rho-) / 2 + e_y sigma, sigma = (rho+ - rho-) / L_b.
  const double length = 2.0 * half_length;
  for (int side : {-1, 1}) {
    offset.setZero();
    offset(0, 0) = offset(2, 2) = 0.5 + side * joint.slide / length;
    offset(3, 0) = offset(4, 2) = side / length;
    parts.push_back({offset, rest.radial_reach[side < 0 ? 0 : 1], 0.0});
  }
  offset.setZero();
  offset(1, 1) = 1.0;
  parts.push_back({offset, 0.0, rest.axial_reach});
  return parts;
}

}  // namespace boresight
