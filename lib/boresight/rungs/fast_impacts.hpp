// Impacts that are faster than what contact laws are valid to.
#pragma once

#include "boresight/rungs/run_result.hpp"

namespace boresight {

// From the finished contact summaries: a warning for each joint with impacts beyond Love's speed.
void note_fast_impacts(RunResult& result);

}  // namespace boresight
