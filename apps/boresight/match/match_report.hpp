// The report of a matching study.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/matching/matching.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

struct MatchStudy {
  const Command& command;
  const Study& study;
  const Mechanism& mechanism;
  const RungChoice& rung;
  const MatchingPlan& plan;
  const MatchingResult& result;
  std::vector<std::string> warnings;
  std::string leaves_out;
};

// "payload.mass = 5.1 kg, clearance.F1.radial = 0.1 mm".
std::string design_text(const MatchingPlan& plan, const std::vector<double>& design);
// In which unit the study writes a limit of this measure: "arcsec"; "": it has none.
std::string written_unit(const MatchingPlan& plan, Measure measure);
// The rung of the optimum's objective and constraints.
std::string rung_of_optimum(const MatchStudy& study);
// Each constraint's value at the optimum, by the rung that it is of, and the confirmation's beside it.
report::Table constraint_table(const MatchStudy& study);
// A value of the objective with four digits, in the unit in which `beside` is shown.
std::string objective_text(const MatchingPlan& plan, const IndexChoice& index, double value, double beside);
// Whether a design at the lower end of a variable's range is at 0 of what is never less, a mass or a size: nothing better lies beyond.
bool ends_at_nothing(const DesignVariable& variable, double at);
// "search: direct, descent: bobyqa", or how far it came where it was interrupted.
std::string search_text(const MatchingResult& result);
// The answer in a sentence.
std::string match_sentence(const MatchStudy& study);

report::Document match_report(const MatchStudy& study);

}  // namespace boresight::app
