// A whole calibration: from data to parameters, what they are worth, and what to measure next.
//
// Order: noise from differences; masses that the data know better than they were told among the parameters; several
// starts on the first eighth of every run, side by side; the best of them on a horizon that grows up to the whole (so
// that impacts enter one after another); other valleys near the place it found; noise from the residuals, and once
// more. What the fit's rung leaves out and multibody has, in value and slope at the optimum, is then added to the model
// and the fit goes on until that moves nothing (first order model management: Alexandrov and Lewis 2001,
// Optimization and Engineering 2, 413-430).
#pragma once

#include <optional>

#include "boresight_analyses/calibration/law_comparison.hpp"
#include "boresight_analyses/calibration/next_test.hpp"
#include "boresight_analyses/calibration/posterior_draws.hpp"
#include "boresight_analyses/calibration/profile_likelihood.hpp"
#include "boresight_analyses/calibration/suspects.hpp"
#include "boresight_analyses/calibration/unexplained_channels.hpp"

namespace boresight {

struct CalibrationOptions {
  int jobs = 1;
  double confidence = 0.95;
  int starts = 4;
  std::uint64_t seed = 1;
  VecX noise;  // per channel of channel_names(), NaN: estimated; empty: all estimated
  // By multibody, at most; they end where one moves nothing. 0: none, and no confirmation.
  int corrections = 6;
  bool profile = false;
  std::optional<Discrepancy> discrepancy = Discrepancy{};  // how well the model is known; none: it is taken for exact
  std::optional<DrawOptions> draws;                        // of the posterior; none: by the fit's curvature alone
  std::vector<std::string> laws;                           // compared by the same data
  std::vector<Candidate> candidates;                       // of a next test
  // share: of the fit that is done, about; of the draws in their stage. False ends it.
  std::function<bool(const std::string& stage, double share, const std::string& estimate)> progress;
};
inline constexpr const char* kDrawsStage = "draws of the posterior";

struct StartFound {
  std::vector<double> from, to;
  double cost = 0.0;
};

struct CorrectionStep {
  std::vector<double> values;  // after it
  double largest_shift = 0.0;  // of a parameter's coordinate
  double difference = 0.0;  // rms over all readings of multibody less perturbation, in standard deviations of the noise
};

struct CalibrationResult {
  FitResult fit;
  Inference inference;
  std::vector<bool> fixed;
  std::vector<StartFound> starts;
  std::vector<CorrectionStep> corrections;
  double confirmation = -1.0;  // rms standardised residual of multibody itself at the optimum; -1: not computed
  std::optional<HoldOut> hold_out;
  std::vector<LawScore> laws;
  std::vector<Profile> profiles;
  std::optional<CalibrationModelError> model_error;
  std::optional<PosteriorDraws> draws;
  std::vector<NextTest> next_tests;
  std::vector<std::string> verdict;
  std::vector<std::string> warnings;  // of readings that no noise explains, `unexplained` among them
  std::vector<UnexplainedChannel> unexplained;
  long evaluations = 0;
  bool interrupted = false;
};

// problem: prepared; its sigma is set here, its data are corrected where options ask for it, and masses join its
// parameters. Throws ComputationError.
CalibrationResult calibrate(CalibrationProblem& problem, const CalibrationOptions& options);

}  // namespace boresight
