// The report of an allocation.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/allocation/allocation.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

struct AllocateStudy {
  const Command& command;
  const Study& study;
  const Mechanism& mechanism;
  const RungChoice& rung;
  const AllocationPlan& plan;
  const AllocationResult& result;
  std::vector<std::string> warnings;
  std::string leaves_out;
};

// The option of a joint or an error: "20 H7/f7", "ground", or its tolerance.
std::string option_text(const AllocateStudy& study, const Allocation& allocation, std::size_t joint);
// Whether an allocation is unsafe, wasteful, or neither, against the chosen one.
std::string standing_of(const AllocateStudy& study, const Allocation& allocation);
// The answer in a sentence.
std::string allocate_sentence(const AllocateStudy& study);
// "keeping the limit by 1 µm tighter costs 3.2 more".
std::string last_micro_sentence(const AllocateStudy& study);
std::string requirement_text(const AllocateStudy& study);

report::Document allocate_report(const AllocateStudy& study);

}  // namespace boresight::app
