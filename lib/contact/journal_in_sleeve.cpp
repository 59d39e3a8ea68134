#include "boresight/contact/journal_in_sleeve.hpp"

#include "boresight/contact/hertz.hpp"

namespace boresight {

JournalInSleeve::JournalInSleeve(const ClearanceDescription& description, JointType joint, const ClearanceParameters& p)
    : radial_clearance(p.radial),
      axial_clearance(p.axial),
      bore_radius(p.journal_radius + p.radial),
      half_length(0.5 * p.sleeve_length),
      has_faces(joint == JointType::revolute),
      radial_law{radial_hertz_stiffness(p), normal_law(description.contact_law).damping_factor(p.contact.restitution)},
      face_stiffness(joint == JointType::revolute ? end_face_stiffness(p) : 0.0),
      friction{description.friction_law == "none" ? 0.0 : p.friction.coefficient, p.friction.static_speed,
               p.friction.dynamic_speed},
      minimum_impact_speed(p.contact.minimum_impact_speed),
      validity_speed(boresight::validity_speed(p.contact)) {}

std::vector<ContactPlace> JournalInSleeve::places() const {
  if (!has_faces) return {ContactPlace::radial};
  return {ContactPlace::radial, ContactPlace::axial_minus, ContactPlace::axial_plus};
}

}  // namespace boresight
