// A cap's flat face on the end of a sleeve: contact on a ring, when the face may tilt.
//
// Per radian of the ring a linear stiffness K_c / (2 pi), at the mean radius rho, under the penetration
//   d(alpha) = d0 + A cos(alpha),   A = rho |slope of the face|,
// summed up where it is positive, gives in closed form
//   full contact    d0 >= A:    F = K_c d0                             M / rho = K_c A / 2
//   partial       |d0| < A:     F = (K_c / pi) (d0 a + A sin a)        M / rho = (K_c / 2 pi) (2 d0 sin a + A (a + sin a cos a))
//                               with cos a = -d0 / A
// F and M / rho are the derivatives of one elastic energy, (F d0 + (M / rho) A) / 2, with respect to d0 and A. Both are
// continuous in the tilt, and a face that does not tilt gives the paper's linear force (Sun et al., Eq. 31).
// Derived for this program; held against quadrature in a test.
#pragma once

#include <numbers>

#include "boresight/math/scalar.hpp"

namespace boresight {

template <typename T>
struct RingForce {
  T force{};       // F [N]
  T moment_arm{};  // M / (rho F) [-], from 0 (even contact) to 1 (a point of the ring)
  T energy{};      // [J]
};

// stiffness: K_c [N/m]; depth: d0 [m]; swing: A >= 0 [m]. T: the scalar of the motion, S of the stiffness.
template <typename S, typename T>
RingForce<T> ring_contact(const S& stiffness, const T& depth, const T& swing) {
  using std::acos;
  using std::sqrt;
  const T zero(0.0), one(1.0);
  const auto partial = swing > depth;         // part of the ring is free
  const auto touches = swing + depth > zero;  // some of it is not
  // The ratio is only looked at where contact is partial; elsewhere any value inside (-1, 1) does.
  const T ratio =
      select(partial, select(touches, -depth / select(partial, T(swing + S(TinyLength<T>::square)), one), zero), zero);
  const T inside = select(ratio < one, select(ratio > T(-1.0), ratio, zero), zero);
  const T a = acos(inside), sine = sqrt(one - inside * inside);
  const S per_pi = stiffness * S(1.0 / std::numbers::pi);
  const T force = select(partial, per_pi * (depth * a + swing * sine), stiffness * depth);
  const T moment = select(partial, S(0.5) * per_pi * (S(2.0) * depth * sine + swing * (a + sine * inside)),
                          S(0.5) * stiffness * swing);
  RingForce<T> result;
  result.force = select(touches, positive_part(force), zero);
  const T divisor = select(result.force > zero, result.force, one);
  result.moment_arm = select(result.force > zero, moment / divisor, zero);
  result.energy = select(touches, S(0.5) * (force * depth + moment * swing), zero);
  return result;
}

}  // namespace boresight
