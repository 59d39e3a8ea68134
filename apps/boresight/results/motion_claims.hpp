// What is said of a motion beside what its rung says, whoever asked for it.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight::app {

// Throws ComputationError where an index or a load left what a double holds, or a contact is as deep as its insert is thick
// (rungs/pressed_through.hpp): such numbers are no results. parameters: of that run.
void refuse_absurd(const Mechanism& mechanism, const Parameters& parameters, const RunResult& result);

// A warning of each joint whose turns, and of each contact whose law, go beyond what they hold for. loads: the largest across each clearance's
// axis [N], in their order; of fewer, the laws of those.
std::vector<std::string> range_warnings(const Mechanism& mechanism, const Parameters& parameters,
                                        const std::vector<double>& loads);
// Those of a run, under the largest forces that it found. parameters: of that run.
void add_range_warnings(const Mechanism& mechanism, const Parameters& parameters, RunResult& result);

}  // namespace boresight::app
