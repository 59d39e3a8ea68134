// A whole calibration: from data to parameters, what they are worth, and what to measure next.
//
// Order: noise from differences; several starts on the first quarter of every run, side by side; the best of
// them on a horizon that doubles up to the whole (so that impacts enter one after another and the landscape
// stays smooth); noise from the residuals, and once more. Where the fit's rung leaves something out that
// multibody has, the difference of the two at the optimum is taken off the data and the fit goes on (output
// correction, as in space mapping: Bandler and others 2004, IEEE Transactions on Microwave Theory and
// Techniques 52, 337-361).
#pragma once

#include <optional>

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

struct Candidate {
  std::string name;
  std::shared_ptr<const Mechanism> mechanism;
};

struct CalibrationOptions {
  int jobs = 1;
  double confidence = 0.95;
  int starts = 4;
  std::uint64_t seed = 1;
  VecX noise;           // per channel of channel_names(), NaN: estimated; empty: all estimated
  int corrections = 2;  // on multibody; 0: none, and no confirmation
  bool profile = false;
  std::vector<std::string> laws;      // compared by the same data
  std::vector<Candidate> candidates;  // of a next test
  std::function<bool(const std::string& stage, double share, const std::string& estimate)> progress;
};

struct StartFound {
  std::vector<double> from, to;
  double cost = 0.0;
};

struct CorrectionStep {
  std::vector<double> values;  // after it
  double largest_shift = 0.0;  // of a parameter's coordinate
  double difference =
      0.0;  // rms over all readings of multibody less perturbation, in standard deviations of the noise
};

struct HoldOut {
  long values = 0;
  double rms = 0.0;  // of the standardised residuals; 1: as good as the noise allows
};

struct LawScore {
  std::string law;
  double cost = 0.0, aic = 0.0, difference = 0.0;  // to the best
  std::optional<double> held_out;
  std::string reason;  // for stopping
};

struct Profile {
  int parameter = 0;
  std::vector<double> value, cost_rise;  // the loss over its least, divided by s^2
  double low = 0.0, high = 0.0;  // where the rise reaches the chi-square quantile; NaN: not within reach
};

struct NextTest {
  std::string name;
  double d_gain = 0.0;              // log det of the information, gained
  double a_ratio = 0.0;             // sum of the relative variances, with it over without it
  std::vector<double> error_ratio;  // per parameter: standard error with it over without it
  std::string refusal;              // why it could not be tried
};

struct CalibrationResult {
  FitResult fit;
  Inference inference;
  std::vector<bool> fixed;
  std::vector<StartFound> starts;
  std::vector<CorrectionStep> corrections;
  double confirmation =
      -1.0;  // rms standardised residual of multibody itself at the optimum; -1: not computed
  std::optional<HoldOut> hold_out;
  std::vector<LawScore> laws;
  std::vector<Profile> profiles;
  std::vector<NextTest> next_tests;
  std::vector<std::string> verdict;
  long evaluations = 0;
  bool interrupted = false;
};

// problem: prepared; its sigma is set here, and its data are corrected where options ask for it. Throws
// ComputationError.
CalibrationResult calibrate(CalibrationProblem& problem, const CalibrationOptions& options);

// Random inputs of the same content for `montecarlo`: [[random]] and [[correlation]] tables of a study file.
std::string posterior_toml(const CalibrationProblem& problem, const CalibrationResult& result);

// Every `every`-th window is kept out of the fit.
void hold_out_windows(CalibrationProblem& problem, double share);

}  // namespace boresight
