// The tables and charts of a pointing budget's report, and the words they share.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "budget/budget_report.hpp"
#include "results/scatter_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

std::string percent(double share);
// Angles in arcsec, lengths in the unit that suits the largest.
DisplayUnit budget_unit(const BudgetStudy& study, double largest);
std::string interval_text(const BudgetStudy& study, const ReportedInterval& interval, const std::string& written = "");
std::string standing_text(RuleStanding standing, double by_rule, double simulated);
// Why it cannot be told whether the rule is fair: what the members leave of it. "" where it can.
std::string rule_doubt(const BudgetStudy& study, const BudgetLevel& level);
const BudgetLevel& headline_level(const Budget& budget);
const char* source_of(const Budget& budget, const ErrorReduction& reduction);

report::Table requirement_table(const BudgetStudy& study, const Budget& budget);
report::Table level_table(const BudgetStudy& study, const Budget& budget);
report::Table contribution_table(const BudgetStudy& study, const Budget& budget);
report::Table relief_table(const BudgetStudy& study, const Budget& budget);
report::Table contributor_table(const BudgetStudy& study);
report::Table classical_table(const BudgetStudy& study, const ClassicalTable& table);
report::Table source_table(const BudgetStudy& study);

report::Chart level_chart(const BudgetStudy& study, const Budget& budget);
report::Chart waterfall_chart(const BudgetStudy& study, const Budget& budget);
report::Chart distribution_chart(const BudgetStudy& study, const Budget& budget);
report::Panels history_panels(const BudgetStudy& study, const Budget& budget);

void write_levels(std::ostream& out, const BudgetStudy& study, const Budget& budget);
void write_classical(std::ostream& out, const BudgetStudy& study, const Budget& budget);
void write_contributions(std::ostream& out, const Budget& budget);
Json budget_json(const BudgetStudy& study, const Budget& budget);

// Of sub-budgets.
report::Section tree_section(const BudgetStudy& study, const Budget& budget);
Json tree_json(const Budget& budget);
std::vector<std::string> tree_warnings(const BudgetStudy& study, const Budget& budget);
// Of requirements by exposure time.
report::Section jitter_section(const BudgetStudy& study, const Budget& budget);
Json jitter_json(const BudgetStudy& study, const Budget& budget);
// Of contributors with a spectrum.
report::Section spectra_section(const BudgetStudy& study, const Budget& budget);
void write_spectra(std::ostream& out, const BudgetStudy& study, const Budget& budget);
Json spectra_json(const Budget& budget);
// Of contributors with a course of their own that the histories' samples do not tell.
std::vector<std::string> courses_warnings(const BudgetStudy& study);
std::vector<std::string> spectra_warnings(const BudgetStudy& study, const Budget& budget);

}  // namespace boresight::app
