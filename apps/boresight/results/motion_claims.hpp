// What is said of a motion beside what its rung says, whoever asked for it.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight::app {

// Throws ComputationError where an index or a load left what a double holds, or a contact is as deep as its insert is thick
// (rungs/pressed_through.hpp): such numbers are no results. parameters: of that run.
void refuse_absurd(const Mechanism& mechanism, const Parameters& parameters, const RunResult& result);

// A warning of each contact that went beyond what its law holds for. parameters: of that run.
void add_range_warnings(const Mechanism& mechanism, const Parameters& parameters, RunResult& result);

}  // namespace boresight::app
