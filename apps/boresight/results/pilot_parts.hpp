// What the pilot tried and found, for summary.json and the report.
#pragma once

#include <nlohmann/json.hpp>

#include "boresight_analyses/study/pilot.hpp"
#include "report/document.hpp"

namespace boresight::app {

nlohmann::ordered_json pilot_json(const PilotResult& pilot);

// Error against CPU time of every trial, with the accuracy asked for and the reference's own uncertainty; and the table.
report::Section pilot_section(const PilotResult& pilot);

}  // namespace boresight::app
