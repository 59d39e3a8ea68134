// The report of `run`: how far off the mechanism points, when, and what happens in its joints.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command.hpp"
#include "report/document.hpp"

namespace boresight::app {

report::Document run_report(const Command& command, const Mechanism& mechanism, const RungChoice& rung,
                            const std::string& leaves_out, const RunResult& result);

}  // namespace boresight::app
