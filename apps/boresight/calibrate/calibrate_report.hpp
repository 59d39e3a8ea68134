// The report of a calibration.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/calibration/calibration_plan.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

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

report::Document calibrate_report(const CalibrationStudy& study);

}  // namespace boresight::app
