// Radzimovsky (1953), Univ. of Illinois Bulletin 408: a long cylinder in a bore, as Pereira, Ramalho, Ambrosio (2011) give it.
//
//   d = f / (pi E_s) (2/3 + ln(4 R_b / b) + ln(4 R_a / b)),   b = 1.60 sqrt(f R_a R_b / (dR E_s)),   f = F / L
#pragma once

#include <cmath>
#include <numbers>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline NormalLaw radzimovsky(const ClearanceParameters& p) {
  NormalLaw law;
  law.curve = ElasticCurve::logarithmic;
  law.stiffness = p.contact.stiffness_scale * std::numbers::pi * composite_modulus(p.contact) * p.sleeve_length;
  // 16 R_a R_b / b^2 = 6.25 dR E_s / f: the radii cancel.
  law.length = 16.0 / (1.60 * 1.60) * p.radial * std::exp(2.0 / 3.0) / std::numbers::pi;
  return law;
}

}  // namespace boresight
