// A straight edge on a flat face: the contact of a slider's end with one face of its guide.
//
// Along the edge a linear stiffness K_e / (2 w) per length, w half the edge's length, under the penetration
//   d(s) = d0 + A s,   s from -1 to 1 along the edge,   A >= 0 towards the end that is deeper,
// summed up where it is positive, gives in closed form
//   full contact   d0 >= A:    F = K_e d0                   at s = A / (3 d0)
//   partial      |d0| < A:     F = K_e (d0 + A)^2 / (4 A)   at s = 1 - (d0 + A) / (3 A)
//   energy                     K_e (d0^2 + A^2 / 3) / 2,    K_e (d0 + A)^3 / (12 A)
// F and F s are the derivatives of the energy by d0 and A. Both are continuous as the edge lifts off.
// Derived for this program; held against quadrature in a test.
#pragma once

#include "boresight/math/scalar.hpp"

namespace boresight {

template <typename T>
struct EdgeForce {
  T force{};       // F [N]
  T moment_arm{};  // s of the centre of pressure [-], from 0 (even contact) to 1 (a corner)
  T energy{};      // [J]
};

// stiffness: K_e [N/m]; depth: d0 [m]; swing: A >= 0 [m]. T: the scalar of the motion, S of the stiffness.
template <typename S, typename T>
EdgeForce<T> edge_contact(const S& stiffness, const T& depth, const T& swing) {
  const T zero(0.0), one(1.0), deepest = depth + swing;
  const auto partial = swing > depth;
  const auto touches = deepest > zero;
  // Divisors are only looked at where the contact is of their kind.
  const T divisor = select(partial, T(swing + S(TinyLength<T>::square)), one);
  const T whole = select(partial, one, select(touches, depth, one));
  EdgeForce<T> result;
  result.force = select(
      touches, select(partial, T(S(0.25) * stiffness * deepest * deepest / divisor), T(stiffness * depth)), zero);
  result.moment_arm =
      select(touches, select(partial, T(one - deepest / (S(3.0) * divisor)), T(swing / (S(3.0) * whole))), zero);
  result.energy = select(touches,
                         select(partial, T(S(1.0 / 12.0) * stiffness * deepest * deepest * deepest / divisor),
                                T(S(0.5) * stiffness * (depth * depth + S(1.0 / 3.0) * swing * swing))),
                         zero);
  return result;
}

}  // namespace boresight
