// Fits of one parameter whose truth is known, and what is said of them.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "boresight_analyses/calibration/landscape.hpp"
#include "boresight_analyses/calibration/profile_likelihood.hpp"
#include "four_bar_rig.hpp"

namespace boresight {
namespace fit_test {

using four_bar::Bench;
using four_bar::truth_of;

const std::vector<std::string> kRadial = {"clearance.D.radial"};

TEST(Fit, CountsTheIterationsThatItHasReported) {
  const Bench bench({2.0}, 0.03, false);
  CalibrationProblem problem = bench.problem({}, kRadial);
  problem.sigma = noise_from_differences(problem);
  FitOptions options;
  int last = 0;
  options.progress = [&](const FitProgress& p) {
    EXPECT_EQ(p.most_iterations, options.most_iterations);
    last = p.iteration;
    return true;
  };
  const FitResult result = fit(problem, problem.start(), {}, options);
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_GE(result.iterations, 2);
  EXPECT_EQ(result.iterations, last);
  EXPECT_LT(result.cost, result.start_cost);
  options.most_iterations = 1;
  EXPECT_EQ(fit(problem, problem.start(), {}, options).iterations, 1);
}

TEST(Fit, AsksWhetherToGoOnAlsoWhereItsStartCannotBeFollowed) {
  const Bench bench({2.0}, 0.03, false);
  CalibrationProblem problem = bench.problem({}, kRadial);
  problem.sigma = noise_from_differences(problem);
  Globals nowhere = problem.start();
  nowhere.u[0] = std::numeric_limits<double>::quiet_NaN();
  FitOptions options;
  int asked = 0;
  options.progress = [&](const FitProgress& p) {
    EXPECT_TRUE(std::isinf(p.cost)) << p.cost;
    return ++asked > 1;
  };
  const FitResult stopped = fit(problem, nowhere, {}, options);
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_EQ(stopped.iterations, 0);
  const FitResult failed = fit(problem, nowhere, {}, options);
  EXPECT_EQ(asked, 2);
  EXPECT_FALSE(failed.interrupted);
  EXPECT_TRUE(std::isinf(failed.cost));
  EXPECT_EQ(failed.iterations, 0);
}

TEST(Calibrate, StartsWithinAFactorOfTwoOfWhatItIsGiven) {
  const Bench bench({2.0}, 0.02, false);
  CalibrationProblem problem = bench.problem({}, four_bar::kFour);
  CalibrationOptions options;
  options.starts = 4;
  options.corrections = 0;
  const CalibrationResult result = calibrate(problem, options);
  ASSERT_GE(result.starts.size(), 4u);
  double farthest = 1.0;
  for (std::size_t s = 0; s < result.starts.size(); ++s)
    for (std::size_t p = 0; p < 4; ++p) {
      const FittedParameter& parameter = problem.parameters[p];
      const double ratio = result.starts[s].from[p] / parameter.start;
      if (s == 0) {
        EXPECT_NEAR(ratio, 1.0, 1e-12) << parameter.path;
      }
      if (parameter.transform != Transform::log) continue;
      EXPECT_GE(ratio, 0.5) << parameter.path;
      EXPECT_LE(ratio, 2.0) << parameter.path;
      farthest = std::max({farthest, ratio, 1.0 / ratio});
    }
  EXPECT_GT(farthest, 1.2);
}

// A search may end where residuals are as large as the noise and do not follow one another: both must hold.
TEST(Landscape, SeesResidualsThatFollowOneAnotherThoughTheyAreSmall) {
  const Bench bench({2.0}, 0.1, false);
  for (const unsigned seed : {1U, 2U, 3U}) {
    CalibrationProblem white = four_bar::with_following_noise(bench, kRadial, 0.02, 0.0, seed);
    CalibrationProblem following = four_bar::with_following_noise(bench, kRadial, 0.02, 0.9, seed);
    // Said to be noisier than they are by 40 %, so that no size of theirs stands out.
    white.sigma *= 1.4;
    following.sigma *= 1.4;
    EXPECT_FALSE(leaves_more_than_noise(white, truth_of(bench, white))) << seed;
    EXPECT_TRUE(leaves_more_than_noise(following, truth_of(bench, following))) << seed;
    white.sigma *= 0.5;
    EXPECT_TRUE(leaves_more_than_noise(white, truth_of(bench, white))) << seed;
  }
}

TEST(ProfileLikelihood, OfASmoothLossIsTheIntervalByCurvatureAndEndsAtABound) {
  const Bench bench({2.0}, 0.03, false);
  CalibrationProblem problem = bench.problem({}, kRadial);
  problem.sigma = noise_from_differences(problem);
  const FitResult found = fit(problem, problem.start(), {}, {});
  const std::vector<bool> fixed = {false};
  const Inference inference = infer(problem, found, 0.95, fixed, 1);
  FitResult lower = found;
  const std::vector<Profile> whole = profile_likelihood(problem, found, inference, fixed, 1, lower);
  ASSERT_EQ(whole.size(), 1u);
  const ParameterEstimate& e = inference.parameters[0];
  EXPECT_NEAR(whole[0].low, e.low, 0.2 * (e.value - e.low));
  EXPECT_NEAR(whole[0].high, e.high, 0.2 * (e.high - e.value));
  // A bound half a standard error above what was found: the profile is tried there once.
  problem.parameters[0].upper = e.value + 0.5 * e.standard_error;
  const std::vector<Profile> bounded = profile_likelihood(problem, found, inference, fixed, 1, lower);
  EXPECT_TRUE(std::isnan(bounded[0].high));
  EXPECT_NEAR(bounded[0].value.back(), problem.parameters[0].upper, 1e-9 * e.value);
  EXPECT_TRUE(std::is_sorted(bounded[0].value.begin(), bounded[0].value.end(), std::less_equal<>()))
      << "a place was tried twice";
}

// What is as well known after the data as it was assumed to be before is not told by them, however small its error.
TEST(Verdict, SaysOfWhatOnlyAPriorKnowsThatTheDataDoNotTellIt) {
  const Bench bench({2.0}, 0.03, false);
  CalibrationProblem problem = bench.problem({}, kRadial);
  FittedParameter& parameter = problem.parameters[0];
  parameter.has_prior = true;
  parameter.prior = 0.2 * parameter.start;
  Inference inference;
  inference.parameters.resize(1);
  inference.correlation = MatX::Identity(1, 1);
  inference.rank = 1;
  ParameterEstimate& e = inference.parameters[0];
  e.value = parameter.start;
  for (const double left : {0.98, 0.5}) {
    e.standard_error = left * parameter.prior;
    assess_identifiability(parameter, e);
    EXPECT_TRUE(e.identifiable) << e.reason;
    EXPECT_EQ(e.by_prior, left > 0.9) << left;
    EXPECT_THAT(verdict(problem, inference),
                testing::ElementsAre(testing::HasSubstr(left > 0.9 ? "is not told by these data" : "All parameters")));
  }
  parameter.has_prior = false;
  e.standard_error = 0.2 * e.value;
  assess_identifiability(parameter, e);
  EXPECT_FALSE(e.by_prior);
}

TEST(Verdict, NamesContactsThatBeganWhileBarelyMoving) {
  CalibrationProblem problem;
  problem.parameters.resize(1);
  Inference inference;
  inference.parameters.resize(1);
  inference.correlation = MatX::Identity(1, 1);
  inference.rank = 1;
  EXPECT_THAT(verdict(problem, inference),
              testing::ElementsAre(testing::StartsWith("All parameters are identifiable")));
  inference.grazing = 1;
  EXPECT_THAT(verdict(problem, inference),
              testing::ElementsAre(testing::StartsWith("1 contact began while barely moving")));
}

}  // namespace fit_test
}  // namespace boresight
