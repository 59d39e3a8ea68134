// What a fit allows for beside its parameters: jumps of the motion, a lag and drifts of the sensor, what was known before.

#include "boresight_analyses/calibration/allowances.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "four_bar_rig.hpp"

namespace boresight {
namespace allowances_test {

using four_bar::Bench;
using four_bar::kFour;
using four_bar::truth_of;

const std::vector<std::string> kThree = {"clearance.D.radial", "clearance.D.contact.restitution",
                                         "clearance.D.friction.coefficient"};

TEST(WindowJumps, ChangeReadingsAsAnotherStartDoes) {
  const Bench bench({2.4}, 0.06, false);
  CalibrationProblem problem = bench.problem({}, kThree);
  problem.sigma = noise_from_differences(problem);
  problem.tolerance = problem.derivative_tolerance = 1e-11;
  const Globals at = truth_of(bench, problem);
  const Window& window = problem.windows.front();
  const MatX by = problem.by_jumps(window, at, 4);
  const int n2 = problem.state_size(window);
  ASSERT_GE(by.cols(), 3 * n2);
  const double h = 1e-5;
  for (int d = 0; d < n2; ++d) {
    const auto moved = [&](double distance) {
      WindowResiduals out;
      problem.evaluate(window, at, distance * VecX::Unit(n2, d), false, out);
      return out.r;
    };
    const VecX differences = (moved(h) - moved(-h)) / (2.0 * h);
    EXPECT_LT((differences - by.col(d)).norm(), 1e-3 * differences.norm() + 1e-9) << "direction " << d;
  }
  // What comes later changes nothing before it.
  const Eigen::Index last = by.cols() - n2;
  EXPECT_EQ(by.block(0, last, 10, n2).norm(), 0.0);
  EXPECT_GT(by.rightCols(n2).norm(), 0.0);
}

// Every reading a mean over the past of the motion, against the motion's own readings filtered step by step.
TEST(SensorLag, IsOfFirstOrder) {
  const Bench bench({2.4}, 0.05, false);
  CalibrationProblem problem = bench.problem({}, kThree);
  problem.fit_lag = true;
  problem.prepare(10.0, true);
  problem.sigma = noise_from_differences(problem);
  Globals at = truth_of(bench, problem);
  at.lag = 3e-4;
  WindowResiduals lagging;
  problem.evaluate(problem.windows.front(), at, VecX::Zero(problem.state_size(problem.windows.front())), true, lagging);
  const double fine = 1e-4, share = std::exp(-fine / at.lag);
  const MatX often = four_bar::own_readings(bench.mechanisms[0], four_bar::times(0.05, fine), {0, 1, 2, 3, 4, 5});
  VecX filtered = often.row(0);
  double worst = 0.0, largest = 0.0;
  for (Eigen::Index i = 1; i < often.rows(); ++i) {
    const VecX now = often.row(i), slope = (now - VecX(often.row(i - 1))) / fine;
    filtered = now - slope * at.lag + (filtered - VecX(often.row(i - 1)) + slope * at.lag) * share;
    // The first lags see what was before the start.
    if (i % 10 != 0 || i * fine < 3e-3) continue;
    for (int c = 0; c < 6; ++c) {
      const Eigen::Index row = c * 51 + i / 10;
      const double model = problem.runs[0].data.value(i / 10, c) + lagging.r[row] * problem.sigma[c];
      worst = std::max(worst, std::abs(model - filtered[c]) / problem.sigma[c]);
      largest = std::max(largest, std::abs(now[c] - filtered[c]) / problem.sigma[c]);
    }
  }
  std::printf("  a lag moves readings by up to %.3g, the rule is off by %.3g standard deviations\n", largest, worst);
  EXPECT_GT(largest, 3.0);
  EXPECT_LT(worst, 0.1 * largest);
  const double h = 1e-7;
  const auto moved = [&](double by) {
    Globals there = at;
    there.lag += by;
    WindowResiduals r;
    problem.evaluate(problem.windows.front(), there, VecX::Zero(problem.state_size(problem.windows.front())), false, r);
    return r.r;
  };
  const VecX differences = (moved(h) - moved(-h)) / (2.0 * h);
  EXPECT_LT((differences - lagging.by_global.col(problem.lag_column())).norm(), 1e-3 * differences.norm());
}

TEST(Calibrate, FindsADriftOfItsChannels) {
  const Bench bench({2.0, 2.6}, 0.12, false);
  CalibrationProblem problem = bench.problem({}, {"clearance.D.radial"});
  VecX drift(6);
  drift << 4e-5, -4e-5, 6e-5, 6e-4, -6e-4, 6e-4;
  for (CalibrationRun& run : problem.runs)
    for (Eigen::Index i = 0; i < run.data.value.rows(); ++i)
      run.data.value.row(i) += drift.transpose() * run.data.time[static_cast<std::size_t>(i)];
  problem.fit_drift = true;
  problem.prepare(10.0, true);
  CalibrationOptions options;
  options.starts = 1;
  options.corrections = 0;
  options.discrepancy.reset();
  const CalibrationResult result = calibrate(problem, options);
  ASSERT_EQ(result.inference.parameters.size(), 7u);
  for (int c = 0; c < 6; ++c) {
    const ParameterEstimate& e = result.inference.parameters[static_cast<std::size_t>(1 + c)];
    EXPECT_NEAR(e.value, drift[c], 4.0 * e.standard_error) << e.name;
    EXPECT_GT(std::abs(drift[c]), 4.0 * e.standard_error) << e.name;
  }
}

// A prior of a hundredth of what the data leave decides, one of a hundred times leaves the decision to them.
TEST(Fit, WeighsWhatWasKnownOfAContact) {
  const Bench bench({2.0}, 0.03, false);
  CalibrationProblem problem = bench.problem({}, {"clearance.D.radial"});
  problem.sigma = noise_from_differences(problem);
  const FitResult by_data = fit(problem, problem.start(), {}, {});
  const double error = infer(problem, by_data, 0.95, {false}, 1).parameters[0].standard_error;
  const double found = problem.values(by_data.globals)[0];
  FittedParameter& radial = problem.parameters[0];
  radial.has_prior = true;
  radial.start = found + 0.5 * error;
  radial.prior = 0.01 * error;
  EXPECT_NEAR(problem.values(fit(problem, problem.start(), {}, {}).globals)[0], radial.start, 0.01 * error);
  radial.prior = error;
  const FitResult both = fit(problem, problem.start(), {}, {});
  EXPECT_GT(problem.values(both.globals)[0], found + 0.05 * error);
  EXPECT_LT(problem.values(both.globals)[0], radial.start - 0.05 * error);
  // Information adds up.
  const Inference with = infer(problem, both, 0.95, {false}, 1);
  radial.has_prior = false;
  const Inference without = infer(problem, both, 0.95, {false}, 1);
  EXPECT_NEAR(with.information(0, 0), without.information(0, 0) + std::pow(radial.start / error, 2),
              1e-6 * with.information(0, 0));
  radial.has_prior = true;
  radial.prior = 100.0 * error;
  EXPECT_NEAR(problem.values(fit(problem, problem.start(), {}, {}).globals)[0], found, 0.1 * error);
}

// Runs with shims of their own have no one gap to fit.
TEST(Allowances, LeaveAGapAloneThatEachRunSetsInItsOwnWay) {
  const Bench bench({2.0, 2.4}, 0.02, false);
  const auto axial = [](const CalibrationProblem& problem) {
    return std::any_of(problem.parameters.begin(), problem.parameters.end(),
                       [](const FittedParameter& p) { return p.path == "clearance.D.axial"; });
  };
  CalibrationProblem same = bench.problem({}, kThree), other = bench.problem({}, kThree);
  MechanismDescription shimmed = other.runs[1].mechanism->description();
  for (ClearanceDescription& c : shimmed.clearances) c.parameters.axial *= 3.0;
  other.runs[1].mechanism = std::make_shared<const Mechanism>(shimmed);
  for (CalibrationProblem* problem : {&same, &other}) {
    ASSERT_FALSE(axial(*problem));
    allow_for({.axial = 0.2}, *problem);
  }
  EXPECT_TRUE(axial(same));
  EXPECT_FALSE(axial(other));
}

}  // namespace allowances_test
}  // namespace boresight
