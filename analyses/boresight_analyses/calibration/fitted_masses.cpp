// Masses that the data know better than they were told. One percent of a mass moves late readings by many valleys: taken as a straight line from
// where the fit ended it explains nothing, and the fit ends in the wrong valley without a sign of it. So such masses are fitted too, with what was
// told as a prior.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/calibration/calibrator.hpp"
#include "boresight_analyses/calibration/landscape.hpp"
#include "boresight_analyses/calibration/reduced_window.hpp"

namespace boresight {
namespace {

// Of what was told: a mass whose error the data leave smaller is fitted.
constexpr double kKnownBetter = 0.5;

// At a start: the error of each suspect, in deviations of what was told, were it alone in doubt beside what is fitted. The noise is as the
// problem has it.
VecX errors_alone(const CalibrationProblem& problem, const FitResult& at_start, const std::vector<Suspect>& suspects) {
  const Eigen::Index G = problem.global_count(), K = static_cast<Eigen::Index>(suspects.size());
  MatX M = MatX::Zero(G + K, G + K);
  for (std::size_t k = 0; k < at_start.windows.size(); ++k) {
    WindowResiduals at;
    problem.evaluate(problem.windows[at_start.windows[k]], at_start.globals, at_start.states[k], true, at);
    MatX X(at.r.size(), G + K);
    X.leftCols(G) = at.by_global;
    for (Eigen::Index s = 0; s < K; ++s) X.col(G + s) = suspects[s].change[k];
    M += X.transpose() * X;
  }
  VecX prior = VecX::Ones(G + 1);
  prior.head(G) = problem.prior_information();
  VecX errors(K);
  for (Eigen::Index s = 0; s < K; ++s) {
    std::vector<Eigen::Index> with(static_cast<std::size_t>(G) + 1);
    std::iota(with.begin(), with.end(), Eigen::Index{0});
    with.back() = G + s;
    errors[s] = std::sqrt(solved({M(with, with), VecX::Zero(G + 1), 0.0, 0.0}, prior, VecX::Zero(G + 1)).inverse(G, G));
  }
  return errors;
}

}  // namespace

void Calibrator::fit_masses_that_show() {
  const CalibrationRun& run = problem_.runs.front();
  // Of a motion that is simulated, masses decide where it goes: they stay suspects.
  if (!options_.discrepancy || !(options_.discrepancy->masses > 0.0) || !follows_from_rest(problem_) ||
      !is_kinematic(*run.mechanism))
    return;
  Discrepancy masses;
  masses.masses = options_.discrepancy->masses;
  masses.lag = 0.0;
  masses.law = false;
  for (int number = 0; number < std::max(1, options_.starts); ++number) {
    tell("masses that the data know", "");
    FitResult at_start;
    at_start.globals = start(number);
    at_start.windows = windows_of(problem_, {});
    at_start.states = guess_states(problem_, at_start.windows, at_start.globals, options_.jobs);
    std::vector<Suspect> suspected;
    VecX errors;
    try {
      suspected = suspects(problem_, at_start, masses, options_.jobs);
      errors = errors_alone(problem_, at_start, suspected);
    } catch (const ComputationError&) {
      continue;  // a motion that cannot be followed
    }
    const MechanismDescription& m = run.mechanism->description();
    for (std::size_t s = 0; s < suspected.size(); ++s) {
      if (!(errors[static_cast<Eigen::Index>(s)] < kKnownBetter)) continue;
      const ParameterPath place(m, suspected[s].name);
      const double told = place.get(run.told());
      // Runs that set a mass each in its own way have no one mass to fit: it stays a suspect.
      if (std::any_of(problem_.runs.begin(), problem_.runs.end(),
                      [&](const CalibrationRun& other) { return place.get(other.told()) != told; }))
        continue;
      problem_.parameters.push_back(fitted_parameter(m, suspected[s].name, told));
      problem_.parameters.back().has_prior = true;
      problem_.parameters.back().prior = masses.masses * told;
    }
    break;
  }
  result_.fixed.resize(static_cast<std::size_t>(problem_.parameter_count()), false);
}

}  // namespace boresight
