// What the verbs over scattered parameters share: montecarlo, sensitivity.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/statistics/interval.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "summary.hpp"

namespace boresight::app {

Json number_json(double value);  // NaN and infinity, which JSON has not, are null
Json interval_json(const ReportedInterval& interval);

std::vector<std::string> names_of(const RandomInputs& inputs);
// For a warning that samples failed: why, from the first of them. what: "sample", "run", ...
std::string first_failure_text(const Failures& failures, const std::string& what);
// Puts it into a summary, where there is one.
void add_first_failure(Json& summary, const Failures& failures, const std::string& what);

// Whether some parameter changes more than contacts: the scene (masses, gravity, springs) is then another one each time.
bool scene_varies(const RandomInputs& inputs);
// The scatter's middle and two corners: where the step that all samples share is looked for.
std::vector<Parameters> pilot_samples(const RandomInputs& inputs, const Mechanism& mechanism);
// So many plain draws of the scatter, for a pilot: the same ones each time, and not those of the study.
std::vector<Parameters> draws_of_scatter(const RandomInputs& inputs, const Mechanism& mechanism, std::size_t count);
// Of which a pilot ranks as many as it has time for, and pairs a few.
inline constexpr std::size_t kDrawsForPilot = 256;

}  // namespace boresight::app
