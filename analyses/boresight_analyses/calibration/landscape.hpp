// The landscape of the loss: impacts make valleys beside valleys in it. Where a fit should look before it
// believes that it stands in the lowest. Along contact parameters: by standing errors the loss is a parabola.
#pragma once

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

// Whether any run is followed from rest: then its horizon can grow, and no start state has to follow a
// parameter.
bool follows_from_rest(const CalibrationProblem& problem);

// Motions no closer than a search needs: residuals may jitter by a hundredth of the noise.
void loosen(CalibrationProblem& problem);

// The problem with its runs followed up to a share of the whole only, motions no closer than a search needs.
CalibrationProblem searched_up_to(const CalibrationProblem& problem, double share);

// Whether steps as fine as the problem's lead where finer ones do, of all runs from rest, as closely as a search needs (foretold_data.cpp).
bool steps_suffice(const CalibrationProblem& part, const Globals& at, int jobs);

// A place a step of the packed globals away, within bounds. Not finite (a held parameter has no covariance): no step.
Globals moved_along(const CalibrationProblem& problem, const Globals& from, const VecX& step);

// The loss over all windows that count, those from rest alone; start states as they rest.
double loss_at(const CalibrationProblem& problem, const Globals& at);

// Whether the residuals of any run are not those of noise there: their upper quartile is larger by more than
// a quarter, or neighbours follow one another (a stretch that the motion does not meet). Gross outliers, a
// tenth of the readings, do neither.
bool leaves_more_than_noise(const CalibrationProblem& problem, const Globals& at);

// Away from an optimum by some standard errors of a parameter, along the line on which all others follow it,
// the loss rises as the parabola of the information says, unless another valley is near. Places, 3 to 24
// standard errors off, where it rises by less than half of that, the most surprising first. evaluations:
// counted up.
std::vector<Globals> other_valleys(const CalibrationProblem& problem, const FitResult& fit, const Inference& inference,
                                   const std::vector<bool>& fixed, int jobs, long& evaluations);

}  // namespace boresight
