// Scenes that several tests share.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "boresight/io/expression.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight::scenes {

// examples/3-rrcpr with settings applied.
inline MechanismDescription rrcpr(const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml", settings);
}

inline std::shared_ptr<const Mechanism> build(MechanismDescription description) {
  return std::make_shared<const Mechanism>(std::move(description));
}

// The legs' points and axes for another inclination and other radii than the default ones, everything else kept: the
// formulas of the leg's geometry, written without the reader.
inline MechanismDescription rrcpr_with_legs(double eta, double r_C, double r_F) {
  MechanismDescription m = rrcpr();
  const auto joint = [&m](const std::string& name) -> JointDescription& {
    for (JointDescription& j : m.joints)
      if (j.name == name) return j;
    throw std::logic_error("no joint " + name);
  };
  for (int leg = 1; leg <= 3; ++leg) {
    const std::string i = std::to_string(leg);
    const Mat3 R = Eigen::AngleAxisd((leg - 1) * 2.0 * std::numbers::pi / 3.0, Vec3::UnitZ()).toRotationMatrix();
    const Vec3 a = R * Vec3(std::cos(eta), 0.0, std::sin(eta));
    const Vec3 C = R * Vec3(r_C, 0.0, r_C * std::tan(eta));
    const Vec3 F = R * Vec3(r_F, 0.0, 0.46);
    joint("A" + i).axis = a;
    joint("B" + i).axis = R * Vec3(-std::sin(eta), 0.0, std::cos(eta));
    joint("B" + i).point = C;
    joint("C" + i).point = C;
    joint("P" + i).point = C;
    joint("P" + i).axis = (F - C).normalized();
    joint("F" + i).point = F;
  }
  return m;
}

// A planar four-bar in space in the x-z plane, pivots at `points`, first bar driven. Redundant: revolutes
// everywhere; else one spherical and one cylindrical joint give the same motion with independent rows.
inline MechanismDescription four_bar(const std::vector<Vec3>& points, bool redundant, const std::string& law) {
  MechanismDescription m;
  m.name = "four-bar";
  for (int k = 0; k < 3; ++k) {
    BodyDescription b;
    b.name = "bar" + std::to_string(k);
    b.mass = 1.0;
    b.center_of_mass = 0.5 * (points[k] + points[k + 1]);
    b.inertia = Vec3(0.1, 0.1, 0.01).asDiagonal();
    if (k == 1) b.boresight = Vec3::UnitZ();
    m.bodies.push_back(b);
  }
  for (int k = 0; k < 4; ++k) {
    JointDescription j;
    j.name = "j" + std::to_string(k);
    j.first = k == 0 ? kGround : k - 1;
    j.second = k == 3 ? kGround : k;
    j.point = points[k];
    j.axis = Vec3::UnitY();
    j.driven = k == 0;
    if (!redundant && k == 1) j.type = JointType::spherical;
    if (!redundant && k == 2) j.type = JointType::cylindrical;
    m.joints.push_back(j);
  }
  m.motion.duration = 0.5;
  m.motion.drives[0] = parse_expression(law);
  return m;
}

}  // namespace boresight::scenes
