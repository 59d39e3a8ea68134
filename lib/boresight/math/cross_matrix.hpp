// v x as a matrix: cross_matrix(v) u = v x u.
#pragma once

#include "boresight/math/types.hpp"

namespace boresight {

inline Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace boresight
