// Elastic Hertz contact without dissipation: h = 0 whatever the restitution. For energy checks and as the limit e -> 1.
#pragma once

namespace boresight {

inline double hertz_elastic_damping_factor(double) { return 0.0; }

}  // namespace boresight
