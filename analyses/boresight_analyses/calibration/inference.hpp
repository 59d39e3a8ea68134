// What a fit's answer is worth: covariance, intervals, correlations, residuals.
//
// Start states are eliminated: with A = J_g - J_s (J_s' W J_s + P)^-1 J_s' W J_g, W = psi'(r), P the prior,
//   information                        H = sum A' W J_g
//   white residuals                    cov = s^2 H^-1,  s^2 = sum psi^2 / (N - k) / mean psi'
//                                      Huber (1981), section 7.6
//   channels with noises of their own, estimated by residuals: channel_variances.hpp adds to it, and has degrees of freedom for each estimate
//   with what was known before, Q      cov = M^-1 (s^2 H + Q) M^-1,  M = H + Q: the fit weighs both by the noise that it was told, and
//                                      its errors are those of that fit; what was known before is known as well as it was told
//   residuals that follow one another  cov = H^-1 (sum_l b_l sum_i s_i s_(i+l)') H^-1,  s_i = sum over channels of A_i psi_i,
//                                      with Bartlett weights b_l = 1 - |l| / (L + 1): Newey and West (1987)
//
// and L twice the lag behind which the residuals' autocorrelation is lost in its noise. All in the coordinates of the
// fit, where contact parameters are logarithms; intervals are mapped back and so stay physical.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/calibration/calibration_fit.hpp"
#include "boresight_analyses/calibration/confused_errors.hpp"

namespace boresight {

struct ParameterEstimate {
  std::string name;
  std::string si_unit;
  std::string written_unit;  // FittedParameter::written_unit
  double value = 0.0;
  double standard_error = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN(),
         high = low;                                             // by curvature, until profiles take its place
  double data_error = std::numeric_limits<double>::quiet_NaN();  // the standard error were the model without fault
  double coordinate_error = std::numeric_limits<double>::quiet_NaN();  // of u: the relative error of a logarithm
  bool identifiable = true;
  bool by_prior = false;   // the data say next to nothing of it: it is known as well as was assumed before
  std::string reason;      // why, or why not
  double quantile = 1.96;  // half of an interval over its error: Student's of the degrees of freedom of its error
  double student = 1.0;    // that, over a normal's
};

struct ResidualSeries {
  int run = 0, channel = 0;  // channel: among the problem's
  std::vector<double> time, residual, measured, model;
};

struct Inference {
  std::vector<ParameterEstimate> parameters;  // then time offset and biases
  MatX information, covariance, correlation;  // in coordinates, priors included; of the same
  MatX white_covariance;                      // inverse information, without s^2
  MatX
      departure;  // what channels' own noises add to the covariance of the scores beyond s^2: ChannelVariances; zero where all have one
  VecX growth;                           // of each variance, since residuals follow one another; no less than 1
  double variance_factor = 1.0;          // s^2
  double autocorrelation = 0.0;          // of neighbouring residuals
  int lags = 0;                          // L; 0: residuals are taken as white
  double per_independent_one = 1.0;      // residuals of a channel: statistics/effective_samples.hpp
  long values = 0;                       // N
  int unknowns = 0;                      // k, start states included
  int rank = 0;                          // directions of the parameters that the data see
  std::vector<ConfusedErrors> confused;  // standing errors that the data cannot tell apart
  std::vector<int> impacts;              // per clearance, in the fitted windows
  int grazing = 0;
  std::vector<ResidualSeries> residuals;
  std::vector<double> autocorrelations;  // by lag, from 0
};

// Whether the data know a parameter, by its errors; says it in e.reason. Leaves what was held, or is at a
// bound, as it is.
void assess_identifiability(const FittedParameter& parameter, ParameterEstimate& e);

// Contribution of one window (loss and start state as in the problem) to the information, and its scores
// sample by sample.
struct WindowInformation {
  MatX information;
  MatX scores;  // samples x globals
  MatX rows;    // what each value adds to the estimates by its noise: values x globals, channel after channel
};
WindowInformation window_information(const CalibrationProblem& problem, const Window& window,
                                     const WindowResiduals& at);

// fixed: parameters that were held; they get no error.
Inference infer(const CalibrationProblem& problem, const FitResult& fit, double confidence,
                const std::vector<bool>& fixed, int jobs);

// In words: what these data can and cannot tell, one sentence each; names pairs whose correlation is beyond
// 0.9.
std::vector<std::string> verdict(const CalibrationProblem& problem, const Inference& inference);

}  // namespace boresight
