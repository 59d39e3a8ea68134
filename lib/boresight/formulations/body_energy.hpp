// The energy of a rigid body: with c its centre of mass from the body's own point,
//
//   kinetic  m |v + w x c|^2 / 2 + w . I w / 2        potential  -m g . (p + c)    [J]
#pragma once

#include "boresight/mechanism/body_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

inline double kinetic_energy(const MassProperties& m, const BodyMotion& body) {
  const Vec3 w = body.R.transpose() * body.w;
  return 0.5 * m.mass * (body.v + body.w.cross(Vec3(body.R * m.c))).squaredNorm() + 0.5 * w.dot(m.inertia * w);
}

// Above where the centre of mass is at `from`, world axes [m].
inline double potential_energy(const MassProperties& m, const BodyMotion& body, const Vec3& gravity,
                               const Vec3& from = Vec3::Zero()) {
  return -m.mass * gravity.dot(body.p + body.R * m.c - from);
}

}  // namespace boresight
