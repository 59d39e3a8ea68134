#include "boresight/rungs/resting_journal.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {
namespace {

using Vec2 = Vec2T<double>;

constexpr int kIterations = 60;

// Depth d0 at which the ring carries `force` under the swing A: between the point where it first touches and even contact.
double ring_depth(double stiffness, double force, double swing) {
  const double even = force / stiffness;
  if (even >= swing) return even;
  double low = -swing, high = swing;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (ring_contact(stiffness, middle, swing).force < force ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Vec2 rest_along(const Vec2& force, double clearance, const NormalLaw& law, double& reach) {
  const double size = force.norm();
  reach = clearance + law.depth_under(size);
  return size > 0.0 ? Vec2(reach / size * force) : Vec2(Vec2::Zero());
}

void rest_parallel(const JournalInSleeve& joint, const Vec3& load, const Rest& before, Rest& rest) {
  Vec3& e = rest.motion.e;
  const Vec2 radial(load.x(), load.z());
  const Vec2 at = rest_along(radial, joint.radial_clearance, joint.radial_law, rest.radial_reach[0]);
  rest.radial_reach[1] = rest.radial_reach[0];
  e << at.x(), 0.0, at.y();
  double axial_force = 0.0;
  if (joint.has_faces) {
    const double along = std::abs(load.y());
    rest.axial_reach = joint.axial_clearance + along / joint.face_stiffness;
    const bool slips = along > joint.friction.stiction * radial.norm();
    axial_force = slips ? along : 0.0;
    e.y() = slips ? std::copysign(rest.axial_reach, load.y())
                  : std::clamp(before.motion.e.y(), -joint.axial_clearance, joint.axial_clearance);
  }
  joint.gaps(rest.motion, rest.contact);
  rest.contact[static_cast<int>(ContactPlace::radial)].normal_force = radial.norm();
  rest.contact[static_cast<int>(e.y() > 0.0 ? ContactPlace::axial_minus : ContactPlace::axial_plus)].normal_force = axial_force;
}

void rest_tilted(const JournalInSleeve& joint, const Eigen::Matrix<double, 5, 1>& load, double slide, const Rest& before,
                 Rest& rest) {
  const TiltedJournal& t = joint.tilted;
  JournalMotion<double>& m = rest.motion;
  const Vec2 radial(load[0], load[2]), couple = load.tail<2>();
  const double length = 2.0 * t.half_length;
  const int side = load[1] > 0.0 ? -1 : 1;  // the face that an axial load presses
  m.e.y() = slide;
  const double reach_shift = t.slides ? slide : 0.0;
  double axial_force = 0.0;
  Vec2 ring_couple = Vec2::Zero(), ends[2];
  for (int k = 0; k < kIterations; ++k) {
    const Vec2 difference = 2.0 * (couple + ring_couple + reach_shift * radial) / length;
    ends[0] = 0.5 * (radial - difference);
    ends[1] = 0.5 * (radial + difference);
    const Vec2 minus = rest_along(ends[0], t.radial_clearance, t.end_law, rest.radial_reach[0]);
    const Vec2 plus = rest_along(ends[1], t.radial_clearance, t.end_law, rest.radial_reach[1]);
    m.slope = (plus - minus) / length;
    const Vec2 centre = 0.5 * (plus + minus) + reach_shift * m.slope;
    m.e.x() = centre.x();
    m.e.z() = centre.y();
    if (!t.has_faces) break;
    const double along = std::abs(load[1]), tilt = m.slope.norm(), swing = t.ring_radius * tilt;
    const double room = std::max(0.0, t.axial_clearance - swing);
    if (along <= t.friction.stiction * (ends[0].norm() + ends[1].norm())) {
      axial_force = 0.0;
      rest.axial_reach = t.axial_clearance;
      m.e.y() = std::clamp(before.motion.e.y(), -room, room);
      if (k > 0 && ring_couple.isZero()) break;
      ring_couple *= 0.5;
      continue;
    }
    axial_force = along;
    const double depth = ring_depth(t.face_stiffness, along, swing);
    m.e.y() = -side * (depth + t.axial_clearance);
    rest.axial_reach = t.axial_clearance + std::max(depth, along / t.face_stiffness);
    const double arm = t.ring_radius * ring_contact(t.face_stiffness, depth, swing).moment_arm;
    const Vec2 next = tilt > 0.0 ? Vec2(-along * arm / tilt * m.slope) : Vec2(Vec2::Zero());
    const double change = (next - ring_couple).norm();
    ring_couple += 0.5 * (next - ring_couple);
    if (change <= 1e-9 * (couple.norm() + along * t.ring_radius)) break;
  }
  joint.gaps(m, rest.contact);
  for (int end : {0, 1}) rest.contact[static_cast<int>(TiltedJournal::radial_place(end == 0 ? -1 : 1))].normal_force = ends[end].norm();
  if (t.has_faces) rest.contact[static_cast<int>(TiltedJournal::axial_place(side))].normal_force = axial_force;
}

}  // namespace

double Rest::normal_force() const {
  double sum = 0.0;
  for (const ContactState<double>& c : contact) sum += c.normal_force;
  return sum;
}

double Rest::penetration() const {
  double deepest = 0.0;
  for (const ContactState<double>& c : contact)
    if (c.normal_force > 0.0) deepest = std::max(deepest, c.penetration);
  return deepest;
}

Rest rest_under(const JournalInSleeve& joint, const Eigen::Matrix<double, 5, 1>& load, double slide, const Rest& before) {
  Rest rest;
  if (joint.tilts)
    rest_tilted(joint, load, slide, before, rest);
  else
    rest_parallel(joint, load.head<3>(), before, rest);
  return rest;
}

}  // namespace boresight
