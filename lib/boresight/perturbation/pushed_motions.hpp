// What the forces that the perturbation rung leaves out do to its indices: the motion again with what they miss as a load, and with what they
// accelerate more or less in the inverse mass, once added and once taken away; twice what that moves is stated. Where much hangs on little
// (when a journal lets go, which end of its sleeve it strikes, which of two rests it finds) that is more than the share of the forces which
// is missed; where contacts hold journals where they are, far less. So it takes that share's place.
//
// Where motions go their own ways, any load makes another one of many: what neighbouring steps scatter by as much is not taken for an error
// of the model beyond that share. measured_error.hpp states it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/perturbation/second_order.hpp"
#include "boresight/rungs/rung.hpp"
#include "boresight/scene/clearance_scene.hpp"

namespace boresight {

// So many steps after each other the rung asks whether to go on.
inline constexpr int kStepsBetweenLooks = 4096;

// The tables with `times` what is missed, by straight lines between its instants, added to their loads, to their inverse masses and to where
// offsets are that others decide; and to where motions start. What pushes journals once they move is no part of the balance they start in.
std::shared_ptr<const SceneTables> pushed_by(const SecondOrder& beyond, double times, double duration,
                                             const SceneTables& tables);

using FollowOn = std::function<RunResult(const std::shared_ptr<const SceneTables>&, const RunOptions&)>;

// Sets result.error.model to what the pose misses and such motions show. options: of `result`; tolerance: as error control had it. Motions
// that cannot be followed show nothing: result.error stays as it is. Where options.progress stops one, the result is interrupted.
void state_what_pushes_move(const SecondOrder& beyond, const Mechanism& mechanism,
                            const std::shared_ptr<const SceneTables>& tables, const RunOptions& options,
                            double tolerance, const FollowOn& follow, RunResult& result);

}  // namespace boresight
