// What `run` says of each standing error's part in the motion's error: a table, charts over time, and parts.csv.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/study/error_parts.hpp"
#include "report/document.hpp"
#include "results/summary.hpp"

namespace boresight::app {

struct RunParts {
  ErrorParts found;
  std::string refusal;               // why nothing is known of any; "": it is
  std::vector<std::string> overrun;  // sentences on plays that the errors use up (overrun_play.hpp)
};

// Nothing where no error has a value.
std::optional<RunParts> run_parts(const Mechanism& mechanism, const RunResult& result);

report::Section parts_section(const RunParts& parts, const Mechanism& mechanism, const RunResult& result);
// One line for each of the largest, for the terminal.
std::vector<std::string> parts_lines(const RunParts& parts);
Json parts_json(const RunParts& parts);
// Per error and for all that is left the displacement and turn of the boresight body, columns as in timeseries.csv; one row per
// `every`th sample, and the last one.
void write_parts(std::ostream& out, const RunParts& parts, const RunResult& result, std::size_t every);

}  // namespace boresight::app
