// Kelvin-Voigt: a linear spring and dashpot, F = K d + D ddot, K [N/m], D [N s/m], clamped at zero.
//
// Goldsmith (1960), Impact. The force jumps by D v0 when contact begins, and its restitution depends on the mass: with
// zeta = D / (2 sqrt(K m)), from F = 0 as the end of contact,
//   e = exp(-zeta / sqrt(1 - zeta^2) (pi - 2 asin zeta)),   0 <= zeta < 1; e -> exp(-2) as zeta -> 1.
// The closed form of e is derived for this program and held against integration in a test.
#pragma once

#include <cmath>
#include <numbers>

#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline NormalLaw kelvin_voigt(const ClearanceParameters& p) {
  NormalLaw law;
  law.curve = ElasticCurve::linear;
  law.stiffness = p.contact.stiffness_scale * p.contact.linear_stiffness;
  law.dashpot = p.contact.linear_damping;
  return law;
}

// Of one impact of mass m [kg].
inline double kelvin_voigt_restitution(double stiffness, double dashpot, double m) {
  const double zeta = dashpot / (2.0 * std::sqrt(stiffness * m));
  if (zeta >= 1.0) return std::exp(-2.0);
  return std::exp(-zeta / std::sqrt(1.0 - zeta * zeta) * (std::numbers::pi - 2.0 * std::asin(zeta)));
}

// The D that gives a mass m the restitution e, exp(-2) < e <= 1 [N s/m].
inline double kelvin_voigt_dashpot(double stiffness, double m, double e) {
  double low = 0.0, high = 1.0;  // zeta
  for (int k = 0; k < 60; ++k) {
    const double zeta = 0.5 * (low + high);
    const double reached = kelvin_voigt_restitution(1.0, 2.0 * zeta, 1.0);
    (reached > e ? low : high) = zeta;
  }
  return (low + high) * std::sqrt(stiffness * m);
}

}  // namespace boresight
