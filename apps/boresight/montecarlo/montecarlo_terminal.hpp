// What `montecarlo` says on the terminal: before it begins, on its way, and at its end.
#pragma once

#include "boresight_analyses/montecarlo/montecarlo.hpp"
#include "boresight_analyses/runs/study_run.hpp"
#include "command_line/montecarlo_study.hpp"
#include "montecarlo/montecarlo_report.hpp"
#include "results/output_directory.hpp"

namespace boresight::app {

// stored: samples that the store has already.
void announce(const MonteCarloQuestion& question, const RungChoice& choice, bool accuracy_asked, std::uint64_t stored,
              int ranks);
void show(Stage& stage, const MonteCarloProgress& p, const MonteCarloQuestion& question);
void print(const MonteCarloStudy& s, const OutputDirectory& out);

}  // namespace boresight::app
