// What the perturbation rung misses of where journals rest as a motion starts.
#pragma once

#include <array>

#include "boresight/perturbation/displacement_sizes.hpp"
#include "boresight/scene/scene_rung.hpp"

namespace boresight {

struct MissedAtRest {
  std::array<double, kPointingQuantities> pose = {};  // of each quantity [m, rad]
  VecX start;  // of the coordinates, then of their rates; empty where nothing is missed, or not wanted
};

// What the linear balance of resting journals misses of the one on the mechanism's own geometry, which knows how the loads change as
// journals move: with them, where a journal goes that next to nothing pushes. Nothing where they start centred. want_start: the start too, which
// asks for the linear balance once more. Throws ComputationError where no rest is found.
MissedAtRest missed_at_rest(const Mechanism& mechanism, const PreparedScene& prepared, const Parameters& parameters,
                            bool want_start);

}  // namespace boresight
