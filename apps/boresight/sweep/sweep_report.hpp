// The report of `sweep`: the index against its parameters, and the motions over one another.
#pragma once

#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "boresight_analyses/sweep/sweep.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

report::Document sweep_report(const Command& command, const Study& study, const Mechanism& mechanism,
                              const RungChoice& rung, const std::string& leaves_out, const SweepPlan& plan,
                              const SweepResult& result);

// What its points warn of: each warning once, at the first point that has it, and at how many it is; those that differ in numbers alone are one.
std::vector<std::string> told_of_points(const SweepPlan& plan, const SweepResult& result);

// "clearance.F1.radial = 0.1 mm, payload.mass = 250 kg", or without names where there is one axis.
std::string point_name(const SweepPlan& plan, const SweepPoint& point, bool with_parameters);

}  // namespace boresight::app
