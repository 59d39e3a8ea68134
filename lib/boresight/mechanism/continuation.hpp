// From one instant of an ideal motion by kinematics to a later one, along the same branch.
#pragma once

#include "boresight/mechanism/ideal_solver.hpp"

namespace boresight {

// From state.t to t by continuation: the step is halved where Newton fails. Returns false, with `step` what led on, where that took more
// than `most_steps` steps. Singular poses are passed on the branch that goes on smoothly. Throws ComputationError, naming the time, where
// no step leads on.
bool follow(IdealSolver& solver, double t, IdealState& state, const Mechanism& mechanism, int most_steps, double& step);

}  // namespace boresight
