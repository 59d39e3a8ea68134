// Monte Carlo studies on more than one rung: `fidelities` and `tail` of the [montecarlo] table. Each writes summary.json,
// its table and its report, and returns the exit status.
#pragma once

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/runs/model_samples.hpp"
#include "boresight_analyses/statistics/interval.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "command_line/command.hpp"
#include "command_line/montecarlo_study.hpp"
#include "report/document.hpp"
#include "results/output_directory.hpp"
#include "results/scatter_parts.hpp"
#include "results/summary.hpp"

namespace boresight::app {

struct SeveralRungs {
  const Command& command;
  const MonteCarloQuestion& question;
  const RunOptions& run;
  const OutputDirectory& out;
  const Stopwatch& watch;
};

int run_fidelities(const SeveralRungs& study);
int run_tail(const SeveralRungs& study);

// What the two share.
// At one step for all samples.
std::unique_ptr<SampleModel> model_on(const SeveralRungs& study, const std::string& rung);
RungChoice named_rung(const std::string& rung);
// summary.json that says whose folder this is and that the study has begun; nothing if one is there.
void claim_folder(const SeveralRungs& study);
// What every summary of a Monte Carlo study has; the report's head and end.
Json several_rungs_summary(const SeveralRungs& study, const std::string& rung,
                           const std::vector<std::string>& warnings);
report::Document several_rungs_report(const SeveralRungs& study, const std::string& rung, const std::string& leaves_out,
                                      const std::vector<std::string>& warnings);

}  // namespace boresight::app
