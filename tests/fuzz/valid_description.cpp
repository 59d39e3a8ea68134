#include "valid_description.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <set>

#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace {

bool finite(const TimeFunctionPtr& f, double duration) {
  if (!f) return false;
  for (const double part : {0.0, 0.25, 0.5, 1.0}) {
    const TimeValue v = f->at(part * duration);
    if (!std::isfinite(v.value) || !std::isfinite(v.rate) || !std::isfinite(v.acceleration)) return false;
  }
  return true;
}

bool is_unit(const Vec3& v) { return std::abs(v.norm() - 1.0) < 1e-12; }

bool can_turn_or_slide(JointType type) { return type == JointType::revolute || type == JointType::prismatic; }

std::string fault_of_body(const BodyDescription& body) {
  if (body.name.empty() || body.name == "ground") return "body name";
  if (!std::isfinite(body.mass) || body.mass <= 0.0) return "body mass";
  if (!body.center_of_mass.allFinite()) return "centre of mass";
  if (!((body.axes.transpose() * body.axes - Mat3::Identity()).norm() < 1e-12) || body.axes.determinant() < 0.0)
    return "body axes";
  if (!body.inertia.allFinite() || body.inertia != body.inertia.transpose()) return "inertia";
  const Mat3 scaled = body.inertia / body.inertia.cwiseAbs().maxCoeff();
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(scaled).eigenvalues();
  if (!(principal[0] > 0.0) || principal[0] + principal[1] < principal[2] * (1 - 1e-6)) return "principal moments";
  if (body.boresight && !is_unit(*body.boresight)) return "boresight";
  return "";
}

std::string fault_of_clearance(const MechanismDescription& m, const ClearanceDescription& c) {
  if (c.joint < 0 || c.joint >= static_cast<int>(m.joints.size())) return "clearance joint";
  const JointDescription& joint = m.joints[c.joint];
  if (!can_have_play(joint.type)) return "clearance joint type";
  if (c.journal != joint.first && c.journal != joint.second) return "journal";
  const ClearanceParameters& p = c.parameters;
  for (const double x : {p.radial,
                         p.axial,
                         p.journal_radius,
                         p.cap_radius,
                         p.sleeve_length,
                         p.contact.restitution,
                         p.contact.young[0],
                         p.contact.young[1],
                         p.contact.poisson[0],
                         p.contact.poisson[1],
                         p.contact.density,
                         p.contact.minimum_impact_speed,
                         p.contact.stiffness_scale,
                         p.friction.coefficient,
                         p.friction.static_speed,
                         p.friction.dynamic_speed,
                         p.contact.linear_stiffness,
                         p.contact.linear_damping,
                         p.friction.static_coefficient,
                         p.friction.stribeck_speed,
                         p.friction.bristle_stiffness,
                         p.friction.bristle_damping,
                         p.friction.viscosity}) {
    if (!std::isfinite(x) || x < 0.0) return "clearance number";
  }
  const bool pad = joint.type == JointType::planar, ball = joint.type == JointType::spherical;
  const bool slider = c.guide == GuideShape::rectangular;
  if (slider && !(joint.type == JointType::prismatic && 2.0 * p.width_gap < p.width && 2.0 * p.height_gap < p.height &&
                  p.length > 0.0 && std::abs(c.width_direction.norm() - 1.0) < 1e-9))
    return "slider";
  const bool corners = c.pad == PadShape::rectangular;
  if (corners && !(pad && p.width > 0.0 && p.length > 0.0 && std::abs(c.width_direction.norm() - 1.0) < 1e-9))
    return "rectangular pad";
  if (slider || corners ? false : pad ? !(p.pad_radius > 0.0) : !(p.radial > 0.0 && p.journal_radius > 0.0))
    return "radii";
  if (joint.type == JointType::revolute && !(p.cap_radius > p.journal_radius + p.radial && p.sleeve_length > 0.0))
    return "caps";
  if (c.axes == JournalAxes::free && !pad && !ball && !slider && p.sleeve_length <= 0.0) return "sleeve length";
  if (p.contact.restitution < 0.0 || p.contact.restitution > 1.0) return "restitution";
  const NormalLaw law = JointPlay(c, joint.type, p).normal_law();
  if (!std::isfinite(law.stiffness) || !(law.stiffness > 0.0) || !std::isfinite(law.damping_factor))
    return "contact law";
  for (int k = 0; k < 2; ++k) {
    if (p.contact.young[k] <= 0.0 || p.contact.poisson[k] >= 0.5) return "material";
  }
  if (p.contact.density <= 0.0 || p.contact.minimum_impact_speed <= 0.0 || p.contact.stiffness_scale <= 0.0)
    return "contact";
  if (p.friction.dynamic_speed <= p.friction.static_speed) return "friction speeds";
  return "";
}

std::string fault_of_motion(const MechanismDescription& m) {
  const double duration = m.motion.duration;
  if (!std::isfinite(duration) || duration <= 0.0) return "duration";
  if (m.motion.pose && !m.motion.drives.empty()) return "pose and drives";
  if (m.motion.pose) {
    if (m.motion.pose->body < 0 || m.motion.pose->body >= static_cast<int>(m.bodies.size())) return "pose body";
    for (int k = 0; k < 3; ++k) {
      if (!finite(m.motion.pose->angle[k], duration) || !finite(m.motion.pose->position[k], duration))
        return "pose law";
      const int axis = m.motion.pose->sequence[k];
      if (axis < 0 || axis > 2 || (k > 0 && axis == m.motion.pose->sequence[k - 1])) return "sequence";
    }
  }
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const bool has_law = m.motion.drives.count(static_cast<int>(j)) != 0;
    if (!m.motion.pose && m.joints[j].driven != has_law) return "drive law";
  }
  for (const auto& [joint, law] : m.motion.drives) {
    if (!finite(law, duration)) return "drive of joint " + std::to_string(joint);
  }
  return "";
}

}  // namespace

std::string fault_of(const MechanismDescription& m) {
  const int bodies = static_cast<int>(m.bodies.size()), joints = static_cast<int>(m.joints.size());
  if (!m.gravity.allFinite()) return "gravity";
  std::set<std::string> body_names, joint_names;
  int boresights = 0;
  for (const BodyDescription& body : m.bodies) {
    if (const std::string fault = fault_of_body(body); !fault.empty()) return fault;
    if (!body_names.insert(body.name).second) return "body name twice";
    boresights += body.boresight.has_value();
  }
  if (boresights != 1) return "boresights";
  if (m.payload) {
    const PayloadDescription& p = *m.payload;
    if (p.body < 0 || p.body >= bodies || !std::isfinite(p.mass) || p.mass < 0.0) return "payload";
    if (!p.center_of_mass.allFinite() || !p.gyration.allFinite() || p.gyration.minCoeff() < 0.0)
      return "payload vectors";
  }
  for (const JointDescription& joint : m.joints) {
    if (joint.name.empty() || !joint_names.insert(joint.name).second) return "joint name";
    if (joint.first < kGround || joint.first >= bodies || joint.second < kGround || joint.second >= bodies)
      return "joint bodies";
    if (joint.first == joint.second) return "joint within one body";
    if (!joint.point.allFinite() || !is_unit(joint.axis) || !is_unit(joint.second_axis)) return "joint geometry";
    if (joint.type == JointType::universal && std::abs(joint.axis.dot(joint.second_axis)) > 1e-12)
      return "universal axes";
    if (joint.driven && !can_turn_or_slide(joint.type)) return "driven joint";
  }
  std::set<int> with_clearance;
  for (const ClearanceDescription& clearance : m.clearances) {
    if (const std::string fault = fault_of_clearance(m, clearance); !fault.empty()) return fault;
    if (!with_clearance.insert(clearance.joint).second) return "two clearances in one joint";
  }
  if (const std::string fault = fault_of_motion(m); !fault.empty()) return fault;
  for (const SpringDescription& spring : m.springs) {
    if (spring.first == spring.second || spring.first >= bodies || spring.second >= bodies) return "spring bodies";
    if (!spring.first_point.allFinite() || !spring.second_point.allFinite()) return "spring points";
    const SpringParameters& p = spring.parameters;
    for (const double x : {p.stiffness, p.damping, p.free_length, p.preload}) {
      if (!std::isfinite(x) || x < 0.0) return "spring number";
    }
  }
  for (const LoadDescription& load : m.loads) {
    if (load.joint) {
      if (*load.joint < 0 || *load.joint >= joints || !can_turn_or_slide(m.joints[*load.joint].type))
        return "load joint";
      if (!finite(load.along_joint, m.motion.duration)) return "load law";
    } else {
      if (load.body < 0 || load.body >= bodies || !load.point.allFinite()) return "load body";
      for (const auto& force : load.force) {
        if (!finite(force, m.motion.duration)) return "load force";
      }
    }
  }
  for (const InitialRateDescription& rate : m.initial_rates) {
    if (rate.joint < 0 || rate.joint >= joints || m.joints[rate.joint].driven || !std::isfinite(rate.rate))
      return "initial rate";
  }
  if (m.content_hash.size() != 32) return "content hash";
  return "";
}

}  // namespace boresight
