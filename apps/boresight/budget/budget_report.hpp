// The report of a pointing budget, and the sentences that the terminal shares with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/budget/budget.hpp"
#include "boresight_analyses/runs/study_run.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

struct BudgetStudy {
  const Command& command;
  const Study& study;
  const Mechanism& mechanism;
  const RungChoice& rung;
  const BudgetPlan& plan;
  const BudgetRuns& runs;
  const std::optional<Budget>& budget;  // none: interrupted before all runs were there
  std::vector<std::string> warnings;
  std::string leaves_out;
  double step = 0.0;         // of the runs [s]; 0: their own
  double model_error = 0.0;  // what the rung thinks of itself, relative, mean over the runs
  StudySteps steps = {};

  BudgetAxes axes() const { return BudgetAxes(study.index.kind()); }
};

// What a number was made from. Every table of the report and every entry of summary.json names one of them by its
// letter.
struct BudgetSource {
  const char* letter;
  std::string what;
  std::string runs;  // numbers in samples.db; "" where none are
};
std::vector<BudgetSource> budget_sources(const BudgetStudy& study);
inline constexpr const char* kFromMembers = "M";
inline constexpr const char* kFromNominal = "N";
inline constexpr const char* kFromAttribution = "A";
inline constexpr const char* kFromClasses = "C";
inline constexpr const char* kFromInfluence = "I";
inline constexpr const char* kFromCalibration = "P";  // what scatters, where it was read from a posterior

// Which calibration a posterior is from, and which data that saw: from the summary beside it. Without one it says so.
std::string posterior_origin(const BudgetPlan& plan);

// "APE, half cone, mixed, 95 %": of a level or a requirement.
std::string level_title(const BudgetAxes& axes, ErrorIndex index, std::size_t axis, Interpretation interpretation,
                        double probability);
// Of a requirement; of jitter with its exposure: "RPE over 10 ms, half cone, mixed, 95 %".
std::string requirement_title(const BudgetStudy& study, const BudgetRequirement& asked);
// The answer to the requirement that shares and reliefs are about; null: there is none.
const RequirementAnswer* headline_answer(const Budget& budget);
// Angles in arcsec, lengths in the unit that suits them.
std::string budget_value(const BudgetStudy& study, double value);
// Beside a limit or an allocation of its own: in the unit that this is typed in.
std::string budget_value(const BudgetStudy& study, double value, const std::string& written);
// A limit, or what is allocated: as it is typed, with all its digits.
std::string budget_limit(const BudgetStudy& study, double value, const std::string& written);
std::string requirement_sentence(const BudgetStudy& study, const RequirementAnswer& answer);
std::string budget_verdict(const BudgetStudy& study);

report::Document budget_report(const BudgetStudy& study);

}  // namespace boresight::app
