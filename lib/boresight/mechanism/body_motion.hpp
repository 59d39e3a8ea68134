// Where the bodies are and how they move, at one instant.
#pragma once

#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

// World axes. The ground is a body at rest at the origin.
struct BodyMotion {
  Vec3 p = Vec3::Zero();      // p_WB, its own centre of mass [m]
  Mat3 R = Mat3::Identity();  // R_WB
  Vec3 v = Vec3::Zero();      // of the centre of mass [m/s]
  Vec3 w = Vec3::Zero();      // angular velocity [rad/s]
};

// Acceleration of a body: linear of the centre of mass, then angular, world axes.
using BodyAcceleration = Vec6;

// A body turned and moved by a small step: x = (displacement, rotation vector), world axes.
inline void displace(BodyMotion& body, const Vec6& x) {
  body.p += x.head<3>();
  const double angle = x.tail<3>().norm();
  if (angle > 0.0) body.R = Eigen::AngleAxisd(angle, x.tail<3>() / angle).toRotationMatrix() * body.R;
}

}  // namespace boresight
