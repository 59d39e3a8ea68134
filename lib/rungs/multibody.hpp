// The multibody rung: exact in the geometry, the yardstick for the others.
//
// The equations of motion in one of their formulations, RK4 with a fixed step, contacts' memory latched at accepted steps.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

std::unique_ptr<Rung> make_multibody(std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
