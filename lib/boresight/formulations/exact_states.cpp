#include "boresight/formulations/exact_states.hpp"

#include "boresight/formulations/ideal_simulation.hpp"

namespace boresight {

ExactStates::ExactStates(const Mechanism& mechanism, const IdealMotion& ideal) : ideal_(ideal) {
  if (is_kinematic(mechanism)) solver_.emplace(mechanism);
}

IdealState ExactStates::at(double t) {
  IdealState state;
  ideal_.state(t, state);
  if (!solver_) return state;
  IdealState solved = state;
  return solver_->solve(t, solved) ? solved : state;
}

}  // namespace boresight
