// The density of a calibration's parameters and draws of it, where what they should be is known otherwise.
#include "boresight_analyses/calibration/posterior_density.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/posterior_draws.hpp"
#include "four_bar_rig.hpp"
#include "poses_bench.hpp"

namespace boresight {
namespace posterior_density_test {

using testing::HasSubstr;

// Short, so that a motion takes little.
four_bar::Bench short_runs() { return four_bar::Bench({2.0, 2.6}, 0.06, false); }

struct Fitted {
  CalibrationProblem problem;
  CalibrationResult result;

  explicit Fitted(CalibrationProblem to_fit, bool doubted = true) : problem(std::move(to_fit)) {
    CalibrationOptions options;
    options.jobs = 2;
    options.starts = 1;
    options.corrections = 0;
    if (!doubted) options.discrepancy.reset();
    result = calibrate(problem, options);
  }
  PosteriorDensity density(const std::vector<Suspect>& suspected = {}) const {
    return {problem, result.fit, result.fixed, suspected, result.inference.variance_factor, 1.0, 2};
  }
};

std::optional<PosteriorDraws> draws_of(const Fitted& fitted, const DrawOptions& options) {
  const PosteriorDensity density = fitted.density();
  return posterior_draws(fitted.problem, density, MatX::Zero(density.size(), density.size()), 0.95, options, 1, 2, {});
}

CalibrationProblem four_parameters(const four_bar::Bench& bench) {
  CalibrationProblem problem = bench.problem({}, four_bar::kFour);
  problem.fit_time_offset = true;
  problem.largest_time_offset = 1e-3;
  problem.time_offset_prior = 2e-4;
  problem.fit_bias = true;
  problem.prepare(10.0, true);
  return problem;
}

const Fitted& fitted_to_four() {
  static const Fitted fitted(four_parameters(short_runs()));
  return fitted;
}

TEST(PosteriorDensity, HasTheGradientOfItsLogarithm) {
  const Fitted& fitted = fitted_to_four();
  const std::vector<Suspect> suspected = suspects(fitted.problem, fitted.result.fit, {}, 2);
  ASSERT_FALSE(suspected.empty());
  const PosteriorDensity density = fitted.density(suspected);
  ASSERT_EQ(density.size(), 5);
  const VecX error = density.covariance().diagonal().cwiseSqrt();
  // Off the optimum, where the gradient is not small.
  const VecX y = density.mean() + 1.5 * error.cwiseProduct((VecX(5) << 1.0, -0.7, 0.4, -1.0, 0.6).finished());
  VecX gradient(5), unused(5);
  ASSERT_TRUE(std::isfinite(density.log_density(y, gradient)));
  for (int k = 0; k < 5; ++k) {
    // Small against the width of a valley between impacts, large against a motion's jitter.
    const VecX step = 0.01 * error[k] * VecX::Unit(5, k);
    const double slope =
        (density.log_density(y + step, unused) - density.log_density(y - step, unused)) / (0.02 * error[k]);
    EXPECT_NEAR(gradient[k] * error[k], slope * error[k], 0.02 * std::abs(slope * error[k]) + 0.01)
        << "of "
        << fitted.problem.global_names()[static_cast<std::size_t>(density.sampled()[static_cast<std::size_t>(k)])];
  }
}

TEST(PosteriorDensity, IsNothingBeyondABound) {
  const Fitted& fitted = fitted_to_four();
  const PosteriorDensity density = fitted.density();
  VecX y = density.mean(), gradient(y.size());
  EXPECT_TRUE(std::isfinite(density.log_density(y, gradient)));
  y[0] = density.upper(0) + 1e-9;
  EXPECT_EQ(density.log_density(y, gradient), -std::numeric_limits<double>::infinity());
  y = density.mean();
  y[4] = -1.01e-3;
  EXPECT_EQ(density.log_density(y, gradient), -std::numeric_limits<double>::infinity());
}

// What may have moved the motion without a name, and what is known only roughly, flatten it.
TEST(PosteriorDensity, IsFlatterByWhatTheModelMayBeWrongBy) {
  const Fitted& fitted = fitted_to_four();
  const PosteriorDensity sure = fitted.density(),
                         doubting = fitted.density(suspects(fitted.problem, fitted.result.fit, {.masses = 0.05}, 2));
  const VecX error = fitted.result.inference.white_covariance.diagonal()(sure.sampled()).cwiseSqrt();
  VecX unused(5);
  for (const double side : {-1.0, 1.0}) {
    const VecX away = sure.mean() + 4.0 * side * error[1] * VecX::Unit(5, 1);
    const double falls = sure.log_density(sure.mean(), unused) - sure.log_density(away, unused),
                 doubted = doubting.log_density(doubting.mean(), unused) - doubting.log_density(away, unused);
    EXPECT_GT(falls, 0.5);
    EXPECT_LT(doubted, falls);
  }
}

// Errors at poses: the model is linear, and the posterior the normal distribution of the fit, but for noise that is not known exactly (Student's t
// of many freedoms).
TEST(PosteriorDrawsLong, AreNormalWhereTheModelIsLinear) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml", std::vector<Setting>{}));
  const poses::Bench bench(mechanism, {"error.IA", "error.IE"}, {6, 7, 8}, 60);
  CalibrationProblem to_fit = bench.problem({20e-6, 20e-6, 20e-6}, 5);
  const Fitted fitted(std::move(to_fit), false);
  const std::optional<PosteriorDraws> drawn = draws_of(fitted, {.draws = 4000});
  ASSERT_TRUE(drawn);
  EXPECT_TRUE(drawn->settled) << drawn->says;
  ASSERT_EQ(drawn->quantities.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const ParameterEstimate& e = fitted.result.inference.parameters[k];
    const DrawnQuantity& q = drawn->quantities[k];
    EXPECT_EQ(q.name, e.name);
    EXPECT_NEAR(q.mean, e.value, 0.05 * e.standard_error);
    EXPECT_NEAR(q.deviation / e.standard_error, 1.0, 0.05);
    EXPECT_NEAR(q.low, e.low, 0.15 * e.standard_error);
    EXPECT_NEAR(q.high, e.high, 0.15 * e.standard_error);
  }
}

// Prior times likelihood: without data that speak, the prior; its scale is known as the noise's is, from 90 values.
TEST(PosteriorDrawsLong, FollowThePriorOfWhatTheDataDoNotTell) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml", std::vector<Setting>{}));
  const poses::Bench bench(mechanism, {"error.IA"}, {6, 7, 8}, 30);
  CalibrationProblem problem = bench.problem({1e-2, 1e-2, 1e-2}, 5);
  problem.parameters[0].has_prior = true;
  problem.parameters[0].size = 1e-4;
  const Fitted fitted(std::move(problem), false);
  const std::optional<PosteriorDraws> drawn = draws_of(fitted, {.draws = 4000});
  ASSERT_TRUE(drawn);
  EXPECT_NEAR(drawn->quantities[0].deviation, 1e-4, 4e-6);
}

// Whatever the data say of it: a prior that they contradict is no noise of theirs.
TEST(PosteriorDensity, HasItsPriorsAsATermOfTheirOwn) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml", std::vector<Setting>{}));
  const poses::Bench bench(mechanism, {"error.IA", "error.IE"}, {6, 7, 8}, 4);
  const Fitted fitted(bench.problem({20e-6, 20e-6, 20e-6}, 5), false);
  CalibrationProblem told = fitted.problem;
  told.parameters[0].has_prior = true;
  const auto density = [&](const CalibrationProblem& problem) {
    return PosteriorDensity(problem, fitted.result.fit, fitted.result.fixed, {},
                            fitted.result.inference.variance_factor, 1.0, 1);
  };
  const PosteriorDensity without = density(fitted.problem), with = density(told);
  const double start = told.packed(told.start())[0], known = told.prior_information()[0];
  ASSERT_GT(known, 0.0);
  VecX unused;
  const auto adds = [&](const VecX& y) { return with.log_density(y, unused) - without.log_density(y, unused); };
  const VecX error = without.covariance().diagonal().cwiseSqrt();
  const double middle = adds(without.mean()) + 0.5 * known * std::pow(without.mean()[0] - start, 2);
  for (const double side : {-3.0, -1.0, 2.0}) {
    const VecX y = without.mean() + side * error;
    EXPECT_NEAR(adds(y), middle - 0.5 * known * std::pow(y[0] - start, 2), 1e-6 * (1.0 + std::abs(adds(y))));
  }
}

TEST(PosteriorDraws, AreWrittenAsRowsThatAStudyReads) {
  PosteriorDraws drawn;
  drawn.quantities.resize(2);
  drawn.quantities[0].name = "clearance.D.radial";
  drawn.quantities[1].name = "time_offset";
  drawn.values = (MatX(2, 2) << 1e-4, 0.25, 1.5e-4, -0.5).finished();
  drawn.says = "two draws";
  EXPECT_EQ(csv_of(drawn), "clearance.D.radial,time_offset\n0.0001,0.25\n0.00014999999999999999,-0.5\n");
  const CalibrationProblem problem = short_runs().problem({}, {"clearance.D.radial"});
  const std::string toml = posterior_toml(drawn, problem, "posterior.csv");
  EXPECT_THAT(toml, HasSubstr("parameters = [\"clearance.D.radial\"]\n"));
  EXPECT_THAT(toml, HasSubstr("{ rows = { file = \"posterior.csv\" } }"));
}

// Of motions: where a fit's parabola holds, draws and fit agree; and the truth lies among the draws.
TEST(PosteriorDrawsLong, AgreeWithAFitThatIsSure) {
  const four_bar::Bench bench({2.0, 2.6}, 0.12, false);
  CalibrationProblem to_fit = bench.problem({}, four_bar::kFour);
  const Fitted fitted(std::move(to_fit), false);
  const std::optional<PosteriorDraws> drawn = draws_of(fitted, {.draws = 1600});
  ASSERT_TRUE(drawn);
  EXPECT_TRUE(drawn->settled) << drawn->says;
  for (const DrawnQuantity& q : drawn->quantities) {
    std::printf("  %s: %.4f of the truth, deviation %.3g %%, R-hat %.4f, worth %.0f\n", q.name.c_str(),
                q.mean / bench.truth(q.name), 100.0 * q.deviation / q.mean, q.r_hat, q.bulk_ess);
    EXPECT_LT(std::abs(q.mean - bench.truth(q.name)), 4.0 * q.deviation) << q.name;
  }
}

// A damping law in doubt moves restitution far beyond where a straight line holds: draws that take it for one are too narrow. And what suspects
// can take of a motion that is far off must leave the noise as large as it is, or the far off is the more probable.
TEST(PosteriorDrawsNight, AreAsWideAsTheFitWhereALawIsInDoubt) {
  // Of 0.12 s the loss is so flat along the stiffness that a third of its error lies between two places of one cost: no error by curvature holds.
  const four_bar::Bench bench({2.0, 2.6}, 0.2, false);
  CalibrationOptions options;
  options.jobs = 2;
  options.starts = 1;
  options.corrections = 0;
  options.draws = DrawOptions{.draws = 1000};
  CalibrationProblem to_fit = four_parameters(bench);
  const CalibrationResult result = calibrate(to_fit, options);
  ASSERT_TRUE(result.draws && result.model_error);
  ASSERT_FALSE(result.model_error->suspects.empty());
  // Masses that the data know are drawn as well, and the clock.
  ASSERT_EQ(result.draws->quantities.size(), to_fit.parameters.size() + 1);
  for (std::size_t k = 0; k < to_fit.parameters.size(); ++k) {
    const ParameterEstimate& e = result.inference.parameters[k];
    const DrawnQuantity& q = result.draws->quantities[k];
    std::printf("  %s: drawn %.4g +- %.2g, fitted %.4g +- %.2g, worth %.0f\n", e.name.c_str(), q.mean, q.deviation,
                e.value, e.standard_error, q.bulk_ess);
    EXPECT_LT(q.r_hat, 1.05) << q.name;
    EXPECT_NEAR(q.mean, e.value, 0.5 * e.standard_error) << q.name;
    EXPECT_NEAR(q.deviation / e.standard_error, 1.0, 0.3) << q.name;
    EXPECT_LT(std::abs(q.mean - bench.truth(q.name)), 4.0 * q.deviation) << q.name;
  }
}

}  // namespace posterior_density_test
}  // namespace boresight
