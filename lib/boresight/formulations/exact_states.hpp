// Instants of the ideal motion to the last digits of their accelerations.
#pragma once

#include <optional>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/ideal_solver.hpp"

namespace boresight {

// Quintics through the ideal motion's states have its places to 1e-12, but its accelerations to 1e-6 only: places that are rounded, over the
// square of their spacing. Where the loads of a joint cancel, these are the digits that are left. So they are solved anew where laws give
// them; a simulated motion has its states from its steps.
class ExactStates {
 public:
  // Both must outlive it.
  ExactStates(const Mechanism& mechanism, const IdealMotion& ideal);
  IdealState at(double t);

 private:
  const IdealMotion& ideal_;
  std::optional<IdealSolver> solver_;  // knows which rows depend on others once it has met one instant
};

}  // namespace boresight
