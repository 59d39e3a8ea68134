// What the report of a sensitivity study shows: whose scatter makes the index scatter, alone and with the others; the tornado; where slopes
// mean something and where not.
#pragma once

#include "boresight_analyses/sensitivity/local_sensitivity.hpp"
#include "boresight_analyses/sensitivity/sensitivity.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

struct SensitivityStudy {
  const Command& command;
  const Study& study;
  const Mechanism& mechanism;
  const RungChoice& rung;
  const SensitivityPlan& plan;
  const std::optional<GlobalSensitivity>& global;  // none: interrupted, or too few runs that did not fail
  const LocalResult& local;
  std::vector<SampleRecord> shown;  // some independent runs (points a), for the scatter plots
  bool interrupted = false;
  std::vector<std::string> warnings;
  std::string leaves_out;
  Failures failures = {};
};

// "radial clearance of F1 makes 71 % of the variance"; for the terminal and the report's head.
std::string sensitivity_sentence(const SensitivityStudy& study);

report::Document sensitivity_report(const SensitivityStudy& study);

}  // namespace boresight::app
