// Johnson (1985), Contact Mechanics, 5.6: a long cylinder in a bore, both half-spaces.
//
//   d = f / (pi E_s) (ln(4 pi E_s dR / f) - 1),   f = F / L
// with E_s the composite modulus, dR = R_b - R_a, L the sleeve's length.
#pragma once

#include <numbers>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline NormalLaw johnson(const ClearanceParameters& p) {
  NormalLaw law;
  law.curve = ElasticCurve::logarithmic;
  law.stiffness = p.contact.stiffness_scale * std::numbers::pi * composite_modulus(p.contact) * p.sleeve_length;
  law.length = 4.0 * p.radial / std::numbers::e;
  return law;
}

}  // namespace boresight
