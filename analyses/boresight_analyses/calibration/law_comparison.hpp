// Scores by data: on windows kept out of the fit, and of contact laws held against each other.
#pragma once

#include <optional>

#include "boresight_analyses/calibration/calibration_fit.hpp"
#include "boresight_analyses/statistics/effective_samples.hpp"

namespace boresight {

struct HoldOut {
  long values = 0;
  double rms = 0.0;  // of the standardised residuals; 1: as good as the noise allows
};

struct LawScore {
  std::string law;
  double cost = 0.0, aic = 0.0, difference = 0.0;  // to the best
  long values = 0;
  int parameters = 0;         // estimated: those that the law responds to, start states, and the residuals' variance
  ResidualsOfBest residuals;  // its own, for the comparison where it fits best
  double effective_values = 0.0;  // that the comparison counts
  std::optional<double> held_out;
  std::string reason;  // for stopping
  int evaluations = 0;
};

// Every (1 / share)-th window is kept out of the fit.
void hold_out_windows(CalibrationProblem& problem, double share);
// Of the windows held out; their start states are guessed from their own data. Empty where there are none.
std::optional<HoldOut> score_held_out(const CalibrationProblem& problem, const Globals& globals, int jobs);

// The same data fitted under another contact law, from `start`; without its AIC.
LawScore law_score(const CalibrationProblem& problem, const std::string& law, const Globals& start,
                   const FitOptions& options);
// AIC (statistics/effective_samples.hpp), with the variance and the effective number of values of the law that fits best, and
// differences to the least.
void compare(std::vector<LawScore>& scores);

}  // namespace boresight
