// Pereira, Ramalho, Ambrosio (2011), Nonlinear Dynamics 63, 681-697: a pin in a bore, an explicit fit to Johnson's relation.
//
//   F = (0.965 dR + 0.0965) L E_s / dR d^n,   n = Y dR^-0.005        (N and mm; internal contact)
//   Y = 1.51 ln(1000 dR)^-0.151 for dR in [0.005, 0.34954) mm,   Y = 0.0151 dR + 1.151 for [0.34954, 10) mm
// Outside of these clearances the nearer end's n is taken. Its own dissipation is Lankarani and Nikravesh's.
#pragma once

#include <algorithm>
#include <cmath>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline constexpr double kPereiraClearance[] = {5e-6, 10e-3};  // [m]

inline NormalLaw pereira(const ClearanceParameters& p) {
  const double dR = 1e3 * std::clamp(p.radial, kPereiraClearance[0], kPereiraClearance[1]);  // [mm]
  const double Y = dR < 0.34954 ? 1.51 * std::pow(std::log(1000.0 * dR), -0.151) : 0.0151 * dR + 1.151;
  NormalLaw law;
  law.curve = ElasticCurve::power;
  law.exponent = Y * std::pow(dR, -0.005);
  law.length = 1e-3;  // penetrations in mm
  const double per_mm = (0.965 * dR + 0.0965) * (1e3 * p.sleeve_length) * (1e-6 * composite_modulus(p.contact)) / dR;
  law.stiffness = p.contact.stiffness_scale * 1e3 * per_mm;
  return law;
}

}  // namespace boresight
