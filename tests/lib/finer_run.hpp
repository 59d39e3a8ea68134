// A run as another one chose to go, but finer: what errors are held against.
#pragma once

#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/rungs/rung.hpp"

namespace boresight {

// options: of `own`, which had no step and no integrator asked for. share: of its step; where rosenbrock took over, of its longest step, and a
// fifth of that of its tolerance.
inline RunOptions finer_run(RunOptions options, const RunResult& own, double share) {
  if (own.integrator_taken.empty()) {
    options.step = share * own.end_time / static_cast<double>(own.cost.steps);
    return options;
  }
  options.integrator = own.integrator_taken;
  options.share_of_longest_step = share;
  options.tolerance = 0.2 * share * tolerance_of({}, own.rung);
  return options;
}

}  // namespace boresight
