// Gonthier, McPhee, Lange, Piedboeuf (2004), Multibody System Dynamics 11, 209-233: h = (1 - e^2) / e.
//
// Good at small e, where it grows without bound as it must (refused at 0); too much damping near e = 1.
#pragma once

namespace boresight {

// e: restitution asked for. Returns h [-].
inline double gonthier_damping_factor(double e) { return (1.0 - e * e) / e; }

}  // namespace boresight
