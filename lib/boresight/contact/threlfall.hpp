// Threlfall (1978), Mechanism and Machine Theory 13, 475-483: friction that rises smoothly from rest,
//   F / F_n = mu (1 - exp(-3 v / v_d))   up to v = v_d,   0.95 mu above.
// Printed with 0.95, where the curve has 1 - exp(-3) = 0.9502: a jump of 0.0002 mu, left out by keeping 1 - exp(-3).
#pragma once

#include <cmath>

#include "boresight/math/scalar.hpp"

namespace boresight {

// Friction force over normal force [-]. speed >= 0.
template <typename T>
T threlfall(const T& speed, const T& coefficient, const T& dynamic_speed) {
  using std::exp;
  const T share = speed / dynamic_speed;
  return coefficient * (T(1.0) - exp(T(-3.0) * select(share < T(1.0), share, T(1.0))));
}

}  // namespace boresight
