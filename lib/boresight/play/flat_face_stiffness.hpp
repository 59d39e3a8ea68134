// A flat face pressed onto another: a rigid rectangle of length a and width b <= a on a half-space,
//
//   K = E_s a / 2 (0.73 + 1.54 (b / a)^0.75)          Gazetas (1991), J. Geotech. Eng. 117, 1363-1381, table 1 (vertical, surface), with
//                                                     E_s = 2 G / (1 - nu), chi = b / a
// A square gives 1.135 E_s a; King (1987), Int. J. Solids Struct. 23, 1657-1664, has 1.142.
#pragma once

#include <algorithm>
#include <cmath>

#include "boresight/contact/hertz.hpp"

namespace boresight {

// sides [m]; returns [N/m].
inline double flat_face_stiffness(const ContactParameters& contact, double one_side, double other_side) {
  const double a = std::max(one_side, other_side), b = std::min(one_side, other_side);
  return contact.stiffness_scale * composite_modulus(contact) * 0.5 * a * (0.73 + 1.54 * std::pow(b / a, 0.75));
}

}  // namespace boresight
