// What a calibration knows of the parameters as random inputs of a study, so that it feeds Monte Carlo and
// the budget without retyping.
#pragma once

#include <string>

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

// [[random]] and [[correlation]] tables. Gaussian in the coordinates of the fit, and as wide as the intervals where few readings make these
// Student's; a parameter of a contact that the data do not know is
// uniform over all that is allowed for it. Of standing errors at poses that the data know together only, each is what it may well be and
// what they are together is what the data tell.
std::string posterior_toml(const CalibrationProblem& problem, const Inference& inference);

// A distribution in TOML: uniform over all that is allowed for a parameter that the data do not show.
std::string all_allowed(const FittedParameter& parameter);

}  // namespace boresight
