// What summary.json holds of a Monte Carlo study.
#pragma once

#include "boresight_analyses/runs/sample_store.hpp"
#include "montecarlo/montecarlo_report.hpp"
#include "results/verb_study.hpp"

namespace boresight::app {

Json montecarlo_summary(const MonteCarloStudy& study, const Stopwatch& watch, const VerbStudy& own,
                        const SampleStore& store);

}  // namespace boresight::app
