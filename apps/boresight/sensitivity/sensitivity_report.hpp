// What the report of a sensitivity study shows: whose scatter makes the index scatter, alone and with the others; the tornado; where slopes
// mean something and where not.
#pragma once

#include "boresight_analyses/sensitivity/local_sensitivity.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"
#include "sensitivity/method_result.hpp"

namespace boresight::app {

struct SensitivityStudy {
  const Command& command;
  const Study& study;
  const Mechanism& mechanism;
  const RungChoice& rung;
  const SensitivityPlan& plan;
  const MethodResult* result;  // none: interrupted, or too few runs that did not fail
  const LocalResult& local;
  std::vector<SampleRecord> shown;  // some independent runs (the first of their rows), for the scatter plots
  bool interrupted = false;
  std::vector<std::string> warnings;
  std::string leaves_out;
  Failures failures = {};
};

report::Document sensitivity_report(const SensitivityStudy& study);

}  // namespace boresight::app
