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

// From what a fit leaves, by the median, which outliers do not reach: a channel's sigma times 1.4826 median
// |r|, and the unknowns made up for; at least half of the problem's own sigma.
VecX noise_from_residuals(const CalibrationProblem& problem, const FitResult& fit);

struct ChannelNoises {
  VecX sigma;
  std::vector<int> shared;  // as CalibrationProblem::noise_of
};

// Of poses, by the squares that a fit leaves of each channel over the readings that are left over: restricted maximum likelihood where it has
// settled. However alike they look, channels keep their own: what weights add that follow the noise is known (channel_variances.hpp), and
// taken for one, two that differ by a factor of two make intervals of 95 % that hold 88 %, until hundreds of readings tell them apart.
// Those that have hardly more readings than unknowns that they tell could be followed exactly, and would weigh without bound: they share the noise
// of others, and so do those that shared before (`shared`; empty: none). told: of each channel; these keep the problem's sigma.
ChannelNoises noises_from_residuals(const CalibrationProblem& problem, const FitResult& fit,
                                    const std::vector<bool>& told, const std::vector<int>& shared);

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
