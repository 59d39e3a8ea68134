// What an allocation leaves in files: summary.json and allocation.csv.
#pragma once

#include <iosfwd>

#include "allocate/allocate_report.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "results/verb_study.hpp"

namespace boresight::app {

Json allocate_summary(const AllocateStudy& study, const VerbStudy& own, const Stopwatch& watch,
                      const SampleStore::Cost& earlier);
void write_allocation(std::ostream& out, const AllocateStudy& study);

}  // namespace boresight::app
