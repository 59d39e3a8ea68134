// What is left of a contact's laws without all that dissipates and rubs.
#pragma once

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline void keep_elastic(NormalLaw& law) { law.damping_factor = law.dashpot = 0.0; }

inline void keep_elastic(FrictionLaw& friction) {
  friction.kind = FrictionKind::none;
  friction.stiction = 0.0;
}

}  // namespace boresight
