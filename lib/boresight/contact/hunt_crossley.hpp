// Hunt, Crossley (1975), Journal of Applied Mechanics 42, 440-445: h = 3 (1 - e) / 2.
//
// The first of the family; made for e near 1, where it is exact to first order. Returns 0.50 when asked for 0.
#pragma once

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double hunt_crossley_damping_factor(double e) { return 1.5 * (1.0 - e); }

}  // namespace boresight
