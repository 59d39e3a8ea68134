// What a calibration takes as known, and how well it is known unless a study says better: drawings give an axial gap to a fifth, scales and
// CAD a mass to a percent, a sensor's filter lags by tenths of a millisecond, and the damping law is one of several that mean the same by a
// restitution.
#pragma once

#include "boresight_analyses/calibration/model_error.hpp"

namespace boresight {

// One standard deviation each; 0: exact.
struct Discrepancy {
  double axial = 0.2;    // of a fitted clearance's axial gap, relative
  double masses = 0.01;  // of every body's mass, each by itself, relative
  double lag = 2e-4;     // of the sensor [s]
  bool law = true;       // whether the damping law may be another one of its family
};

// Lets the clock of the rig be off by as much as a sensor may lag, unless an offset is fitted anyway. Before prepare().
void allow_for_lag(CalibrationProblem& problem, const Discrepancy& discrepancy);

// At the fit, those that are not fitted themselves.
std::vector<Suspect> suspects(const CalibrationProblem& problem, const FitResult& fit, const Discrepancy& discrepancy,
                              int jobs);

}  // namespace boresight
