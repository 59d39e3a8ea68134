// What Sun, Song and Wang state of the 3-RRCPR mechanism with clearance (sections 4 and 5 of their paper),
// held against the numbers of a sweep: each statement, what the sweep measured, whether they agree, and why
// it is so.
//
// Every verdict is a comparison of the sweep's own numbers (sweep/paper_facts.hpp). A statement shows only if an axis of the sweep
// speaks to it: one over clearance.*.radial or .axial, one over payload.mass.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/sweep/sweep.hpp"

namespace boresight::app {

struct PublishedFinding {
  // explained: the paper contradicts itself, or says what its model cannot show; the sweep decides.
  enum class Verdict { agrees, differs, explained };
  std::string statement;
  Verdict verdict = Verdict::agrees;
  std::string measured;
  std::string why;
};

// Points that were not done are passed over; an axis with fewer than two done points says nothing.
std::vector<PublishedFinding> published_findings(const Mechanism& mechanism, const SweepPlan& plan,
                                                 const SweepResult& result);

}  // namespace boresight::app
