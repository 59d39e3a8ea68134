// The pointing errors of a run as the terminal shows them, each with what is known of its own error.
#pragma once

#include <string>
#include <vector>

#include "boresight/stepping/measured_error.hpp"

namespace boresight::app {

// "position error       max    0.231 mm ± 2.3 %   RMS    0.195 mm ± 0.4 %"; without ± where nothing was measured. size: of the
// mechanism [m].
std::vector<std::string> error_lines(const RunResult& result, const MeasuredError& measured, double size);

}  // namespace boresight::app
