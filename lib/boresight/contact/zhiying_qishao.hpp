// Zhiying, Qishao (2006), Journal of Sound and Vibration: h = 3 (1 - e^2) exp(2 (1 - e)) / 4.
//
// Lankarani and Nikravesh's factor, stretched by an exponential so that small e are met better.
#pragma once

#include <cmath>

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double zhiying_qishao_damping_factor(double e) { return 0.75 * (1.0 - e * e) * std::exp(2.0 * (1.0 - e)); }

}  // namespace boresight
