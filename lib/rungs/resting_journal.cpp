#include "boresight/rungs/resting_journal.hpp"

#include <cmath>

namespace boresight {

Rest rest_under(const JournalInSleeve& joint, const Vec3& reaction, const Rest& before) {
  Rest rest;
  const Vec3 radial(reaction.x(), 0.0, reaction.z());
  rest.radial_force = radial.norm();
  rest.radial_reach = joint.radial_clearance + std::pow(rest.radial_force / joint.radial_law.stiffness, 2.0 / 3.0);
  if (rest.radial_force > 0.0) rest.offset = rest.radial_reach / rest.radial_force * radial;
  if (!joint.has_faces) return rest;
  const double along = std::abs(reaction.y());
  rest.axial_reach = joint.axial_clearance + along / joint.face_stiffness;
  if (along > joint.friction.coefficient * rest.radial_force) {
    rest.axial_force = along;
    rest.offset.y() = std::copysign(rest.axial_reach, reaction.y());
  } else {
    rest.offset.y() = std::clamp(before.offset.y(), -joint.axial_clearance, joint.axial_clearance);
  }
  return rest;
}

}  // namespace boresight
