// Hu, Guo (2015), Multibody System Dynamics: h = 3 (1 - e) / (2 e).
//
// Exact to first order about e = 1, and grows without bound as e -> 0 (refused at 0).
#pragma once

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double hu_guo_damping_factor(double e) { return 1.5 * (1.0 - e) / e; }

}  // namespace boresight
