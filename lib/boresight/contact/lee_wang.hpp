// Lee, Wang (1983), Mechanism and Machine Theory 18, 133-138: h = 3 (1 - e) / 4.
//
// Half of what e -> 1 needs: it dissipates too little everywhere.
#pragma once

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double lee_wang_damping_factor(double e) { return 0.75 * (1.0 - e); }

}  // namespace boresight
