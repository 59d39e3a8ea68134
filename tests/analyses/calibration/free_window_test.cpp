// Windows that begin anywhere: their residuals' derivatives, their start states, and what they find together.
#include <gtest/gtest.h>

#include "four_bar_rig.hpp"

namespace boresight {
namespace {

using four_bar::Bench;
using four_bar::kFour;

CalibrationProblem windows_of(const Bench& bench, double length) {
  CalibrationProblem problem = bench.problem({}, kFour);
  problem.prepare(length, false);
  problem.sigma = noise_from_differences(problem);
  return problem;
}

Globals truth_of(const Bench& bench, const CalibrationProblem& problem) {
  Globals at = problem.start();
  for (int p = 0; p < problem.parameter_count(); ++p)
    at.u[p] = problem.parameters[p].coordinate(bench.truth(kFour[p]));
  return at;
}

TEST(FreeWindow, ResidualsChangeWithParametersAndStartStateAsDifferencesSay) {
  const Bench bench({2.4}, 0.06, false);
  CalibrationProblem problem = windows_of(bench, 0.012);
  const Globals at = truth_of(bench, problem);
  // The first window with an impact and without grazing.
  const Window* seen = nullptr;
  VecX state;
  WindowResiduals exact;
  for (const Window& window : problem.windows) {
    state = problem.guess_state(window, at);
    problem.evaluate(window, at, state, true, exact);
    if (!window.from_rest && !exact.motion.impact_speed.empty() && exact.motion.grazing.empty())
      seen = &window;
    if (seen != nullptr) break;
  }
  ASSERT_NE(seen, nullptr);
  const Window& window = *seen;
  problem.tolerance = problem.derivative_tolerance = 1e-12;
  problem.evaluate(window, at, state, true, exact);
  const int P = problem.parameter_count();
  for (int d = 0; d < P + problem.state_size(window); ++d) {
    const auto moved = [&](double by) {
      Globals there = at;
      VecX from = state;
      (d < P ? there.u[d] : from[d - P]) += by;
      WindowResiduals r;
      problem.evaluate(window, there, from, false, r);
      return r.r;
    };
    const auto central = [&](double h) { return VecX((moved(h) - moved(-h)) / (2.0 * h)); };
    const double h = 1e-4;
    const VecX differences = (4.0 * central(0.5 * h) - central(h)) / 3.0;
    const VecX by = d < P ? exact.by_global.col(d) : exact.by_state.col(d - P);
    EXPECT_LT((differences - by).norm(), 1e-6 * by.norm()) << "direction " << d;
  }
}

TEST(FreeWindow, AStartStateIsGuessedFromItsData) {
  const Bench bench({2.4}, 0.06, false);
  const CalibrationProblem problem = windows_of(bench, 0.012);
  const Globals at = truth_of(bench, problem);
  for (const Window& window : problem.windows) {
    const VecX state = problem.guess_state(window, at);
    const double values = 6.0 * (window.last - window.first + 1);
    EXPECT_LT(problem.cost(window, at, state), 1.5 * values) << "from " << window.start << " s";
  }
}

TEST(FreeWindowLong, FitsRecoverTheTruthWindowByWindow) {
  const Bench bench({2.0, 2.6}, 0.09, false);
  CalibrationProblem problem = windows_of(bench, 0.02);
  CalibrationOptions options;
  options.jobs = 2;
  options.starts = 1;
  options.corrections = 0;
  const CalibrationResult result = calibrate(problem, options);
  for (const ParameterEstimate& e : result.inference.parameters)
    EXPECT_LT(std::abs(e.value - bench.truth(e.name)), 4.0 * e.standard_error) << e.name;
  EXPECT_LT(result.inference.parameters[0].standard_error, 0.01 * result.inference.parameters[0].value);
}

}  // namespace
}  // namespace boresight
