// How a pilot concludes, whichever question it was flown for.
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

#include "boresight_analyses/study/pilot.hpp"

namespace boresight {

// Pairs of the scatter after which it is looked whether the answer is clear.
inline constexpr std::size_t kPairs[] = {6, 12, 24, 48, 96, 192};
inline constexpr std::size_t kMostPairs = kPairs[std::size(kPairs) - 1];
// What a pilot of the scatter may take [s of CPU], where a sample takes multibody so long.
double most_seconds(const PilotOptions& options, double multibody_seconds);
// In which statistics it says what the chosen way is off by, as PilotResult::errors has them.
std::vector<double> stated_probabilities(const ScatterStatistic& asked);

// Three pilots; run_pilot() chooses. Where no joint has play and standing errors alone move the boresight nothing is integrated and
// nothing scatters: the third one serves both questions.
PilotResult pilot_of_motions(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& motions,
                             const PilotOptions& options);
PilotResult pilot_of_scatter(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                             const PilotOptions& options);
PilotResult pilot_of_geometry(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                              const PilotOptions& options);

// Picks the trial: of those accepted the cheapest; where the reference itself is worse than the accuracy the cheapest
// that follows the motion and cannot be told from it; else the nearest. Fills in chosen, met and why.
// Throws ComputationError where every trial was refused.
void conclude(PilotResult& result);

// Whether a trial that follows the motion cannot be told from a reference that is worse than the accuracy.
bool indistinguishable(const PilotTrial& trial, const PilotResult& result);

}  // namespace boresight
