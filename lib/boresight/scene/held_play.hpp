// Plays that cannot move, because other joints hold the same parts: what a rung says of them, and the motion that it returns
// where no play can move at all: the ideal one, without a deviation.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/rungs/rung.hpp"

namespace boresight {

// One sentence for each play that cannot move; see play_mobility.hpp.
std::vector<std::string> held_plays(const Mechanism& mechanism, const IdealMotion& ideal);

// The caller fills in the rung's name and its warnings.
RunResult motion_without_play(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters,
                              const RunOptions& options);

}  // namespace boresight
