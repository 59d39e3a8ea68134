// Dubowsky, Freudenstein (1971), Journal of Engineering for Industry 93, 305-309: a pin in a bore of length L.
//
//   d = F s / L (ln(L^3 dR / (F R_a R_b s)) + 1),   s = 1 / (pi E_s)
// Goldsmith (1960) has the same line with L in place of L^3, which leaves a length in the logarithm: not offered here.
#pragma once

#include <numbers>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline NormalLaw dubowsky_freudenstein(const ClearanceParameters& p) {
  const double L = p.sleeve_length;
  NormalLaw law;
  law.curve = ElasticCurve::logarithmic;
  law.stiffness = p.contact.stiffness_scale * std::numbers::pi * composite_modulus(p.contact) * L;
  law.length = std::numbers::e * L * L * p.radial / (p.journal_radius * (p.journal_radius + p.radial));
  return law;
}

}  // namespace boresight
