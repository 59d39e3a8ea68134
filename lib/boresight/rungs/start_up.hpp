// Whether a motion's maxima are its own, or those of journals that start free of their sleeves and first have to fall there.
#pragma once

#include "boresight/rungs/run_result.hpp"

namespace boresight {

// From the finished contact summaries: RunResult::settled_from, and a warning where the maximum of an index lies before it.
void note_start_up(RunResult& result);

}  // namespace boresight
