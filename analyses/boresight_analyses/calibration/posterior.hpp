// What a calibration knows of the parameters as random inputs of a study, so that it feeds Monte Carlo and
// the budget without retyping.
#pragma once

#include <string>

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

// [[random]] and [[correlation]] tables. Gaussian in the coordinates of the fit; a parameter that the data do
// not know is uniform over all that is allowed for it.
std::string posterior_toml(const CalibrationProblem& problem, const Inference& inference);

}  // namespace boresight
