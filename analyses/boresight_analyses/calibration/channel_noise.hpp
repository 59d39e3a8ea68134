// How noisy each channel is, by its own data.
#pragma once

#include "boresight_analyses/calibration/calibration_fit.hpp"

namespace boresight {

// Standard deviation of the noise of each channel from second differences of neighbouring samples, robust
// against the few that an impact or an outlier bends: 1.4826 median |d2| / sqrt(6).
VecX noise_from_differences(const CalibrationProblem& problem);

inline constexpr double kNoiseOfSteps = 1e-6;
// What the steps of a model's motion leave in its readings, ten tolerances of one of them: this share of the smallest clearance, as an angle over
// the mechanism's size. No data where a play is followed tell more, however quiet they are.
VecX noise_of_steps(const CalibrationProblem& problem);

// A first guess for poses that have no neighbours: the median size of the readings of all channels of the same unit.
VecX noise_from_sizes(const CalibrationProblem& problem);

// The same of all channels of an instrument and a unit whose noises their numbers of readings cannot tell apart, root mean square over the readings:
// weights of each channel's own would follow the noise itself, and intervals be too narrow. What is a hundred times as quiet keeps its own.
// Channels that stand in one file of a run are of one instrument. Of others nothing says that they are alike: taken for that, two that differ by
// a factor of two make intervals of 95 % that hold 86 %. Only what has too few readings to have a noise of its own takes that of another.
// apart_by: standard deviations of their estimates from which on they count as unlike; 0: all of them that have readings enough to tell.
VecX pooled_where_alike(const CalibrationProblem& problem, const VecX& sigma, double apart_by);

// From what a fit leaves, by the median, which outliers do not reach: a channel's sigma times 1.4826 median
// |r|, and the unknowns made up for; at least half of the problem's own sigma.
VecX noise_from_residuals(const CalibrationProblem& problem, const FitResult& fit);

// A reading that no noise explains.
struct OutlyingReading {
  std::string file;
  int line = 0;
  int channel = 0;          // among channel_names()
  double deviations = 0.0;  // its residual in robust standard deviations of its channel's residuals
};

// Takes out of the data, as if they had not been measured, readings that stand alone: off what lies between their neighbours by more
// than a thousand times the noise and all changes around them. No motion does that from one sample to the next and back; in a fit one
// of them would outweigh the rest of the cost, so that it ends before the others are fitted. deviations: of the noise.
std::vector<OutlyingReading> leave_out_lone_readings(CalibrationProblem& problem);

// Those of more than ten, the largest first.
std::vector<OutlyingReading> outlying_readings(const CalibrationProblem& problem, const FitResult& fit);

}  // namespace boresight
