// What a further test would tell, by information that adds.
#include "boresight_analyses/calibration/next_test.hpp"

#include <gtest/gtest.h>

#include "four_bar_rig.hpp"
#include "poses_bench.hpp"

namespace boresight {
namespace next_test_test {

using poses::gimbal;
using poses::kArcsec;

TEST(NextTest, OfTheSameStarsHalvesTheVariances) {
  const poses::Bench bench(gimbal(), {"error.IA", "error.IE", "error.NPAE"}, {6, 7, 8}, 500);
  CalibrationProblem problem = bench.problem(std::vector<double>(3, kArcsec), 3);
  problem.loss.kind = Loss::none;  // of Huber's, each reading that is out counts for less, and a candidate has none
  const CalibrationResult result = calibrate(problem, {});
  const NextTest same =
      judge_candidate(problem, result.inference, result.fit.globals, {false, false, false}, {"same", gimbal()});
  ASSERT_EQ(same.refusal, "");
  // Twice the information, but for its instants, of which one is the motion's start.
  EXPECT_NEAR(same.a_ratio, 0.5, 2e-3);
  EXPECT_NEAR(same.d_gain, 3.0 * M_LN2, 0.01);
  for (const double ratio : same.error_ratio) EXPECT_NEAR(ratio, M_SQRT1_2, 2e-3);
}

// Radii and friction are known to shares of themselves, and restitution, whose coordinate ends at 0.01 and 1, to a share as well.
TEST(NextTest, SumsRelativeVariances) {
  const four_bar::Bench bench({2.0}, 0.06, false);
  CalibrationProblem problem = bench.problem({}, four_bar::kFour);
  problem.sigma = VecX::Constant(6, 2e-5);
  const Globals at = four_bar::truth_of(bench, problem);
  Inference inference;
  inference.information = VecX::Constant(problem.global_count(), 0.2).asDiagonal();
  inference.information(0, 0) = 400.0;
  const NextTest test =
      judge_candidate(problem, inference, at, std::vector<bool>(4, false), {"faster", four_bar::mechanism(2.5, 0.06)});
  ASSERT_EQ(test.refusal, "");
  ASSERT_EQ(test.error_ratio.size(), 4u);
  double before = 0.0, after = 0.0;
  for (Eigen::Index p = 0; p < 4; ++p) {
    const FittedParameter& parameter = problem.parameters[static_cast<std::size_t>(p)];
    const double value = bench.truth(parameter.path);
    // dx/x of log x is one; of log((x - l) / (u - x)) it is (x - l) (u - x) / ((u - l) x).
    const double relative =
        p == 1 ? (value - parameter.lower) * (parameter.upper - value) / (parameter.upper - parameter.lower) / value
               : 1.0;
    const double variance = relative * relative / inference.information(p, p);
    before += variance;
    after += variance * std::pow(test.error_ratio[static_cast<std::size_t>(p)], 2);
  }
  EXPECT_NEAR(test.a_ratio, after / before, 1e-6);
  EXPECT_LT(test.a_ratio, 0.9);
}

}  // namespace next_test_test
}  // namespace boresight
