// Mechanisms with every type of joint, loops, open chains and floating bodies, for holding formulations against each other.
#pragma once

#include <cmath>
#include <functional>

#include "boresight/mechanism/description.hpp"
#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight::scenes {

class FunctionOfTime final : public TimeFunction {
 public:
  explicit FunctionOfTime(std::function<TimeValue(double)> f) : f_(std::move(f)) {}
  TimeValue at(double t) const override { return f_(t); }

 private:
  std::function<TimeValue(double)> f_;
};

inline TimeFunctionPtr sine(double amplitude, double frequency) {
  return std::make_shared<FunctionOfTime>([=](double t) {
    const double w = frequency, s = std::sin(w * t), c = std::cos(w * t);
    return TimeValue{amplitude * s, amplitude * w * c, -amplitude * w * w * s};
  });
}

inline int add_body(MechanismDescription& m, const std::string& name, double mass, const Vec3& at, const Vec3& turned) {
  BodyDescription b;
  b.name = name;
  b.mass = mass;
  b.center_of_mass = at;
  if (turned.norm() > 0.0) b.axes = Eigen::AngleAxisd(turned.norm(), turned.normalized()).toRotationMatrix();
  b.inertia = mass * Vec3(0.012, 0.017, 0.021).asDiagonal();
  b.inertia(0, 1) = b.inertia(1, 0) = 0.001 * mass;
  if (m.bodies.empty()) b.boresight = Vec3::UnitZ();
  m.bodies.push_back(b);
  return static_cast<int>(m.bodies.size()) - 1;
}

inline int add_joint(MechanismDescription& m, JointType type, int first, int second, const Vec3& point,
                     const Vec3& axis, TimeFunctionPtr drive = nullptr) {
  JointDescription j;
  j.name = "J" + std::to_string(m.joints.size() + 1);
  j.type = type;
  j.first = first;
  j.second = second;
  j.point = point;
  j.axis = axis.normalized();
  j.second_axis = Vec3(0.3, 1.0, -0.4).normalized();
  j.driven = drive != nullptr;
  m.joints.push_back(j);
  const int index = static_cast<int>(m.joints.size()) - 1;
  if (drive) m.motion.drives[index] = drive;
  return index;
}

inline void add_clearance(MechanismDescription& m, int joint, bool journal_first,
                          JournalAxes axes = JournalAxes::parallel) {
  ClearanceDescription c;
  c.joint = joint;
  c.journal = journal_first ? m.joints[joint].first : m.joints[joint].second;
  c.axes = axes;
  c.parameters.radial = c.parameters.axial = 1e-4;
  c.parameters.journal_radius = 0.01;
  c.parameters.cap_radius = 0.016;
  c.parameters.sleeve_length = 0.03;
  c.parameters.friction.coefficient = 0.1;
  m.clearances.push_back(c);
}

inline void add_spring(MechanismDescription& m, int first, int second, const Vec3& p, const Vec3& q) {
  SpringDescription s;
  s.first = first;
  s.second = second;
  s.first_point = p;
  s.second_point = q;
  s.parameters = {200.0, 3.0, 0.1};
  m.springs.push_back(s);
}

// Two loops, an open chain, a floating body; all seven joint types, some written from the far body back, tree and cut ones.
// Joints: 0 revolute (driven), 1 universal, 2 spherical, 3 cylindrical, 4 planar, 5 prismatic (driven), 6 fixed, 7 universal,
// 8 revolute, 9 revolute.
// drive_antenna: joint 9 too.
inline MechanismDescription menagerie(bool drive_antenna = false) {
  MechanismDescription m;
  m.name = "menagerie";
  m.gravity = Vec3(0.5, -1.0, -9.81);
  const int crank = add_body(m, "crank", 1.0, {0.1, 0.0, 0.05}, {0.1, 0.2, 0.3});
  const int coupler = add_body(m, "coupler", 0.7, {0.3, 0.1, 0.1}, {-0.4, 0.1, 0.0});
  const int slider = add_body(m, "slider", 1.3, {0.5, 0.25, 0.1}, {0.0, 0.0, 0.0});
  const int puck = add_body(m, "puck", 0.9, {-0.2, 0.1, 0.0}, {0.0, 1.1, 0.2});
  const int arm = add_body(m, "arm", 0.4, {-0.3, 0.2, 0.1}, {0.3, -0.2, 0.9});
  const int lamp = add_body(m, "lamp", 0.2, {-0.3, 0.2, 0.25}, {0.0, 0.3, 0.0});
  const int link = add_body(m, "link", 0.5, {-0.1, 0.3, 0.15}, {0.2, 0.0, 0.0});
  const int satellite = add_body(m, "satellite", 2.0, {0.0, 0.0, 1.0}, {0.5, 0.5, 0.1});
  const int antenna = add_body(m, "antenna", 0.3, {0.0, 0.1, 1.2}, {0.1, 0.0, 0.0});
  add_joint(m, JointType::revolute, kGround, crank, {0.0, 0.0, 0.0}, {0.1, 0.2, 1.0}, sine(0.7, 3.0));
  add_joint(m, JointType::universal, coupler, crank, {0.2, 0.0, 0.1}, {1.0, 0.1, 0.2});
  add_joint(m, JointType::spherical, coupler, slider, {0.4, 0.2, 0.1}, Vec3::UnitZ());
  add_joint(m, JointType::cylindrical, slider, kGround, {0.5, 0.3, 0.1}, {1.0, 0.5, 0.1});
  add_joint(m, JointType::planar, kGround, puck, {-0.2, 0.1, 0.0}, {0.1, 0.1, 1.0});
  add_joint(m, JointType::prismatic, arm, puck, {-0.25, 0.15, 0.05}, {1.0, -1.0, 0.4}, sine(0.05, 5.0));
  add_joint(m, JointType::fixed, arm, lamp, {-0.3, 0.2, 0.2}, Vec3::UnitZ());
  add_joint(m, JointType::universal, lamp, link, {-0.2, 0.25, 0.2}, {0.0, 0.2, 1.0});
  add_joint(m, JointType::revolute, link, slider, {0.2, 0.3, 0.1}, {0.2, 0.1, 1.0});
  add_joint(m, JointType::revolute, satellite, antenna, {0.0, 0.05, 1.1}, {1.0, 0.0, 0.3},
            drive_antenna ? sine(0.4, 6.0) : nullptr);
  add_spring(m, slider, satellite, {0.5, 0.25, 0.2}, {0.0, 0.1, 0.9});
  LoadDescription load;
  load.body = antenna;
  load.point = Vec3(0.0, 0.2, 1.2);
  load.force = {sine(1.0, 2.0), sine(0.3, 1.0), sine(-0.5, 7.0)};
  m.loads.push_back(load);
  load = {};
  load.joint = 9;
  load.along_joint = sine(0.2, 4.0);
  m.loads.push_back(load);
  m.payload = PayloadDescription{satellite, 5.0, Vec3(0.1, -0.1, 1.1), Vec3(0.1, 0.2, 0.15), {}};
  m.motion.duration = 1.0;
  return m;
}

// In the x-z plane, three links on four parallel hinges, nothing driven.
inline MechanismDescription planar_four_bar() {
  MechanismDescription m;
  m.name = "planar four-bar";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  const int crank = add_body(m, "crank", 1.0, {0.05, 0.0, 0.1}, Vec3::Zero());
  const int coupler = add_body(m, "coupler", 1.0, {0.3, 0.0, 0.3}, Vec3::Zero());
  const int rocker = add_body(m, "rocker", 1.0, {0.55, 0.0, 0.2}, Vec3::Zero());
  add_joint(m, JointType::revolute, kGround, crank, {0.0, 0.0, 0.0}, Vec3::UnitY());
  add_joint(m, JointType::revolute, crank, coupler, {0.1, 0.0, 0.2}, Vec3::UnitY());
  add_joint(m, JointType::revolute, coupler, rocker, {0.5, 0.0, 0.4}, Vec3::UnitY());
  add_joint(m, JointType::revolute, rocker, kGround, {0.6, 0.0, 0.0}, Vec3::UnitY());
  return m;
}

// Five bars of 1 m between two bearings on the ground, hinge axes y z x y z x (IFToMM benchmark A04).
inline MechanismDescription bricard() {
  MechanismDescription m;
  m.name = "Bricard";
  m.gravity = Vec3(0.0, -9.81, 0.0);
  const Vec3 P[] = {{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0, 0, 1}};
  const Vec3 axis[] = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  for (int i = 0; i < 5; ++i) {
    add_body(m, "bar" + std::to_string(i + 1), 1.0, 0.5 * (P[i] + P[i + 1]), Vec3::Zero());
    const Vec3 along = P[i + 1] - P[i];
    m.bodies.back().inertia = 8.41667e-2 * Mat3::Identity() - (8.41667e-2 - 1.66667e-3) * along * along.transpose();
  }
  for (int i = 0; i < 6; ++i)
    add_joint(m, JointType::revolute, i == 0 ? kGround : i - 1, i == 5 ? kGround : i, P[i], axis[i % 3]);
  return m;
}

inline IdealState at_home(const Mechanism& mechanism) {
  IdealState state;
  for (const BodyDescription& b : mechanism.description().bodies)
    state.bodies.push_back({b.center_of_mass, b.axes, Vec3::Zero(), Vec3::Zero()});
  state.acceleration.assign(state.bodies.size(), Vec6::Zero());
  return state;
}

// Carries the drives' laws and no motion.
inline IdealMotion laws_only(const Mechanism& mechanism) {
  IdealState start = at_home(mechanism), end = start;
  end.t = mechanism.duration();
  return IdealMotion(mechanism, {start, end});
}

}  // namespace boresight::scenes
