// Plays that cannot move, because other joints hold the same parts: what a rung says of them, and the motion that it returns
// where no play can move at all: the ideal one, without a deviation.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/rungs/rung.hpp"

namespace boresight {

// One sentence for each play that cannot move; see play_mobility.hpp.
std::vector<std::string> held_plays(const Mechanism& mechanism, const IdealMotion& ideal);

// How far the bodies are off where no play moves: `state` gives them over time, `commanded` where they should be. The caller fills in the
// rung's name, its warnings and its error estimate. Histories have their samples where they were asked for.
// step: no longer than this from one instant to the next [s].
RunResult motion_without_play(const Mechanism& mechanism, const std::function<void(double, IdealState&)>& state,
                              const IdealMotion& commanded, const Parameters& parameters, const RunOptions& options,
                              double step);
// At as many instants as the motion asks for: a thousand, two from one knot of the commanded motion to the next, and more where between
// two of them an index may be higher than at any, by 1e-4 of its maximum. `state` is asked for increasing times, and again from the start.
RunResult motion_without_play(const Mechanism& mechanism, const std::function<void(double, IdealState&)>& state,
                              const IdealMotion& commanded, const Parameters& parameters, const RunOptions& options);
// The mechanism's own motion without clearance.
RunResult motion_without_play(const Mechanism& mechanism, const IdealMotion& ideal, const IdealMotion& commanded,
                              const Parameters& parameters, const RunOptions& options);

}  // namespace boresight
