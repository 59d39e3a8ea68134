// Modified Coulomb friction (Ambrosio 2002; Sun et al., Eq. 29-30): F_t = c_f c_d F_n against the sliding, with
//   c_d = 0 below v_s,   (v - v_s) / (v_d - v_s) from v_s to v_d,   1 above v_d.
// Smooth enough for explicit integration, but it cannot hold a load: under one it creeps at the speed where the ramp
// balances it, v = v_s + (v_d - v_s) F / (c_f F_n).
#pragma once

#include "boresight/math/scalar.hpp"

namespace boresight {

template <typename T>
struct ModifiedCoulombT {
  T coefficient = T(0.0);     // c_f [-]
  T static_speed = T(1e-4);   // v_s [m/s]
  T dynamic_speed = T(1e-3);  // v_d [m/s]

  // Friction force over normal force over sliding speed [s/m]: multiply by F_n and the sliding velocity vector.
  // speed >= 0. M: the scalar of the motion.
  template <typename M>
  M force_per_velocity(const M& speed) const {
    const M ramp = (speed - static_speed) * (T(1.0) / (dynamic_speed - static_speed));
    const M factor = select(ramp > T(1.0), M(1.0), positive_part(ramp));
    // Where the factor is zero the speed may be too: divide by something harmless there.
    const M divisor = select(speed > static_speed, speed, M(1.0));
    return coefficient * factor / divisor;
  }
};
using ModifiedCoulomb = ModifiedCoulombT<double>;

}  // namespace boresight
