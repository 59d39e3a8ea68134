// Monte Carlo studies on more than one rung: `fidelities` and `tail` of the [montecarlo] table. Each writes summary.json,
// its table and its report, and returns the exit status.
#pragma once

#include <optional>

#include "boresight_analyses/statistics/interval.hpp"
#include "command_line/montecarlo_study.hpp"
#include "report/document.hpp"
#include "results/scatter_parts.hpp"
#include "results/verb_study.hpp"

namespace boresight::app {

struct SeveralRungs {
  const Command& command;
  const MonteCarloQuestion& question;
  const VerbStudy& own;
  const Stopwatch& watch;
};

int run_fidelities(const SeveralRungs& study);
int run_tail(const SeveralRungs& study);

// What the two share. A requirement as a study answers it: by the share within its limit, and by the share if every sample were larger by
// what the rung and its steps may be off by.
struct RequirementShown {
  ReportedInterval share;  // of one-sided bounds
  std::optional<ReportedInterval> within_error = {};
  double model_error = 0.0;  // relative
  bool met_by_samples = false, met = false;
};
// excess: one minus the shares.
RequirementShown requirement_shown(const Requirement& requirement, const IndependentInterval& excess,
                                   const IndependentInterval* excess_within_error, double model_error);
Json requirement_json(const Requirement& requirement, const RequirementShown& shown);
// "the requirement is met", or what is missing.
std::string requirement_words(const RequirementShown& shown, const std::string& rung);
// What the rung and its steps may be off by, as summaries state it.
Json model_error_json(const std::string& rung, double rung_error, const StudySteps& steps);

RungChoice named_rung(const std::string& rung);
// What a reader should know of how motions start, and of what the budget decides.
std::vector<std::string> several_rungs_warnings(const SeveralRungs& study);
// Where so much CPU [s] was spent that a reader who set the budget should know why; "" elsewhere.
std::string overspent(double spent, double budget);
// What every summary of a Monte Carlo study has; the report's head and end. data: where what it shows is kept.
Json several_rungs_summary(const SeveralRungs& study, const std::string& rung, const std::vector<std::string>& warnings,
                           const SampleStore::Cost& earlier);
report::Document several_rungs_report(const SeveralRungs& study, const std::string& rung, const std::string& leaves_out,
                                      const std::string& data, const std::vector<std::string>& warnings);

}  // namespace boresight::app
