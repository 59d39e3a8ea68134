#include "boresight/contact/journal_in_sleeve.hpp"

#include "boresight/contact/hertz.hpp"

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
  sticks = friction.kind == FrictionKind::lugre && friction.stiction > 0.0;
  lugre = {friction.coefficient,         friction.stiction,          friction.stribeck_speed, friction.dynamic_speed,
           p.friction.bristle_stiffness, p.friction.bristle_damping, p.friction.viscosity};
  minimum_impact_speed = p.contact.minimum_impact_speed;
  validity_speed = boresight::validity_speed(p.contact);
  tilts = description.axes == JournalAxes::free;
  tilted.radial_clearance = radial_clearance;
  tilted.axial_clearance = axial_clearance;
  tilted.bore_radius = bore_radius;
  tilted.half_length = half_length;
  tilted.ring_radius = 0.5 * (bore_radius + p.cap_radius);
  tilted.has_faces = has_faces;
  tilted.slides = joint == JointType::cylindrical;
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

double JournalInSleeve::elastic_energy(const JournalMotion<double>& motion) const {
  if (tilts) return tilted.elastic_energy(motion);
  std::array<ContactState<double>, kContactPlaces> contact;
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

std::vector<JournalInSleeve> clearance_joints(const MechanismDescription& mechanism, const Parameters& parameters) {
  std::vector<JournalInSleeve> joints;
  for (std::size_t c = 0; c < mechanism.clearances.size(); ++c) {
    const ClearanceDescription& clearance = mechanism.clearances[c];
    joints.emplace_back(clearance, mechanism.joints[clearance.joint].type, parameters.clearance[c]);
  }
  return joints;
}

}  // namespace boresight
