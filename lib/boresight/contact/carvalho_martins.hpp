// Carvalho, Martins (2019), Mechanism and Machine Theory: h = 3 (1 - e) (11 - e) / (2 (1 + 9 e)).
//
// A rational fit to the exact factor: within 0.003 of the restitution asked for from e = 1/3 to 1.
#pragma once

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double carvalho_martins_damping_factor(double e) { return 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e); }

}  // namespace boresight
