// The pointing model of a telescope, fitted: six geometric terms from simulated star positions.
#include <gtest/gtest.h>

#include <cstdio>

#include "boresight/mechanism/error.hpp"
#include "poses_bench.hpp"

namespace boresight {
namespace pointing_model_test {

using poses::Bench;
using poses::Coverage;
using poses::kArcsec;

const std::vector<std::string> kSix = {"error.IA", "error.IE", "error.CA", "error.NPAE", "error.AN", "error.AW"};

std::shared_ptr<const Mechanism> gimbal(std::vector<Setting> settings = {}) {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml", settings));
}

// What fifty stars tell of the terms, by the closed forms alone: standard errors of the linear fit, per standard deviation of the noise of
// one direction.
VecX closed_form_errors(const Bench& bench) {
  MatX X(2 * static_cast<Eigen::Index>(bench.times.size()), 6);
  Eigen::Index row = 0;
  for (const double t : bench.times) {
    const double A = M_PI * std::sin(2.0 * M_PI * t / 3.7),
                 E = M_PI / 180.0 * (45.0 - 35.0 * std::cos(M_PI * t / 10.0));
    X.row(row++) << std::cos(E), 0.0, 1.0, std::sin(E), std::sin(A) * std::sin(E), -std::cos(A) * std::sin(E);
    X.row(row++) << 0.0, 1.0, 0.0, 0.0, std::cos(A), std::sin(A);
  }
  return MatX((X.transpose() * X).inverse()).diagonal().cwiseSqrt();
}

// Of as many nights of fifty stars, each direction measured to an arcsecond.
void expect_coverage(Loss loss, int nights) {
  const Bench bench(gimbal(), kSix, {6, 7, 8}, 50);
  const VecX closed = kArcsec * closed_form_errors(bench);
  std::vector<Coverage> coverage(kSix.size());
  VecX square = VecX::Zero(6);
  for (int night = 0; night < nights; ++night) {
    CalibrationProblem problem = bench.problem(std::vector<double>(3, kArcsec), static_cast<unsigned>(1000 + night));
    problem.loss.kind = loss;
    const CalibrationResult result = calibrate(problem, {});
    EXPECT_TRUE(result.fit.converged) << result.fit.reason;
    EXPECT_EQ(result.inference.rank, 6);
    for (std::size_t p = 0; p < kSix.size(); ++p) {
      const ParameterEstimate& e = result.inference.parameters[p];
      EXPECT_TRUE(e.identifiable) << e.name << ": " << e.reason;
      square[static_cast<Eigen::Index>(p)] += e.standard_error * e.standard_error / nights;
      coverage[p].add(bench.truth(kSix[p]), e.low, e.high);
    }
  }
  for (std::size_t p = 0; p < kSix.size(); ++p) {
    const double ours = std::sqrt(square[static_cast<Eigen::Index>(p)]), theirs = closed[static_cast<Eigen::Index>(p)];
    std::printf(
        "  %s: truth inside %d of %d intervals of 95 %%; standard error %.3f arcsec, by the closed forms %.3f\n",
        kSix[p].c_str(), coverage[p].inside, nights, ours / kArcsec, theirs / kArcsec);
    EXPECT_NEAR(coverage[p].share(), 0.95, coverage[p].allowed()) << kSix[p];
    // Huber's weights lose a twentieth; residuals that follow one another by chance widen some.
    EXPECT_NEAR(ours / theirs, 1.0, 0.08) << kSix[p];
  }
}

TEST(PointingModel, SixTermsOfFiftyStarsAreInsideTheirIntervalsAsOftenAsStated) { expect_coverage(Loss::none, 400); }

TEST(PointingModelLong, SixTermsAreInsideTheirIntervalsWithHubersLossToo) { expect_coverage(Loss::huber, 400); }

TEST(PointingModel, TermsOfAMilliradianAreFoundExactlyInDataWithoutNoise) {
  std::vector<Setting> large;
  for (const char* name : {"IA", "IE", "CA", "NPAE", "AN", "AW"})
    large.push_back({std::string("error.") + name, std::string(name) == "CA" ? "-1 mrad" : "1 mrad"});
  const Bench bench(gimbal(large), kSix, {6, 7, 8}, 50);
  CalibrationProblem problem = bench.problem({0.0, 0.0, 0.0}, 1);
  const CalibrationResult result = calibrate(problem, {});
  for (const ParameterEstimate& e : result.inference.parameters)
    EXPECT_NEAR(e.value, bench.truth(e.name), 1e-9) << e.name;
}

TEST(PointingModel, StarsAtOneElevationLeaveCombinationsThatAreNamed) {
  // At one elevation collimation and perpendicularity are both a constant shift in azimuth, and so is the azimuth index.
  const Bench bench(gimbal({{"motion.drives.elevation", "pi/4"}}), kSix, {6, 7, 8}, 50);
  CalibrationProblem problem = bench.problem(std::vector<double>(3, 1.0 * kArcsec), 7);
  const CalibrationResult result = calibrate(problem, {});
  ASSERT_EQ(result.inference.confused.size(), 1u);
  const ConfusedErrors& group = result.inference.confused.front();
  EXPECT_EQ(group.parameters, (std::vector<int>{0, 2, 3}));
  EXPECT_FALSE(group.hidden);
  ASSERT_EQ(group.known.size(), 1u);
  EXPECT_NEAR(group.known.front().value, bench.truth(group.known.front()), 4.0 * group.known.front().standard_error);
  EXPECT_LT(group.known.front().standard_error, 1.0 * kArcsec);
  // IA + CA / cos E + NPAE tan E, up to what stands first.
  const auto coefficient = [&](int p) {
    for (const auto& [g, c] : group.known.front().terms)
      if (g == p) return c;
    return 0.0;
  };
  EXPECT_NEAR(coefficient(2) / coefficient(0), std::sqrt(2.0), 1e-2);
  EXPECT_NEAR(coefficient(3) / coefficient(0), 1.0, 1e-2);
  for (const int p : {0, 2, 3}) EXPECT_FALSE(result.inference.parameters[static_cast<std::size_t>(p)].identifiable);
  for (const int p : {1, 4, 5}) {
    const ParameterEstimate& e = result.inference.parameters[static_cast<std::size_t>(p)];
    EXPECT_TRUE(e.identifiable) << e.name;
    EXPECT_NEAR(e.value, bench.truth(e.name), 4.0 * e.standard_error) << e.name;
  }
  EXPECT_EQ(result.inference.rank, 4);
  for (const std::string& sentence : result.verdict) std::printf("  %s\n", sentence.c_str());
  ASSERT_FALSE(result.verdict.empty());
  EXPECT_NE(result.verdict.front().find("move the boresight alike in these data: only error."), std::string::npos)
      << result.verdict.front();
}

TEST(PointingModel, APriorBoundsWhatTheDataDoNotKnow) {
  const Bench bench(gimbal({{"motion.drives.elevation", "pi/4"}}), kSix, {6, 7, 8}, 50);
  CalibrationProblem problem = bench.problem(std::vector<double>(3, 1.0 * kArcsec), 7);
  for (FittedParameter& p : problem.parameters) {
    p.has_prior = true;
    p.size = 60.0 * kArcsec;
  }
  const CalibrationResult result = calibrate(problem, {});
  // The prior's own deviation, less the one direction of three that the data know.
  for (const int p : {0, 2, 3}) {
    const ParameterEstimate& e = result.inference.parameters[static_cast<std::size_t>(p)];
    EXPECT_LT(e.standard_error, 60.0 * kArcsec * std::sqrt(result.inference.variance_factor)) << e.name;
    EXPECT_GT(e.standard_error, 30.0 * kArcsec) << e.name;
    EXPECT_FALSE(e.identifiable) << e.name;
  }
}

TEST(PointingModel, AConstantOffsetOfTheChannelsHidesWhatItDoesAlike) {
  // A tube that stands still: every error is an offset.
  const Bench bench(gimbal({{"motion.drives.elevation", "pi/4"}, {"motion.drives.azimuth", "0.3"}}), {"error.IE"},
                    {6, 7, 8}, 20);
  CalibrationProblem problem = bench.problem(std::vector<double>(3, 1.0 * kArcsec), 7);
  problem.fit_bias = true;
  problem.prepare(std::numeric_limits<double>::infinity(), true);
  const CalibrationResult result = calibrate(problem, {});
  ASSERT_EQ(result.inference.confused.size(), 1u);
  EXPECT_TRUE(result.inference.confused.front().hidden);
  EXPECT_TRUE(result.inference.confused.front().known.empty());
}

TEST(PointingModel, SizesAloneAreRefused) {
  EXPECT_THROW(Bench(gimbal(), kSix, {11}, 10).problem({kArcsec}, 1), InputError);
}

}  // namespace pointing_model_test
}  // namespace boresight
