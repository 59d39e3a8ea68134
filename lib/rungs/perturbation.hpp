// The perturbation rung: the ideal motion plus a small deviation, three unknowns per clearance joint (see
// clearance_scene.hpp). The contact laws are the same lines that the multibody rung runs.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

std::unique_ptr<Rung> make_perturbation(std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
