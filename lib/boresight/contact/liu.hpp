// Liu, Zhang, Yang (2007), Journal of Mechanical Design: conformal contact of a pin in a bore, fitted to finite elements.
//
//   F = (pi / 2) d E_s L sqrt(d / (2 (dR + d)))
// The contact's half angle is arccos(dR / (dR + d)): it follows the pin around the bore, as half-spaces cannot.
#pragma once

#include <numbers>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline NormalLaw liu(const ClearanceParameters& p) {
  NormalLaw law;
  law.curve = ElasticCurve::conformal;
  law.stiffness = p.contact.stiffness_scale * 0.5 * std::numbers::pi * composite_modulus(p.contact) * p.sleeve_length;
  law.length = p.radial;
  return law;
}

}  // namespace boresight
