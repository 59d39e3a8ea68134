// The report of a calibration.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/calibration/calibration_plan.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

struct CalibrationStudy {
  const Command& command;
  const Study& study;
  const Mechanism& mechanism;
  const RungChoice& rung;
  const CalibrationPlan& plan;
  const CalibrationProblem& problem;
  const CalibrationResult& result;
};

// What an estimate is shown in: as the study writes it, else as people read it.
DisplayUnit unit_of_estimate(const ParameterEstimate& estimate);
std::string written_unit_of(const KnownCombination& combination, const CalibrationProblem& problem);

report::Document calibrate_report(const CalibrationStudy& study);

}  // namespace boresight::app
