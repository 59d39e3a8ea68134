// Windows that begin anywhere: their residuals' derivatives, their start states, and what they find together.
#include <gtest/gtest.h>

#include <limits>

#include "boresight_analyses/calibration/law_comparison.hpp"
#include "four_bar_rig.hpp"

namespace boresight {
namespace free_window_test {

using four_bar::Bench;
using four_bar::kFour;
using four_bar::truth_of;

CalibrationProblem windows_of(const Bench& bench, double length) {
  CalibrationProblem problem = bench.problem({}, kFour);
  problem.prepare(length, false);
  problem.sigma = noise_from_differences(problem);
  return problem;
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
    if (!window.from_rest && !exact.motion.impact_speed.empty() && exact.motion.grazing.empty()) seen = &window;
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

TEST(FreeWindow, AStartStateWhoseMotionTakesTooManyStepsHasNoCostAndIsLeft) {
  const Bench bench({2.4}, 0.06, false);
  const CalibrationProblem problem = windows_of(bench, 0.012);
  const Globals at = truth_of(bench, problem);
  Window window = problem.windows.back();
  ASSERT_FALSE(window.from_rest);
  const VecX guess = problem.guess_state(window, at);
  VecX state = guess;
  window.most_steps = 3;
  EXPECT_EQ(problem.refine_state(window, at, state, 4), std::numeric_limits<double>::infinity());
  EXPECT_EQ(state, guess);
}

// Of the residuals of a window that starts freely, as many as its start state has numbers are used up by it.
TEST(FreeWindow, HeldOutOnesAreScoredByWhatTheirStartStatesLeave) {
  const Bench bench({2.4}, 0.06, false);
  CalibrationProblem problem = windows_of(bench, 0.012);
  const Globals at = truth_of(bench, problem);
  EXPECT_FALSE(score_held_out(problem, at, 1));
  hold_out_windows(problem, 0.5);
  long values = 0;
  for (std::size_t w = 0; w < problem.windows.size(); ++w) {
    const Window& window = problem.windows[w];
    EXPECT_EQ(window.held_out, w % 2 == 1);
    if (window.held_out) values += 6 * (window.last - window.first + 1) - problem.state_size(window);
  }
  const auto score = score_held_out(problem, at, 1);
  ASSERT_TRUE(score);
  EXPECT_EQ(score->values, values);
  EXPECT_GT(values, 50);
  // Three deviations of a root mean square of so many.
  EXPECT_NEAR(score->rms, 1.0, 3.0 / std::sqrt(2.0 * static_cast<double>(values)));
}

TEST(FreeWindowLong, FitsRecoverTheTruthWindowByWindowWithAnyNumberOfThreads) {
  const Bench bench({2.0, 2.6}, 0.09, false);
  CalibrationProblem problem = windows_of(bench, 0.02), again = problem;
  CalibrationOptions options;
  options.jobs = 2;
  options.starts = 1;
  options.corrections = 0;
  const CalibrationResult result = calibrate(problem, options);
  // To the last bit: threads that are faster or slower do not change the fit.
  options.jobs = 3;
  const CalibrationResult other = calibrate(again, options);
  for (std::size_t p = 0; p < result.inference.parameters.size(); ++p)
    EXPECT_EQ(result.inference.parameters[p].value, other.inference.parameters[p].value);
  for (const ParameterEstimate& e : result.inference.parameters)
    EXPECT_LT(std::abs(e.value - bench.truth(e.name)), 4.0 * e.standard_error) << e.name;
  EXPECT_LT(result.inference.parameters[0].standard_error, 0.01 * result.inference.parameters[0].value);
}

}  // namespace free_window_test
}  // namespace boresight
