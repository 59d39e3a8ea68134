// The multibody rung: exact in the geometry, the yardstick for the others.
//
// The equations of motion in one of their formulations (formulations/formulation.hpp), advanced by the integrator that the
// options name; where they name none by rk4, or by rosenbrock where rk4's own step does not follow the motion
// (stepping/default_integrator.hpp). The contacts' memory changes at accepted steps alone.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

std::unique_ptr<Rung> make_multibody(std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
