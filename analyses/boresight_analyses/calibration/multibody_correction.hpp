// What multibody's readings are above those of the fit's rung, and how they change with the parameters.
//
// The fit's rung lets clearances bear on a motion whose bodies follow ideal ones; multibody lets them act
// back. The readings differ by less than the noise, but in the same way in every run; their slopes by
// stiffness differ by a third, and impacts that come and go with a parameter do so at other values of it.
// With value and slopes of its own the fit is multibody's Gauss-Newton, and so are its intervals.
#pragma once

#include "boresight_analyses/calibration/calibration_problem.hpp"

namespace boresight {

// Per run: samples x its channels [SI], zero where no window starts from rest. Throws ComputationError.
using Readings = std::vector<MatX>;

struct MultibodyAt {
  Readings reading, difference;         // its own; less those of the fit's rung
  Readings by_time, by_lag;             // of the fit's rung [SI/s]; zero unless the time offset, the lag is fitted
  std::vector<SensitiveMotion> motion;  // of the fit's rung
};
// On `jobs` threads; the problem's corrections have no say.
MultibodyAt multibody_at(const CalibrationProblem& problem, const Globals& at, int jobs);

// Multibody's slopes by each parameter's u, by central differences over `step` of it to either side: about a
// standard error, the width at which they matter. Zero where step is.
// By run, then parameter.
std::vector<std::vector<MatX>> multibody_slopes(const CalibrationProblem& problem, const Globals& at, const VecX& step,
                                                int jobs);

struct CorrectionSize {
  double difference = 0.0;    // rms of the difference, in standard deviations of the noise
  double confirmation = 0.0;  // rms of multibody's own standardised residuals, with the loss
};
CorrectionSize size_of(const CalibrationProblem& problem, const Globals& at, const MultibodyAt& multibody);

}  // namespace boresight
