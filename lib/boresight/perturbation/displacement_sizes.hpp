// Displacements of the body that carries the boresight, and how large each index finds them.
#pragma once

#include <array>

#include "boresight/mechanism/body_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/pointing/indices.hpp"

namespace boresight {

// How much of each PointingQuantity a displacement is of the body that carries the boresight.
class DisplacementSizes {
 public:
  DisplacementSizes(const Mechanism& mechanism, const BodyMotion& body) {
    const auto& line = mechanism.pointing().line_of_sight;
    for (int k = 0; k < kPointingQuantities; ++k) {
      gain_[k].setZero();
      if (PointingQuantity(k) == PointingQuantity::line_of_sight_error && !line) continue;
      gain_[k] =
          error_gain(PointingQuantity(k), {body.p, Quat(body.R)}, body.R * mechanism.pointing().boresight_B, line);
    }
  }
  std::array<double, kPointingQuantities> operator()(const Vec6& x) const {
    std::array<double, kPointingQuantities> size = {};
    for (int k = 0; k < kPointingQuantities; ++k) size[k] = (gain_[k] * x).norm();
    return size;
  }

 private:
  std::array<Eigen::Matrix<double, 3, 6>, kPointingQuantities> gain_;
};

// From one place to another: the way, then the rotation vector.
inline Vec6 displacement(const BodyMotion& from, const BodyMotion& to) {
  const Eigen::AngleAxisd turn(to.R * from.R.transpose());
  Vec6 x;
  x << to.p - from.p, turn.angle() * turn.axis();
  return x;
}

}  // namespace boresight
