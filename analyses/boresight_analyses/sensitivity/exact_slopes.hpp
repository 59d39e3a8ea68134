// The exact slopes of the motion at the medians beside the differences of local_sensitivity.hpp.
#pragma once

#include <memory>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/sensitivity/index_slopes.hpp"
#include "boresight_analyses/sensitivity/local_sensitivity.hpp"

namespace boresight {

// Fills in `exact`, or why there is none, of every parameter: of contacts only, on the perturbation rung's motion
// with its contacts located in time, and only where that motion stays predictable to its end (predictability.hpp).
// run: the offset at the start.
void add_exact_slopes(const std::shared_ptr<const Mechanism>& mechanism, const RandomInputs& inputs,
                      const IndexChoice& index, const RunOptions& run, LocalResult& local);

}  // namespace boresight
