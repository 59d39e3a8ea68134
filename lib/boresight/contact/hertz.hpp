// Elastic constants of a journal in its sleeve.
//
//   composite modulus   1/E_s = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b                 Sun et al., Eq. 27 (Hertz 1882)
//   radial stiffness    K = (4/3) E_s sqrt(R_a R_b / (R_b - R_a))    [N/m^1.5]      Sun et al., Eq. 28 (Goldsmith 1960)
//   end-face stiffness  K_c = (R_s - R_b) E_s / 0.475                [N/m]          Sun et al., Eq. 32
//   validity of a dissipative Hertz law: impact speed <= 1e-5 sqrt(E_s / rho)       Sun et al., Eq. 26 (Love 1944)
// with R_a journal, R_b = R_a + c_r sleeve, R_s cap radius. K grows without bound as the clearance shrinks.
#pragma once

#include <cmath>

#include "boresight/mechanism/parameters.hpp"

namespace boresight {

inline double composite_modulus(const ContactParameters& c) {
  return 1.0 / ((1.0 - c.poisson[0] * c.poisson[0]) / c.young[0] + (1.0 - c.poisson[1] * c.poisson[1]) / c.young[1]);
}

inline double radial_hertz_stiffness(const ClearanceParameters& p) {
  const double journal = p.journal_radius, sleeve = p.journal_radius + p.radial;
  return p.contact.stiffness_scale * 4.0 / 3.0 * composite_modulus(p.contact) *
         std::sqrt(journal * sleeve / (sleeve - journal));
}

inline double end_face_stiffness(const ClearanceParameters& p) {
  const double sleeve = p.journal_radius + p.radial;
  return p.contact.stiffness_scale * (p.cap_radius - sleeve) * composite_modulus(p.contact) / 0.475;
}

// Of a round pad pressed flat against a plane face, as a rigid punch on a half-space: K_p = 2 R E_s [N/m] (Johnson 1985, Contact Mechanics,
// 3.8 (a)).
inline double pad_stiffness(const ClearanceParameters& p) {
  return p.contact.stiffness_scale * 2.0 * p.pad_radius * composite_modulus(p.contact);
}

inline double validity_speed(const ContactParameters& c) { return 1e-5 * std::sqrt(composite_modulus(c) / c.density); }

}  // namespace boresight
