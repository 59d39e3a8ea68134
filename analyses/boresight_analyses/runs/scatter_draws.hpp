// Samples of a scatter that a pilot looks at before a study begins.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"

namespace boresight {

// Whether some parameter changes more than contacts and standing errors: the scene (masses, gravity, springs) is then another one each time.
bool scene_varies(const std::vector<std::string>& paths);
bool scene_varies(const RandomInputs& inputs);
// The scatter's middle and two corners: where the step that all samples share is looked for.
std::vector<Parameters> pilot_samples(const RandomInputs& inputs, const Mechanism& mechanism);
// So many plain draws of the scatter, for a pilot: the same ones each time, and not those of the study. Values of the inputs, or
// the mechanism's own parameters with them.
std::vector<std::vector<double>> drawn_values(const RandomInputs& inputs, std::size_t count);
std::vector<Parameters> draws_of_scatter(const RandomInputs& inputs, const Mechanism& mechanism, std::size_t count);
// Of which a pilot ranks as many as it has time for, and pairs a few.
inline constexpr std::size_t kDrawsForPilot = 256;

}  // namespace boresight
