// One impact of a free mass on one contact, followed until it parts: what restitution a law returns, how deep and how hard.
#pragma once

#include <vector>

#include "boresight/contact/normal_law.hpp"

namespace boresight {

struct Impact {
  double restitution = 0.0;  // speed of parting over speed of approach [-]
  double depth = 0.0;        // deepest [m]
  double force = 0.0;        // largest [N]
  double duration = 0.0;     // [s]
};

struct ImpactSample {
  double t, penetration, force;  // [s], [m], [N]
};

// mass [kg] approaching at speed > 0 [m/s]. RK4 from the instant of contact, steps per time of an undamped contact.
// path: filled with some hundred instants where not null.
Impact impact(const NormalLaw& law, double mass, double speed, int steps = 4000,
              std::vector<ImpactSample>* path = nullptr);

}  // namespace boresight
