// The exact slopes of the motion at the medians beside the differences of local_sensitivity.hpp.
#pragma once

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/sensitivity/index_slopes.hpp"
#include "boresight_analyses/sensitivity/local_sensitivity.hpp"

namespace boresight {

// Fills in `exact`, or why there is none, of every parameter: of contacts only, on the perturbation rung's
// motion with its contacts located in time. run: the offset at the start.
void add_exact_slopes(const Mechanism& mechanism, const RandomInputs& inputs, const IndexChoice& index,
                      const RunOptions& run, LocalResult& local);

}  // namespace boresight
