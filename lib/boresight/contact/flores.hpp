// Flores, Machado, Silva, Martins (2011), Multibody System Dynamics 25, 357-375: h = 8 (1 - e) / (5 e).
//
// Made for the whole range of restitution: the damping grows without bound as e -> 0, where the law is refused.
// Sun et al., Eq. 25.
#pragma once

namespace boresight {

// e: restitution coefficient, 0 < e <= 1. Returns h [-].
inline double flores_damping_factor(double e) { return 8.0 * (1.0 - e) / (5.0 * e); }

}  // namespace boresight
