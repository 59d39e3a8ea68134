// The perturbation rung: the ideal motion plus a small deviation, whose unknowns are the offsets and tilts that the plays
// free (scene/deviation_coordinates.hpp); its equation is in scene/offset_dynamics.hpp. The contact laws are the same lines
// that the multibody rung runs.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

std::unique_ptr<Rung> make_perturbation(std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
