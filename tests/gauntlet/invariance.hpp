#pragma once

#include <string>

#include "scene_runs.hpp"

namespace boresight::gauntlet {

// The same drawing elsewhere, turned, with other names, backwards, in other units: the same figures, but for what chaos
// makes of rounding, and perturbation's tables of interpolation. Rungs that answer must answer, and refuse where they refuse.
// text: of the scene's file.
void compare_variants(SceneRuns& runs, const std::string& text, Verdict& verdict, const TrialOptions& options);

}  // namespace boresight::gauntlet
