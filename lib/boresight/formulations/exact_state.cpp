#include "boresight/formulations/exact_state.hpp"

#include "boresight/formulations/ideal_simulation.hpp"

namespace boresight {

IdealState exact_state(const Mechanism& mechanism, const IdealMotion& ideal, double t) {
  IdealState state;
  ideal.state(t, state);
  if (!is_kinematic(mechanism)) return state;
  IdealState solved = state;
  return IdealSolver(mechanism).solve(t, solved) ? solved : state;
}

}  // namespace boresight
