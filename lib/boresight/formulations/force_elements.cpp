#include "boresight/formulations/force_elements.hpp"

#include <cmath>

#include "boresight/mechanism/joint_rows.hpp"

namespace boresight {
namespace {

const BodyMotion kUnmovedGround;

const BodyMotion& motion_of(const std::vector<BodyMotion>& bodies, int body) {
  return body == kGround ? kUnmovedGround : bodies[body];
}

Vec3 in_body(const MechanismDescription& m, int body, const Vec3& point) {
  return body == kGround ? point : Vec3(m.bodies[body].axes.transpose() * (point - m.bodies[body].center_of_mass));
}

// Force at a point r from the body's centre of mass, world axes.
void push(std::vector<Vec6>& wrench, int body, const Vec3& force, const Vec3& r) {
  if (body == kGround) return;
  wrench[body].head<3>() += force;
  wrench[body].tail<3>() += r.cross(force);
}

}  // namespace

ForceElements::ForceElements(const Mechanism& mechanism, const Parameters& parameters, bool with_clearance)
    : mechanism_(mechanism) {
  const MechanismDescription& m = mechanism.description();
  for (std::size_t c = 0; with_clearance && c < m.clearances.size(); ++c) {
    const ClearanceDescription& d = m.clearances[c];
    const JointGeometry& g = mechanism.geometry(d.joint);
    const bool journal_first = d.journal == m.joints[d.joint].first;
    joints_.push_back({JointPlay(d, m.joints[d.joint].type, parameters.clearance[c]),
                       journal_first ? g.second : g.first,
                       journal_first ? g.first : g.second,
                       {},
                       {}});
  }
  for (std::size_t s = 0; s < m.springs.size(); ++s) {
    const SpringDescription& d = m.springs[s];
    springs_.push_back({d.first, d.second, in_body(m, d.first, d.first_point), in_body(m, d.second, d.second_point),
                        parameters.spring[s]});
  }
  for (const LoadDescription& d : m.loads) load_point_.push_back(in_body(m, d.body, d.point));
}

PlayMotion<double> ForceElements::play_motion(int clearance, const std::vector<BodyMotion>& bodies) const {
  const Joint& joint = joints_[clearance];
  const BodyMotion& S = motion_of(bodies, joint.sleeve.body);
  const BodyMotion& J = motion_of(bodies, joint.journal.body);
  const Mat3 R_WS = S.R * joint.sleeve.R;
  const Vec3 rS = S.R * joint.sleeve.p, rJ = J.R * joint.journal.p;
  const Vec3 d = J.p + rJ - S.p - rS;
  const Vec3 d_dot = J.v + J.w.cross(rJ) - S.v - S.w.cross(rS) - S.w.cross(d);
  PlayMotion<double> motion{R_WS.transpose() * d, R_WS.transpose() * d_dot, R_WS.transpose() * (J.w - S.w)};
  const MotionInputs inputs = joint.law.inputs();
  const bool tilting =
      inputs == MotionInputs::tilting || inputs == MotionInputs::rolling || inputs == MotionInputs::twisting;
  if (tilting) {
    const Mat3 R_SJ = R_WS.transpose() * (J.R * joint.journal.R);
    const Vec3 a = R_SJ.col(1), a_dot = motion.w.cross(a);
    motion.slope << a.x() / a.y(), a.z() / a.y();
    motion.slope_rate << (a_dot.x() - motion.slope[0] * a_dot.y()) / a.y(),
        (a_dot.z() - motion.slope[1] * a_dot.y()) / a.y();
    if (inputs == MotionInputs::rolling) motion.roll = twist_about_y(R_SJ);
    if (inputs == MotionInputs::twisting) motion.twist = direction_of_twist(R_SJ);
  }
  return motion;
}

void ForceElements::load(Joint& joint, const PlayOffsets& held) const {
  joint.wrench.force = held.head<3>();
  joint.wrench.moment = joint.motion.e.cross(joint.wrench.force) + moment_of_couple(held[3], held[4], joint.motion) +
                        held[5] * roll_axis(joint.motion);
}

void ForceElements::apply(double t, const std::vector<BodyMotion>& bodies, const std::vector<ContactMemory>& memory,
                          std::vector<Vec6>& wrench) {
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    Joint& joint = joints_[c];
    joint.motion = play_motion(static_cast<int>(c), bodies);
    if (hold_)
      ;  // the last wrench
    else if (held_.empty() && joint.law.sticks)
      joint.law.wrench(joint.motion, memory[c].impact_speed, memory[c].bristle, joint.wrench, joint.bristle_rate,
                       memory[c].largest_bristle_rate);
    else if (held_.empty())
      joint.law.wrench(joint.motion, memory[c].impact_speed, joint.wrench);
    else
      load(joint, held_[c]);
    const BodyMotion& S = motion_of(bodies, joint.sleeve.body);
    const BodyMotion& J = motion_of(bodies, joint.journal.body);
    const Mat3 R_WS = S.R * joint.sleeve.R;
    const Vec3 rS = S.R * joint.sleeve.p;
    const Vec3 force = R_WS * joint.wrench.force, moment = R_WS * joint.wrench.moment;
    push(wrench, joint.sleeve.body, -force, rS);
    push(wrench, joint.journal.body, force, S.p + rS - J.p);
    if (joint.sleeve.body != kGround) wrench[joint.sleeve.body].tail<3>() -= moment;
    if (joint.journal.body != kGround) wrench[joint.journal.body].tail<3>() += moment;
  }
  for (const Spring& s : springs_) {
    const BodyMotion& A = motion_of(bodies, s.first);
    const BodyMotion& B = motion_of(bodies, s.second);
    const Vec3 rA = A.R * s.p_first, rB = B.R * s.p_second;
    const Vec3 d = B.p + rB - A.p - rA;
    const double length = d.norm();
    if (length <= 0.0) continue;  // its ends coincide: no direction to pull in
    const Vec3 u = d / length;
    const double speed = u.dot(B.v + B.w.cross(rB) - A.v - A.w.cross(rA));
    const Vec3 pull = s.law.pull(length, speed) * u;
    push(wrench, s.first, pull, rA);
    push(wrench, s.second, -pull, rB);
  }
  const std::vector<LoadDescription>& loads = mechanism_.description().loads;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const LoadDescription& load = loads[k];
    if (load.joint) {
      const JointGeometry& g = mechanism_.geometry(*load.joint);
      const BodyMotion& A = motion_of(bodies, g.first.body);
      const BodyMotion& B = motion_of(bodies, g.second.body);
      const Vec3 along = (A.R * g.first.R).col(1) * load.along_joint->at(t).value;
      if (mechanism_.description().joints[*load.joint].type == JointType::prismatic) {
        push(wrench, g.second.body, along, B.R * g.second.p);
        push(wrench, g.first.body, -along, B.p + B.R * g.second.p - A.p);
      } else {
        if (g.second.body != kGround) wrench[g.second.body].tail<3>() += along;
        if (g.first.body != kGround) wrench[g.first.body].tail<3>() -= along;
      }
    } else {
      const Vec3 force(load.force[0]->at(t).value, load.force[1]->at(t).value, load.force[2]->at(t).value);
      push(wrench, load.body, force, motion_of(bodies, load.body).R * load_point_[k]);
    }
  }
}

double ForceElements::elastic_energy(const std::vector<BodyMotion>& bodies) const {
  double energy = 0.0;
  for (std::size_t c = 0; c < joints_.size(); ++c)
    energy += joints_[c].law.elastic_energy(play_motion(static_cast<int>(c), bodies));
  for (const Spring& s : springs_) {
    const BodyMotion& A = motion_of(bodies, s.first);
    const BodyMotion& B = motion_of(bodies, s.second);
    const double stretch = (B.p + B.R * s.p_second - A.p - A.R * s.p_first).norm() - s.law.free_length;
    energy += (0.5 * s.law.stiffness * stretch - s.law.preload) * stretch;
  }
  return energy;
}

}  // namespace boresight
