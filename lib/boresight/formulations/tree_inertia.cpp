#include "boresight/formulations/tree_inertia.hpp"

#include "boresight/formulations/body_energy.hpp"

namespace boresight {

JointSpaceInertia::JointSpaceInertia(const SpanningTree& tree, std::vector<MassProperties> mass, const Vec3& gravity)
    : tree_(tree),
      mass_(std::move(mass)),
      gravity_(gravity),
      carried_(tree.bodies()),
      cholesky_(tree.speed_parent()),
      force_(VecX::Zero(tree.speeds())) {}

// With c from the body's own centre of mass to the combined one, I about the latter, and F, M applied at the former:
//   force = m (a + alpha x c + w x (w x c) - g) - F,   moment = I alpha + w x I w + c x (force + F) - M.
void JointSpaceInertia::single_body(int body, const TreeKinematics& kinematics, const Vec6& applied) {
  const MassProperties& m = mass_[body];
  const BodyMotion& motion = kinematics.bodies()[body];
  const Vec3 a = kinematics.bias()[body].head<3>(), alpha = kinematics.bias()[body].tail<3>();
  const Mat3 I = motion.R * m.inertia * motion.R.transpose();
  Vec3 needed = m.mass * (a - gravity_);
  Vec3 moment = I * alpha + motion.w.cross(I * motion.w);
  const Vec3 arm = motion.p - kinematics.reference(body);
  Vec3 arm_of_mass = arm;
  if (m.c.squaredNorm() > 0.0) {
    const Vec3 c = motion.R * m.c;
    needed += m.mass * (alpha.cross(c) + motion.w.cross(motion.w.cross(c)));
    moment += c.cross(needed);
    arm_of_mass += c;
  }
  Carried& own = carried_[body];
  own.force = needed - applied.head<3>();
  own.moment = moment - applied.tail<3>() + arm.cross(own.force);
  own.mass = m.mass;
  own.first_moment = m.mass * arm_of_mass;
  // Huygens and Steiner: I + m (r^2 1 - r r^T).
  own.inertia.noalias() = I - own.first_moment * arm_of_mass.transpose();
  own.inertia.diagonal().array() += own.first_moment.dot(arm_of_mass);
}

void JointSpaceInertia::evaluate(const TreeKinematics& kinematics, const std::vector<Vec6>& applied) {
  for (int b = 0; b < tree_.bodies(); ++b) single_body(b, kinematics, applied[b]);

  const std::vector<SpeedAxis>& axes = kinematics.axes();
  const std::vector<int>& parent = tree_.speed_parent();
  for (int k = tree_.bodies() - 1; k >= 0; --k) {
    const TreeJoint& t = tree_.joints()[k];
    const Carried& own = carried_[t.body];
    for (int i = t.first_speed + t.speeds - 1; i >= t.first_speed; --i) {
      const SpeedAxis& S = axes[i];
      // Momentum that u_i = 1 gives to what it carries.
      const Vec3 linear = own.mass * S.move + S.turn.cross(own.first_moment);
      const Vec3 angular = own.inertia * S.turn + own.first_moment.cross(S.move);
      for (int j = i; j >= 0; j = parent[j])
        cholesky_.entry(i, j) = axes[j].turn.dot(angular) + axes[j].move.dot(linear);
      force_[i] = -S.turn.dot(own.moment) - S.move.dot(own.force);
    }
    if (t.parent == kGround) continue;
    Carried& parent_body = carried_[t.parent];
    parent_body.mass += own.mass;
    parent_body.first_moment += own.first_moment;
    parent_body.inertia += own.inertia;
    parent_body.force += own.force;
    parent_body.moment += own.moment;
  }
  cholesky_.factor();
}

double JointSpaceInertia::energy(const std::vector<BodyMotion>& bodies) const {
  double sum = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    sum += kinetic_energy(mass_[b], bodies[b]) + potential_energy(mass_[b], bodies[b], gravity_);
  return sum;
}

}  // namespace boresight
