// What points, and at what: the pointing axis of the boresight body, and its line of sight where the file names a target.
#pragma once

#include <optional>

#include "boresight/math/types.hpp"

namespace boresight {

struct Pose {
  Vec3 p = Vec3::Zero();      // p_WB, centre of mass, world [m]
  Quat q = Quat::Identity();  // R_WB
};

// From a reference point of the body to a target that stands still.
struct LineOfSight {
  Vec3 from_B = Vec3::Zero();  // reference point, from the centre of mass, body axes [m]
  Vec3 target = Vec3::Zero();  // world [m]
  // Errors about the two axes across the line are told with the line turned round where it points downwards at home, so that
  // these axes are close to the world's x and y whether the target lies above or below.
  bool reversed = false;

  // From the reference point of this pose to the target, world axes [m].
  Vec3 line(const Pose& body) const { return target - (body.p + body.q * from_B); }
  // How far the reference point of `truth` is off that of `ideal`, world axes [m].
  Vec3 displacement(const Pose& truth, const Pose& ideal) const {
    return truth.p - ideal.p + (truth.q * from_B - ideal.q * from_B);
  }
  // The turn of the line, to first order, for a displacement of the centre of mass and a turn of the body (six numbers, world
  // axes): 3 x 6 [rad/m, rad/rad]. Its length is the line-of-sight error.
  Eigen::Matrix<double, 3, 6> gain(const Pose& ideal) const;
};

struct Pointing {
  Vec3 boresight_B = Vec3::UnitZ();  // pointing axis, body axes, unit length
  std::optional<LineOfSight> line_of_sight;
};

}  // namespace boresight
