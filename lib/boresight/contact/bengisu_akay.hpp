// Bengisu, Akay (1994), Journal of the Acoustical Society of America 96: friction with a static peak,
//   F / F_n = mu_s (1 - (v - v_d)^2 / v_d^2)                       up to v = v_d
//   F / F_n = mu + (mu_s - mu) exp(-(v - v_d) / v_st)              above
// mu_s static and mu kinetic coefficient, v_d where the peak lies, v_st the speed over which it decays. Smooth at v_d.
#pragma once

#include <cmath>

#include "boresight/math/scalar.hpp"

namespace boresight {

// Friction force over normal force [-]. speed >= 0.
template <typename T>
T bengisu_akay(const T& speed, const T& kinetic, const T& stiction, const T& peak_speed, const T& decay_speed) {
  using std::exp;
  const T below = (speed - peak_speed) / peak_speed;
  const T above = positive_part(T(speed - peak_speed)) / decay_speed;
  return select(speed < peak_speed, T(stiction * (T(1.0) - below * below)),
                T(kinetic + (stiction - kinetic) * exp(-above)));
}

}  // namespace boresight
