// What the summaries of verbs with many samples share: intervals, and why samples failed.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/statistics/interval.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "results/summary.hpp"

namespace boresight::app {

Json number_json(double value);  // NaN and infinity, which JSON has not, are null
// Of a relative error, in a report's column of percentages: the number, or words where it is many times the value itself.
Json error_cell(double relative);
Json interval_json(const ReportedInterval& interval);

// For a warning that samples failed: why, from the first of them. what: "sample", "run", ...
std::string first_failure_text(const Failures& failures, const std::string& what);
// Puts it into a summary, where there is one.
void add_first_failure(Json& summary, const Failures& failures, const std::string& what);

}  // namespace boresight::app
