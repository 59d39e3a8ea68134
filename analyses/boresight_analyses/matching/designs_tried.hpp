// The designs that stand for all of a matching's box while a rung and a step are looked for: its middle and its two far corners.
#pragma once

#include "boresight_analyses/matching/matching_plan.hpp"
#include "boresight_analyses/runs/study_run.hpp"

namespace boresight {

// Everything that scatters at its median: one motion each, which a common step is found by.
std::vector<Parameters> median_motions(const MatchingPlan& plan, const Mechanism& mechanism);

// As the search judges them: by draws of what scatters, for at its median an error shows nothing. designs: about as many as it asks for.
DesignsTried designs_tried(const MatchingPlan& plan, const Mechanism& mechanism, double designs);

}  // namespace boresight
