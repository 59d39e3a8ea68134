// Fits a calibration problem with Ceres: parameters shared by all windows, a start state for each.
//
// Levenberg-Marquardt with bounds on the coordinates; the start states are eliminated first (Schur
// complement), so the system that is solved has as many unknowns as there are parameters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight_analyses/calibration/calibration_problem.hpp"
#include "boresight_analyses/threads/on_threads.hpp"

namespace boresight {

struct FitProgress {
  int iteration = 0, most_iterations = 0;
  double cost = 0.0;  // infinite: the motion of the start cannot be followed
  Globals globals;
};

struct FitOptions {
  int jobs = 1;
  int most_iterations = 40;
  double cost_tolerance = 1e-6;       // relative change of the cost at which it stops
  double parameter_tolerance = 1e-5;  // relative step at which it stops
  // Of what one value leaves: a step that promises no more and does not keep it shows how rough the landscape is, and ends the fit.
  double least_gain = 0.01;
  // Of trust, in sizes of the Jacobian's columns: 1e4 lets whole Gauss-Newton steps go, which from afar lead over the ridges between narrow optima.
  double first_radius = 1e4;
  std::vector<int> windows;  // those that count; empty: all that are not held out
  std::vector<bool> fixed;   // parameters that stay; empty: none
  bool fix_nuisance = false;
  std::function<bool(const FitProgress&)> progress;  // return false to stop
};

struct FitResult {
  Globals globals;
  std::vector<int> windows;
  std::vector<VecX> states;             // of `windows`, scaled
  double start_cost = 0.0, cost = 0.0;  // sum of the losses, priors included
  int iterations = 0, evaluations = 0;
  bool converged = false, interrupted = false;
  std::string reason;  // for stopping, in words
};

// The windows of options.windows, or all that are not held out.
std::vector<int> windows_of(const CalibrationProblem& problem, const FitOptions& options);
// First guesses of their start states, on `jobs` threads.
std::vector<VecX> guess_states(const CalibrationProblem& problem, const std::vector<int>& windows,
                               const Globals& globals, int jobs);

// states: of the windows, or empty: guessed.
FitResult fit(const CalibrationProblem& problem, const Globals& start, std::vector<VecX> states,
              const FitOptions& options);

}  // namespace boresight
