// The HTML report of `chart`.
#pragma once

#include <optional>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/chart/chart.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

// How far off a way is, as far as the reference tells: "9.62 %"; "at most 0.0001 %" where it is nearer to it than that is known.
std::string off_text(const ChartResult& result, const ChartPoint& point);

// accuracy: asked for by the study or the command line.
report::Document chart_report(const Command& command, const Mechanism& mechanism, const ChartResult& result,
                              std::optional<double> accuracy);

// "no time was left for other steps of ...", of a family of ways that was begun or not.
std::string left_out_sentence(const ChartResult& result, const std::string& family);

// "AMD EPYC 7B13, 2 cores, GCC 12.2.0, optimised, load 1.2"
std::string machine_line(const Machine& machine);

}  // namespace boresight::app
