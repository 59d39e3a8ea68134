// Whether a motion's maxima are its own, or those of journals (or balls) that start free of their sleeves and first have to fall there.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight {

// From the finished contact summaries: RunResult::settled_from, and a warning where the maximum of an index lies before it.
void note_start_up(const Mechanism& mechanism, RunResult& result);

}  // namespace boresight
