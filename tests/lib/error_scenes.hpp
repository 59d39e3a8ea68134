// Mechanisms with standing errors, for several tests.
#pragma once

#include <cmath>
#include <random>

#include "boresight/math/time_function.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "scenes.hpp"

namespace boresight::scenes {

inline ErrorDescription frame_error(const MechanismDescription& m, ErrorDescription::Kind kind,
                                    const std::string& joint, const std::string& body, const Vec3& direction) {
  ErrorDescription e;
  e.name = joint + "." + body + std::to_string(m.errors.size());
  e.kind = kind;
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == joint) e.joint = static_cast<int>(j);
  e.body = kGround;
  for (std::size_t b = 0; b < m.bodies.size(); ++b)
    if (m.bodies[b].name == body) e.body = static_cast<int>(b);
  e.direction = direction;
  return e;
}

inline ErrorDescription drive_error(const MechanismDescription& m, const std::string& joint, const std::string& law) {
  ErrorDescription e = frame_error(m, ErrorDescription::Kind::drive, joint, "", Vec3::Zero());
  e.law = parse_coordinate_function(law);
  return e;
}

// All errors that a mechanism can have: every joint's frame in both its bodies along and about all axes, every drive by three laws,
// every body and the ground growing.
// Where a mechanism has no errors of its own: its first joints displaced in their second bodies by so much [m], in turns to either side.
inline MechanismDescription with_joints_off(MechanismDescription m, double length) {
  for (std::size_t j = 0; m.errors.size() < 4 && j < m.joints.size(); ++j) {
    ErrorDescription e;
    e.name = m.joints[j].name + ".off";
    e.joint = static_cast<int>(j);
    e.body = m.joints[j].second;
    e.direction = j % 2 == 0 ? Vec3(0.8, 0.0, 0.6) : Vec3(0.6, 0.0, -0.8);
    m.errors.push_back(e);
  }
  for (std::size_t e = 0; e < m.errors.size(); ++e)
    if (unit_of(m.errors[e], m.joints) == std::string("m")) m.errors[e].value = e % 2 == 0 ? length : -length;
  return m;
}

inline MechanismDescription with_every_error(MechanismDescription m) {
  const std::vector<JointDescription> joints = m.joints;
  const auto name_of = [&](int body) { return body == kGround ? std::string("ground") : m.bodies[body].name; };
  for (const JointDescription& j : joints) {
    for (const int body : {j.first, j.second})
      for (const ErrorDescription::Kind kind : {ErrorDescription::Kind::translation, ErrorDescription::Kind::rotation})
        for (int axis = 0; axis < 3; ++axis)
          m.errors.push_back(frame_error(m, kind, j.name, name_of(body), Vec3::Unit(axis)));
    if (!j.driven) continue;
    for (const char* law : {"1", "q + t", "sin(3*q)"}) m.errors.push_back(drive_error(m, j.name, law));
  }
  for (int body = kGround; body < static_cast<int>(m.bodies.size()); ++body) {
    ErrorDescription e;
    e.name = "growth of " + name_of(body);
    e.kind = ErrorDescription::Kind::expansion;
    e.body = body;
    e.coefficient = 1e-5;
    m.errors.push_back(e);
  }
  return m;
}

// A sample of all errors: lengths of some 1e-5 m, angles of some 1e-5 rad, warming of some 1 K, times `scale`.
inline Parameters with_scattered_errors(const Mechanism& mechanism, unsigned seed, double scale = 1.0) {
  std::mt19937_64 random(seed);
  Parameters sample = mechanism.parameters();
  for (std::size_t e = 0; e < sample.error.size(); ++e) {
    const double size = mechanism.description().errors[e].kind == ErrorDescription::Kind::expansion ? 1.0 : 1e-5;
    sample.error[e] = scale * size * (2.0 * 0x1p-53 * static_cast<double>(random() >> 11) - 1.0);
  }
  return sample;
}

}  // namespace boresight::scenes
