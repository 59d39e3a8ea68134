// What multibody's readings are above those of the fit's rung, and how that changes with the parameters.
//
// The fit's rung bears on a motion whose bodies follow ideal ones; multibody lets them act back. The readings
// differ by less than the noise, but in the same way in every run, and so does their slope by stiffness, by a
// third. An offset alone leads to the right place by J_p' r = 0, with an error that the slope J_p
// understates; with the difference of slopes as well the fit is multibody's own Gauss-Newton, and so are its
// intervals.
#pragma once

#include "boresight_analyses/calibration/calibration_problem.hpp"

namespace boresight {

// Per run: samples x its channels [SI], zero where no window starts from rest. Throws ComputationError.
using ReadingDifference = std::vector<MatX>;

// Multibody less the fit's rung (without its corrections) at each of the points, on `jobs` threads.
std::vector<ReadingDifference> multibody_differences(const CalibrationProblem& problem,
                                                     const std::vector<Globals>& points, int jobs);

// Slopes of the difference by each parameter's u, by central differences over `step` of it (about a standard
// error: derivatives of multibody at the width that matters). Zero where step is. [run][parameter]
std::vector<std::vector<MatX>> multibody_slopes(const CalibrationProblem& problem, const Globals& at,
                                                const VecX& step, int jobs);

struct CorrectionSize {
  double difference = 0.0;    // rms of the difference, in standard deviations of the noise
  double confirmation = 0.0;  // rms of multibody's own standardised residuals, with the loss
};
CorrectionSize size_of(const CalibrationProblem& problem, const Globals& at,
                       const ReadingDifference& difference);

}  // namespace boresight
