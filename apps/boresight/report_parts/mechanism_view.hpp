// The mechanism in motion as the report's view draws it: its joints' points, ideal and as the run found them.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"
#include "report/document.hpp"

namespace boresight::app {

// Of RunOptions, for a motion that looks smooth in a report that stays small [s].
double view_frame_spacing(const Mechanism& mechanism);

// Lengths in mm. Needs at least one frame in the result.
report::View mechanism_view(const Mechanism& mechanism, const RunResult& result);

}  // namespace boresight::app
