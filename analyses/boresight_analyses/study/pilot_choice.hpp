// How a pilot concludes, whichever question it was flown for.
#pragma once

#include "boresight_analyses/study/pilot.hpp"

namespace boresight {

// Two pilots for two questions; run_pilot() chooses.
PilotResult pilot_of_motions(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& motions,
                             const PilotOptions& options);
PilotResult pilot_of_scatter(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                             const PilotOptions& options);

// Picks the trial: of those accepted the cheapest; where the reference itself is worse than the accuracy the cheapest
// that follows the motion and cannot be told from it; else the nearest. Fills in chosen, met and why.
// Throws ComputationError where every trial was refused.
void conclude(PilotResult& result);

// Whether a trial that follows the motion cannot be told from a reference that is worse than the accuracy.
bool indistinguishable(const PilotTrial& trial, const PilotResult& result);

}  // namespace boresight
