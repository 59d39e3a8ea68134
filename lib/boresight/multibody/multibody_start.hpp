// The state that a motion of the multibody rung starts with: that of the ideal motion, or the same with the journals at rest.
//
// The bodies are displaced by T z, z being the balance of resting_start.hpp, which is linear in everything but the contacts,
// and the joints closed exactly. What that leaves unbalanced (the square of the deviation) is measured on the formulation
// itself, T^T M (vdot - vdot_ideal), and taken out by the same Newton steps: a mechanism whose drives stand still then stays
// where it is. The velocities are those of start_rates.hpp; contacts neither dissipate nor rub while the balance is looked for.
#pragma once

#include <string>
#include <vector>

#include "boresight/formulations/formulation.hpp"

namespace boresight {

// Where the bodies are when the journals rest.
struct RestingBodies {
  std::vector<BodyMotion>
      exact;    // on the mechanism's own geometry, moving as motions start; empty: no play can move, or none was found
  VecX linear;  // T z [m, rad], 6 of each body: where the linear balance has displaced them; empty: it has none
  std::string refusal;  // why not, where none was found
  std::string remark;   // that loads tip them over, or that nothing holds some of them (tipping.hpp); else empty
};
// Throws ComputationError at a singular pose.
RestingBodies resting_bodies(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal);

// warning: a sentence where journals were to rest and do not, or lean to a side that nothing decides; else left alone. Throws ComputationError at a singular pose.
VecX multibody_start(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal,
                     Formulation& formulation, std::string& warning);

}  // namespace boresight
