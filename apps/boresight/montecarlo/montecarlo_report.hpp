// The report of a Monte Carlo study.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/montecarlo/estimates.hpp"
#include "boresight_analyses/montecarlo/montecarlo.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

// A few samples in full, for scatter charts and tables: failed ones first, the others spread evenly over the study.
struct ShownSamples {
  std::vector<SampleRecord> done, failed;
  Failures failures;  // of all
};
inline constexpr std::size_t kMostShown = 1500, kMostFailedShown = 200;

struct MonteCarloStudy {
  const Command& command;
  const Study& study;
  const Mechanism& mechanism;
  const RungChoice& rung;
  const MonteCarloPlan& plan;
  const MonteCarloResult& result;
  const Estimates& estimates;
  const ShownSamples& shown;
  std::vector<std::string> warnings;
  std::string leaves_out;
  std::string replay;  // the command that runs one sample again, up to its number
};

// "p99.73" is "99.73 % of all lie below".
std::string headline_title(const std::string& name);
// "0.231 mm (0.229 mm to 0.234 mm)"; an end that the samples do not bound is "no bound".
std::string readable_interval(const ReportedInterval& interval, const std::string& si_unit, const std::string& written);
// The unit in which the requirement's limit is written; "": there is none.
std::string written_unit(const MonteCarloPlan& plan);
// The requirement and what was found, in a sentence.
std::string verdict_sentence(const MonteCarloStudy& study);

report::Document montecarlo_report(const MonteCarloStudy& study);

}  // namespace boresight::app
