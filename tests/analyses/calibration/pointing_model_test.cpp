// The pointing model of a telescope, fitted: six geometric terms from simulated star positions.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <set>

#include "boresight/io/expression.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/posterior.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
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

// Three of the terms go up and down together: of 400 nights, one set in five has a share beyond two standard errors.
TEST(PointingModel, SixTermsOfFiftyStarsAreInsideTheirIntervalsAsOftenAsStated) { expect_coverage(Loss::none, 1000); }

TEST(PointingModelLong, SixTermsAreInsideTheirIntervalsWithHubersLossToo) { expect_coverage(Loss::huber, 1000); }

// The boresight's channels, of which one is noisier than the others: with one noise for all, what the quiet ones know well would be known badly,
// and the reverse.
TEST(PointingModel, ChannelsOfUnequalNoiseCoverAsOftenAsStated) {
  constexpr int kNights = 120;
  struct Night {
    std::vector<double> noise;  // [arcsec]
    int stars;
  };
  // (Of a lone quiet channel twelve stars would be no more than twice the unknowns: they tell nothing of its noise.)
  for (const Night& of : {Night{{1.0, 1.0, 20.0}, 12}, Night{{1.0, 1.0, 20.0}, 50}, Night{{0.1, 10.0, 10.0}, 50}}) {
    const Bench bench(gimbal(), kSix, {6, 7, 8}, of.stars);
    std::vector<double> noise;
    for (const double n : of.noise) noise.push_back(n * kArcsec);
    std::vector<Coverage> coverage(kSix.size());
    VecX off = VecX::Zero(6), stated = VecX::Zero(6);
    for (int night = 0; night < kNights; ++night) {
      CalibrationProblem problem = bench.problem(noise, static_cast<unsigned>(3000 + night));
      const CalibrationResult result = calibrate(problem, {});
      for (std::size_t p = 0; p < kSix.size(); ++p) {
        const ParameterEstimate& e = result.inference.parameters[p];
        coverage[p].add(bench.truth(kSix[p]), e.low, e.high);
        off[static_cast<Eigen::Index>(p)] += std::pow(e.value - bench.truth(kSix[p]), 2);
        stated[static_cast<Eigen::Index>(p)] += e.standard_error * e.standard_error;
      }
    }
    for (std::size_t p = 0; p < kSix.size(); ++p) {
      const double ratio = std::sqrt(stated[static_cast<Eigen::Index>(p)] / off[static_cast<Eigen::Index>(p)]);
      // Three and a half standard deviations of what so many nights scatter by, of 18 figures.
      EXPECT_GT(coverage[p].share(), 0.95 - 1.75 * coverage[p].allowed()) << kSix[p] << ' ' << of.noise[0];
      EXPECT_NEAR(ratio, 1.0, 3.5 / std::sqrt(2.0 * kNights)) << kSix[p] << ' ' << of.noise[0] << ' ' << of.stars;
    }
  }
}

// Two channels of one data file, the second one `noisier` times as noisy as the first; of as many nights. Widths beside those of the known noise.
void expect_coverage_of_two_channels(int stars, double noisier, Loss loss, int nights) {
  const Bench bench(gimbal(), kSix, {6, 8}, stars);
  const std::vector<double> noise = {kArcsec, noisier * kArcsec};
  CalibrationOptions known;
  known.noise = VecX::Constant(static_cast<Eigen::Index>(channel_names().size()), kArcsec);
  known.noise[8] = noise[1];
  CalibrationProblem exact = bench.problem({0.0, 0.0}, 1);
  exact.loss.kind = Loss::none;
  const VecX ideal = calibrate(exact, known).inference.white_covariance.diagonal().cwiseSqrt();
  std::vector<Coverage> coverage(kSix.size());
  VecX width = VecX::Zero(6);
  for (int night = 0; night < nights; ++night) {
    CalibrationProblem problem = bench.problem(noise, static_cast<unsigned>(20000 + night));
    problem.loss.kind = loss;
    const CalibrationResult result = calibrate(problem, {});
    for (std::size_t p = 0; p < kSix.size(); ++p) {
      const ParameterEstimate& e = result.inference.parameters[p];
      const auto i = static_cast<Eigen::Index>(p);
      coverage[p].add(bench.truth(kSix[p]), e.low, e.high);
      width[i] += 0.5 * (e.high - e.low) / (1.96 * ideal[i] * problem.parameters[p].size) / nights;
    }
  }
  double least = 1.0, most = 0.0;
  for (std::size_t p = 0; p < kSix.size(); ++p) {
    least = std::min(least, coverage[p].share());
    most = std::max(most, coverage[p].share());
    EXPECT_GT(coverage[p].share(), 0.95 - coverage[p].allowed()) << kSix[p] << ' ' << stars << ' ' << noisier;
    // Student's of some twenty degrees of freedom is a twentieth wider than a normal distribution, and Huber's weights lose another.
    EXPECT_LT(width[static_cast<Eigen::Index>(p)], 1.12) << kSix[p] << ' ' << stars << ' ' << noisier;
  }
  std::printf("  %3d stars, noises 1 : %.0f: %.1f to %.1f %% inside, widths %.2f to %.2f of those of known noise\n",
              stars, noisier, 100.0 * least, 100.0 * most, width.minCoeff(), width.maxCoeff());
}

TEST(PointingModel, IntervalsHoldWhereThirtyStarsCouldNotTellANoiseFromOneOfTwiceItsSize) {
  for (const double noisier : {1.0, 2.0}) expect_coverage_of_two_channels(30, noisier, Loss::huber, 400);
}

TEST(PointingModelNight, IntervalsOfTwoChannelsHoldWhateverTheirNoisesAndHowManyStars) {
  for (const Loss loss : {Loss::none, Loss::huber})
    for (const int stars : {30, 60, 100, 300})
      for (const double noisier : {0.25, 0.5, 1.0, 2.0, 4.0})
        expect_coverage_of_two_channels(stars, noisier, loss, 400);
}

// Channels keep their own noise however alike they look, but for those that could follow their readings exactly.
TEST(PointingModel, ChannelsShareANoiseWhereTheyHaveHardlyMoreReadingsThanTermsAlone) {
  const auto noises = [](int stars, const CalibrationOptions& options) {
    const Bench bench(gimbal(), kSix, {6, 7, 8}, stars);
    CalibrationProblem problem = bench.problem(std::vector<double>(3, kArcsec), 7);
    calibrate(problem, options);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_EQ(problem.noise_of[a] == problem.noise_of[b],
                  problem.sigma[static_cast<Eigen::Index>(a)] == problem.sigma[static_cast<Eigen::Index>(b)]);
    return problem.noise_of;
  };
  EXPECT_EQ(noises(30, {}), (std::vector{0, 1, 2}));
  // The first two see all six terms, the last one three.
  const std::vector<int> of_eight = noises(8, {});
  EXPECT_LT(std::set<int>(of_eight.begin(), of_eight.end()).size(), 3u);
  CalibrationOptions one_told;
  one_told.noise =
      VecX::Constant(static_cast<Eigen::Index>(channel_names().size()), std::numeric_limits<double>::quiet_NaN());
  one_told.noise[7] = kArcsec;
  EXPECT_EQ(noises(30, one_told)[1], -1);
}

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

// At one elevation an encoder's scale does what its zero does. The scale is a share, though it is computed in the radians of its drive.
TEST(PointingModel, ACombinationThatBeginsWithAScaleIsAShare) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml",
                                          {{"motion.drives.elevation", "pi/4"}});
  ErrorDescription scale = m.errors[1];  // IE
  scale.name = "scale";
  scale.law = parse_coordinate_function("q");
  scale.value = 1e-4;
  m.errors.push_back(scale);
  const auto mechanism = std::make_shared<const Mechanism>(std::move(m));
  for (const std::vector<std::string>& paths :
       {std::vector<std::string>{"error.IE", "error.scale"}, {"error.scale", "error.IE"}}) {
    const Bench bench(mechanism, paths, {6, 7, 8}, 50);
    CalibrationProblem problem = bench.problem(std::vector<double>(3, 1.0 * kArcsec), 7);
    const CalibrationResult result = calibrate(problem, {});
    ASSERT_EQ(result.inference.confused.size(), 1u);
    ASSERT_EQ(result.inference.confused.front().known.size(), 1u);
    const KnownCombination& known = result.inference.confused.front().known.front();
    const std::string first = paths[static_cast<std::size_t>(known.terms.front().first)];
    EXPECT_EQ(known.told_unit, first == "error.scale" ? "1" : "rad");
    const std::string words = in_words(known, problem.parameters);
    EXPECT_NE(words.find(first == "error.scale" ? " 1/rad error.IE" : " rad error.scale"), std::string::npos) << words;
  }
}

// Names may have a hundred letters, and letters several bytes.
TEST(PointingModel, APosteriorOfErrorsWithLongNamesIsAWholeFile) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml");
  std::vector<std::string> paths;
  for (const auto& [error, letter] : {std::pair{1, "ä"}, {2, "φ"}}) {
    std::string name;
    for (int k = 0; k < 100; ++k) name += letter;
    m.errors[static_cast<std::size_t>(error)].name = name;
    paths.push_back("error." + name);
  }
  const Bench bench(std::make_shared<const Mechanism>(std::move(m)), paths, {6, 7, 8}, 50);
  CalibrationProblem problem = bench.problem(std::vector<double>(3, 1.0 * kArcsec), 7);
  const CalibrationResult result = calibrate(problem, {});
  Document document = Document::from_text(posterior_toml(problem, result.inference), "posterior.toml");
  Cursor root(document);
  EXPECT_EQ(read_random_inputs(root, bench.mechanism->description(), [](const Setting&) {}).size(), 2u);
}

// A budget that is fed with it meets the sum that was measured, and not what each error alone might be, nor nothing at all.
TEST(PointingModel, WhatIsKnownOfErrorsTogetherGoesOnIntoOtherStudies) {
  const Bench bench(gimbal({{"motion.drives.elevation", "pi/4"}}), kSix, {6, 7, 8}, 50);
  CalibrationProblem problem = bench.problem(std::vector<double>(3, 1.0 * kArcsec), 7);
  const CalibrationResult result = calibrate(problem, {});
  ASSERT_EQ(result.inference.confused.size(), 1u);
  const auto& known = result.inference.confused.front().known.front();
  Document document = Document::from_text(posterior_toml(problem, result.inference), "posterior.toml");
  Cursor root(document);
  const RandomInputs inputs =
      read_random_inputs(root, problem.runs.front().mechanism->description(), [](const Setting&) {});
  ASSERT_EQ(inputs.size(), kSix.size());
  constexpr int kDraws = 4000;
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  VecX together = VecX::Zero(kDraws), alone = together;
  for (int k = 0; k < kDraws; ++k) {
    std::vector<double> x(inputs.size());
    for (double& u : x) u = unit(engine);
    inputs.values(x);
    alone[k] = x[0];
    for (const auto& [g, c] : known.terms) together[k] += c * x[static_cast<std::size_t>(g)];
  }
  const auto deviation = [](const VecX& x) { return std::sqrt((x.array() - x.mean()).square().mean()); };
  const double of_mean = known.standard_error / std::sqrt(kDraws);
  EXPECT_NEAR(together.mean(), known.value, 5.0 * of_mean);
  EXPECT_NEAR(deviation(together) / known.standard_error, 1.0, 0.1);
  // Alone it is what one may well be: a milliradian, less what two others take of their sum.
  EXPECT_NEAR(deviation(alone) / 1e-3, 0.85, 0.15);
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
    EXPECT_LT(e.standard_error, 60.0 * kArcsec) << e.name;
    EXPECT_GT(e.standard_error, 30.0 * kArcsec) << e.name;
    EXPECT_FALSE(e.identifiable) << e.name;
  }
}

// A noise that is told wrong is measured by the residuals; what was known before is not.
TEST(PointingModel, APriorIsWhatItWasToldWhateverTheNoise) {
  const Bench bench(gimbal({{"motion.drives.elevation", "pi/4"}}), kSix, {6, 7, 8}, 50);
  std::vector<double> errors;
  for (const double told : {0.1, 1.0, 10.0}) {
    CalibrationProblem problem = bench.problem(std::vector<double>(3, 1.0 * kArcsec), 7);
    problem.loss.kind = Loss::none;
    for (FittedParameter& p : problem.parameters) {
      p.has_prior = true;
      p.size = 60.0 * kArcsec;
    }
    CalibrationOptions options;
    options.noise = VecX::Constant(static_cast<Eigen::Index>(channel_names().size()), told * kArcsec);
    const CalibrationResult result = calibrate(problem, options);
    EXPECT_NEAR(result.inference.variance_factor, 1.0 / (told * told), 0.3 / (told * told));
    errors.push_back(result.inference.parameters[0].standard_error);
  }
  for (const double error : errors) EXPECT_NEAR(error / errors[1], 1.0, 0.02);
}

// What was known before counts beside the data by the noise that was told, and errors are those of that fit: also where the noise is another.
TEST(PointingModel, IntervalsWithPriorsHoldWhateverTheNoiseWasToldToBe) {
  constexpr int kNights = 100, kStars = 12;
  const Bench bench(gimbal(), {"error.IA", "error.IE"}, {6, 7, 8}, kStars);
  for (const double told : {0.1, 1.0, 10.0}) {
    std::mt19937_64 engine(11);
    std::normal_distribution<double> normal;
    Coverage coverage;
    double off = 0.0, stated = 0.0;
    for (int night = 0; night < kNights; ++night) {
      CalibrationProblem problem =
          bench.problem(std::vector<double>(3, 1.0 * kArcsec), static_cast<unsigned>(5000 + night));
      problem.loss.kind =
          Loss::none;  // of a noise that is told ten times too small Huber's leaves next to nothing inside
      for (FittedParameter& p : problem.parameters) {
        p.has_prior = true;
        p.size = 0.5 * kArcsec;
        p.start = bench.truth(p.path) + p.size * normal(engine);
      }
      CalibrationOptions options;
      options.noise = VecX::Constant(static_cast<Eigen::Index>(channel_names().size()), told * kArcsec);
      for (const ParameterEstimate& e : calibrate(problem, options).inference.parameters) {
        coverage.add(bench.truth(e.name), e.low, e.high);
        off += std::pow(e.value - bench.truth(e.name), 2);
        stated += e.standard_error * e.standard_error;
      }
    }
    EXPECT_NEAR(coverage.share(), 0.95, coverage.allowed()) << told;
    EXPECT_NEAR(std::sqrt(stated / off), 1.0, 0.1) << told;
  }
}

// Wind, seeing, a structure that warms up: readings that follow one another are worth fewer than they are, and a fit takes the slow part of them
// for its own. Their own products would state half of it.
TEST(PointingModel, IntervalsHoldWithNoiseThatFollowsItself) {
  constexpr int kNights = 80, kStars = 200;
  const Bench bench(gimbal(), {"error.IA", "error.IE"}, {6, 7, 8}, kStars);
  for (const double follows : {0.5, 0.9}) {
    Coverage coverage;
    double off = 0.0, stated = 0.0;
    for (int night = 0; night < kNights; ++night) {
      CalibrationProblem problem =
          bench.problem(std::vector<double>(3, 1.0 * kArcsec), static_cast<unsigned>(7000 + night), follows);
      problem.loss.kind = Loss::none;
      for (const ParameterEstimate& e : calibrate(problem, {}).inference.parameters) {
        coverage.add(bench.truth(e.name), e.low, e.high);
        off += std::pow(e.value - bench.truth(e.name), 2);
        stated += e.standard_error * e.standard_error;
      }
    }
    std::printf("correlation %.1f: %.1f %% inside, errors stated over found %.2f\n", follows, 100.0 * coverage.share(),
                std::sqrt(stated / off));
    EXPECT_NEAR(coverage.share(), 0.95, 1.5 * coverage.allowed()) << follows;
    EXPECT_NEAR(std::sqrt(stated / off), 1.0, 0.25) << follows;
  }
}

// A fit through all its readings leaves no residual: the noise is what it was told to be, or unknown.
TEST(PointingModel, AsManyReadingsAsTermsTellNothingOfTheirNoise) {
  const Bench bench(gimbal(), {"error.IA", "error.IE"}, {6, 8}, 1);
  const auto found = [&](bool told) {
    CalibrationProblem problem = bench.problem(std::vector<double>(2, kArcsec), 7);
    CalibrationOptions options;
    if (told) options.noise = VecX::Constant(static_cast<Eigen::Index>(channel_names().size()), kArcsec);
    return calibrate(problem, options).inference;
  };
  for (const ParameterEstimate& e : found(true).parameters) EXPECT_GT(e.standard_error, 0.5 * kArcsec) << e.name;
  for (const ParameterEstimate& e : found(false).parameters) EXPECT_FALSE(e.identifiable) << e.name;
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
