// A gimbal whose two shafts run in two bearings each, as real ones do: elevation over azimuth. And drawings of any mechanism
// moved, turned and scaled.
#pragma once

#include <string>
#include <vector>

#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight::scenes {

// Joints A1, A2 (azimuth) and E1, E2 (elevation), of which the first of each pair is driven; play in those named.
inline MechanismDescription gimbal(const std::vector<std::string>& with_play, JournalAxes axes,
                                   bool shaft_is_journal = true) {
  MechanismDescription m;
  m.name = "gimbal";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  const int yoke = add_body(m, "yoke", 4.0, {0.0, 0.0, 0.2}, Vec3::Zero());
  const int tube = add_body(m, "tube", 3.0, {0.02, 0.005, 0.3}, Vec3::Zero());
  m.bodies[yoke].boresight.reset();
  m.bodies[tube].boresight = Vec3::UnitX();
  const auto joint = [&](const char* name, int first, int second, const Vec3& point, const Vec3& axis,
                         TimeFunctionPtr drive) {
    m.joints[add_joint(m, JointType::revolute, first, second, point, axis, drive)].name = name;
  };
  joint("A1", kGround, yoke, {0.0, 0.0, 0.0}, Vec3::UnitZ(), sine(0.8, 6.0));
  joint("A2", kGround, yoke, {0.0, 0.0, 0.12}, Vec3::UnitZ(), nullptr);
  joint("E1", yoke, tube, {0.0, -0.15, 0.3}, Vec3::UnitY(), sine(0.5, 8.0));
  joint("E2", yoke, tube, {0.0, 0.15, 0.3}, Vec3::UnitY(), nullptr);
  m.motion.duration = 0.2;
  for (const std::string& name : with_play)
    for (int j = 0; j < 4; ++j)
      if (m.joints[j].name == name) add_clearance(m, j, !shaft_is_journal, axes);
  return m;
}

// A flyball governor after Negrut, Haug and German (2003), Multibody System Dynamics 9: a spindle, two arms with balls, a collar,
// and stiff springs with dampers between arms and collar. Dimensions are ours. Joints S, L, R, C; nothing is driven.
inline MechanismDescription flyball_governor(double stiffness, double damping) {
  MechanismDescription m;
  m.name = "flyball governor";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  const auto body = [&](const char* name, double mass, const Vec3& at, const Vec3& inertia) {
    const int b = add_body(m, name, mass, at, Vec3::Zero());
    m.bodies[b].inertia = inertia.asDiagonal();
    return b;
  };
  const int spindle = body("spindle", 20.0, {0.0, 0.0, 0.3}, {2.5, 2.5, 0.5});
  const int left = body("left", 3.0, {-0.3, 0.0, 0.35}, {0.02, 0.03, 0.03});
  const int right = body("right", 3.0, {0.3, 0.0, 0.35}, {0.02, 0.03, 0.03});
  const int collar = body("collar", 1.0, {0.0, 0.0, 0.2}, {0.002, 0.002, 0.002});
  m.bodies[spindle].boresight.reset();
  m.bodies[collar].boresight = Vec3::UnitZ();
  const auto joint = [&](const char* name, JointType type, int first, int second, const Vec3& point, const Vec3& axis) {
    m.joints[add_joint(m, type, first, second, point, axis)].name = name;
  };
  joint("S", JointType::revolute, kGround, spindle, {0.0, 0.0, 0.0}, Vec3::UnitZ());
  joint("L", JointType::revolute, spindle, left, {-0.05, 0.0, 0.6}, Vec3::UnitY());
  joint("R", JointType::revolute, spindle, right, {0.05, 0.0, 0.6}, Vec3::UnitY());
  joint("C", JointType::prismatic, spindle, collar, {0.0, 0.0, 0.2}, Vec3::UnitZ());
  for (const int arm : {left, right}) {
    SpringDescription s;
    s.first = arm;
    s.second = collar;
    s.first_point = m.bodies[arm].center_of_mass;
    s.second_point = m.bodies[collar].center_of_mass;
    s.parameters = {stiffness, damping, 0.335};
    m.springs.push_back(s);
  }
  m.initial_rates.push_back({0, InitialRateDescription::Freedom::angle, 10.0, {}});
  m.motion.duration = 0.5;
  return m;
}

// The same mechanism, drawn `scale` times as large, turned, and moved. Masses stay, so that accelerations grow with the lengths
// where gravity does.
inline MechanismDescription drawn_elsewhere(MechanismDescription m, const Mat3& turn, const Vec3& move, double scale) {
  const auto point = [&](Vec3& p) { p = scale * (turn * p) + move; };
  for (BodyDescription& b : m.bodies) {
    point(b.center_of_mass);
    b.axes = turn * b.axes;
    b.inertia *= scale * scale;
    if (b.boresight) b.boresight = turn * *b.boresight;
  }
  for (JointDescription& j : m.joints) {
    point(j.point);
    j.axis = turn * j.axis;
    j.second_axis = turn * j.second_axis;
  }
  for (ClearanceDescription& c : m.clearances)
    for (double* length : {&c.parameters.radial, &c.parameters.axial, &c.parameters.journal_radius,
                           &c.parameters.cap_radius, &c.parameters.sleeve_length})
      *length *= scale;
  for (SpringDescription& s : m.springs) {
    point(s.first_point);
    point(s.second_point);
    s.parameters.free_length *= scale;
    s.parameters.preload *= scale;
  }
  m.gravity = scale * (turn * m.gravity);
  return m;
}

}  // namespace boresight::scenes
