// What a calibration finds in data whose truth is known.
#include "boresight_analyses/calibration/calibrate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "boresight/mechanism/error.hpp"
#include "four_bar_rig.hpp"

namespace boresight {
namespace calibrate_test {

using four_bar::Bench;
using four_bar::kFour;

CalibrationOptions options_with(int corrections) {
  CalibrationOptions options;
  options.jobs = 2;
  options.starts = 1;
  options.corrections = corrections;
  return options;
}

double deviations_off(const Bench& bench, const ParameterEstimate& e) {
  return std::abs(e.value - bench.truth(e.name)) / e.standard_error;
}

TEST(Calibrate, RecoversWhatMadeItsOwnRungsData) {
  const Bench bench({2.0, 2.4, 2.8}, 0.16, false);
  CalibrationProblem problem = bench.problem({}, kFour);
  const CalibrationResult result = calibrate(problem, options_with(0));
  for (const ParameterEstimate& e : result.inference.parameters) {
    EXPECT_LT(deviations_off(bench, e), 3.5) << e.name;
    EXPECT_TRUE(e.identifiable) << e.name << ": " << e.reason;
    EXPECT_LT(e.low, e.value);
    EXPECT_GT(e.high, e.value);
  }
  EXPECT_NEAR(result.inference.variance_factor, 1.0, 0.15);
  EXPECT_EQ(result.inference.rank, problem.parameter_count());
}

// The boresight on the crank, which the rocker's play does not move: all readings and all residuals are zero, and no place is likelier than
// another.
TEST(Calibrate, OfReadingsThatNothingMovesSaysThatTheyTellNothing) {
  MechanismDescription description = four_bar::mechanism(2.0, 0.16)->description();
  for (BodyDescription& body : description.bodies) body.boresight.reset();
  for (BodyDescription& body : description.bodies)
    if (body.name == "crank") body.boresight = Vec3::UnitZ();
  const auto mechanism = std::make_shared<const Mechanism>(description);
  const std::vector<double> t = four_bar::times(0.16);
  SyntheticRig rig;
  rig.noise = 0.0;
  const MatX clean = four_bar::own_readings(mechanism, t, rig.channels);
  ASSERT_LT(clean.norm(), 1e-25);  // gains that rounding leaves
  CalibrationProblem problem;
  problem.runs.emplace_back("still", mechanism, with_rig_errors(rig, t, clean, 0));
  problem.parameters.push_back(fitted_parameter(mechanism->description(), kFour[0], 2.4e-4));
  problem.prepare(10.0, true);
  const CalibrationResult result = calibrate(problem, options_with(0));
  EXPECT_EQ(result.inference.rank, 0);
  EXPECT_FALSE(result.inference.parameters.front().identifiable);
}

TEST(Calibrate, SaysHowFarItHasComeAndNeverGoesBack) {
  const Bench bench({2.0}, 0.06, false);
  CalibrationProblem problem = bench.problem({}, {kFour[0]});
  CalibrationOptions options = options_with(0);
  std::vector<double> shares;
  options.progress = [&](const std::string&, double share, const std::string&) {
    shares.push_back(share);
    return true;
  };
  calibrate(problem, options);
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_GE(shares.back(), 0.9);
  EXPECT_LE(shares.back(), 1.0);
  const auto between = std::count_if(shares.begin(), shares.end(), [](double s) { return s > 0.1 && s < 0.7; });
  EXPECT_GT(between, 3) << "while the horizon grows";
}

TEST(Calibrate, FindsClearanceToOnePercentAndFrictionToTenInMultibodyData) {
  const Bench bench({2.0, 2.6}, 0.12, true);
  CalibrationProblem problem = bench.problem({}, kFour);
  const CalibrationResult result = calibrate(problem, options_with(2));
  EXPECT_NEAR(result.inference.parameters[0].value / bench.truth(kFour[0]), 1.0, 0.01);
  EXPECT_NEAR(result.inference.parameters[2].value / bench.truth(kFour[2]), 1.0, 0.10);
  for (const ParameterEstimate& e : result.inference.parameters) EXPECT_LT(deviations_off(bench, e), 3.5) << e.name;
  // Multibody itself leaves at the optimum what the noise does.
  EXPECT_NEAR(result.confirmation, 1.0, 0.1);
}

TEST(CalibrateLong, GoesOnStartingWhereNoStartExplainsTheData) {
  const Bench bench({2.0, 2.6}, 0.12, false);
  CalibrationOptions options = options_with(0);
  CalibrationProblem problem = bench.problem({}, kFour);
  const CalibrationResult explained = calibrate(problem, options);
  EXPECT_NEAR(explained.inference.variance_factor, 1.0, 0.1);
  EXPECT_LT(explained.starts.size(), 24u);
  // Said to be measured ten times better than they are, no place explains them: all starts are tried.
  options.noise = VecX::Constant(channel_names().size(), problem.sigma.minCoeff() / 10.0);
  CalibrationProblem doubted = bench.problem({}, kFour);
  EXPECT_EQ(calibrate(doubted, options).starts.size(), 24u);
}

TEST(CalibrateNight, ExplainsDataOfWhichItsFirstStartsLeadAstray) {
  // With this noise the best of four starts on the first eighth lies in a valley of three times the stiffness.
  const Bench bench({2.0, 2.4, 2.8}, 0.2, true);
  SyntheticRig rig;
  rig.seed = 1026;
  CalibrationProblem problem = bench.problem(rig, kFour);
  CalibrationOptions options = options_with(0);
  options.starts = 4;
  EXPECT_NEAR(calibrate(problem, options).inference.variance_factor, 1.0, 0.1);
}

TEST(Calibrate, FindsHiddenTimeOffsetAndMountingBias) {
  const Bench bench({2.0, 2.6}, 0.12, false);
  SyntheticRig rig;
  rig.bias = VecX::Zero(6);
  rig.bias << 5e-6, -3e-6, 8e-6, 1e-5, -2e-5, 4e-6;
  CalibrationProblem problem = bench.problem(rig, {"clearance.D.radial", "clearance.D.contact.restitution"});
  // The rig's clock shows half a millisecond less than it is.
  for (CalibrationRun& run : problem.runs) {
    for (double& t : run.data.time) t -= 5e-4;
    run.data.time.erase(run.data.time.begin());
    run.data.line.erase(run.data.line.begin());
    run.data.value = run.data.value.bottomRows(run.data.value.rows() - 1).eval();
  }
  problem.fit_time_offset = problem.fit_bias = true;
  problem.largest_time_offset = 2e-3;
  problem.prepare(10.0, true);
  const CalibrationResult result = calibrate(problem, options_with(0));
  const auto& found = result.inference.parameters;
  // Masses that the data know are fitted along.
  const std::size_t offset = problem.parameters.size();
  ASSERT_EQ(found.size(), offset + 7);
  EXPECT_NEAR(found[offset].value, 5e-4, 4.0 * found[offset].standard_error);
  for (std::size_t c = 0; c < 6; ++c) {
    const ParameterEstimate& bias = found[offset + 1 + c];
    EXPECT_NEAR(bias.value, rig.bias[c], 4.0 * bias.standard_error) << bias.name;
  }
  for (int p = 0; p < 2; ++p) EXPECT_LT(deviations_off(bench, found[p]), 4.0) << found[p].name;
}

// One percent of a mass moves late impacts by many valleys: counted as an error afterwards alone, it led intervals away from the truth.
TEST(Calibrate, FindsAMassThatIsNotWhatWasToldAndWhatItWouldHaveLedAway) {
  const std::string path = "body.rocker.mass";
  Bench told({2.0, 2.4, 2.8}, 0.2, false);
  const Bench heavy({2.0, 2.4, 2.8}, 0.2, false, {{path, std::to_string(1.01 * told.truth(path)) + " kg"}});
  told.clean = heavy.clean;
  SyntheticRig rig;
  rig.noise = 0.01;
  CalibrationProblem problem = told.problem(rig, kFour);
  const CalibrationResult result = calibrate(problem, options_with(0));
  bool found = false;
  for (const ParameterEstimate& e : result.inference.parameters) {
    EXPECT_LT(deviations_off(heavy, e), 3.5) << e.name;
    if (e.name != path) continue;
    found = true;
    EXPECT_LT(e.standard_error, 0.003 * heavy.truth(path));
  }
  EXPECT_TRUE(found);
  EXPECT_THAT(result.verdict, testing::Contains(testing::StartsWith("The data ask for a body.rocker.mass 1")));
  // Said to be exact, masses are no parameters.
  CalibrationProblem as_told = told.problem(rig, kFour);
  CalibrationOptions exact = options_with(0);
  exact.discrepancy->masses = 0.0;
  EXPECT_EQ(calibrate(as_told, exact).inference.parameters.size(), kFour.size());
}

TEST(Calibrate, LeavesAMassAloneThatRunsSetEachInItsOwnWay) {
  Bench bench({2.0}, 0.2, false);
  const Bench heavy({2.0}, 0.2, false, {{"body.rocker.mass", "1 kg"}});
  bench.mechanisms.push_back(heavy.mechanisms.front());
  bench.clean.push_back(heavy.clean.front());
  CalibrationProblem problem = bench.problem({}, kFour);
  calibrate(problem, options_with(0));
  for (const FittedParameter& p : problem.parameters) EXPECT_NE(p.path, "body.rocker.mass");
  for (int r = 0; r < 2; ++r) {
    const ParameterPath mass(problem.runs[r].mechanism->description(), "body.rocker.mass");
    EXPECT_EQ(mass.get(problem.parameters_at(r, problem.values(problem.start()))), mass.get(problem.runs[r].told()));
  }
}

// A pendulum: its motion is simulated, and the tables that a mass's slopes come from are those of the motion that the file's masses give.
TEST(Calibrate, RefusesAMassWhereTheMotionIsSimulated) {
  const auto pendulum = std::make_shared<const Mechanism>(read_mechanism(
      std::string(BORESIGHT_EXAMPLES) + "/pendulum/pendulum.toml", std::vector<Setting>{{"motion.duration", "0.1 s"}}));
  CalibrationProblem problem;
  problem.parameters.push_back(fitted_parameter(pendulum->description(), "body.bob.mass", 1.0));
  SyntheticRig rig;
  rig.channels = {0};
  problem.runs.emplace_back("run", pendulum, with_rig_errors(rig, {0.0, 0.1}, MatX::Zero(2, 1), 0));
  try {
    problem.prepare(10.0, true);
    FAIL() << "taken";
  } catch (const ComputationError& refused) {
    EXPECT_THAT(refused.what(), testing::HasSubstr("fits masses where every freedom is driven"));
  }
}

TEST(Calibrate, RestitutionIsNotIdentifiableWithoutImpacts) {
  // The first milliseconds: the journal has not reached its bore yet.
  Bench bench({1.0}, 0.1, false);
  CalibrationProblem problem = bench.problem({}, {"clearance.D.contact.restitution"});
  MeasuredData& data = problem.runs[0].data;
  const int seen = 3;
  data.time.resize(seen);
  data.line.resize(seen);
  data.value = data.value.topRows(seen).eval();
  problem.prepare(10.0, true);
  const CalibrationResult result = calibrate(problem, options_with(0));
  const ParameterEstimate& restitution = result.inference.parameters[0];
  EXPECT_EQ(result.inference.impacts[0], 0);
  EXPECT_FALSE(restitution.identifiable);
  EXPECT_NE(restitution.reason.find("no impact"), std::string::npos) << restitution.reason;
}

TEST(Calibrate, GrossOutliersMoveTheAnswerByLessThanAStandardError) {
  const Bench bench({2.0, 2.6}, 0.12, false);
  const auto answer = [&](double share) {
    SyntheticRig rig;
    rig.outliers = share;
    CalibrationProblem problem = bench.problem(rig, kFour);
    problem.loss = {Loss::cauchy, 2.4};
    return calibrate(problem, options_with(0)).inference.parameters;
  };
  const auto clean = answer(0.0), spoilt = answer(0.1);
  for (std::size_t p = 0; p < clean.size(); ++p) {
    std::printf("  %s %.5g, %.5g; moved by %.2f standard errors\n", clean[p].name.c_str(), clean[p].value,
                spoilt[p].value, std::abs(spoilt[p].value - clean[p].value) / clean[p].standard_error);
    EXPECT_LT(std::abs(spoilt[p].value - clean[p].value), clean[p].standard_error) << clean[p].name;
  }
}

TEST(Calibrate, PrefersTheLawThatMadeTheData) {
  const Bench bench({2.0, 2.6}, 0.12, true);
  CalibrationProblem problem = bench.problem({}, kFour);
  CalibrationOptions options = options_with(2);
  options.laws = {"hertz", "flores"};
  const std::vector<LawScore> laws = calibrate(problem, options).laws;
  ASSERT_EQ(laws.size(), 2u);
  EXPECT_GT(laws[0].difference, 10.0);
  EXPECT_EQ(laws[1].difference, 0.0);
}

void expect_four_parameters(const Bench& bench) {
  CalibrationProblem problem = bench.problem({}, kFour);
  const CalibrationResult result = calibrate(problem, options_with(0));
  for (const ParameterEstimate& e : result.inference.parameters) {
    std::printf("  %s %.5f of the truth, error %.3g %%\n", e.name.c_str(), e.value / bench.truth(e.name),
                100.0 * e.standard_error / e.value);
    EXPECT_LT(deviations_off(bench, e), 4.0) << e.name;
  }
  EXPECT_NEAR(result.inference.variance_factor, 1.0, 0.1);
  EXPECT_NEAR(result.inference.parameters[0].value / bench.truth(kFour[0]), 1.0, 0.01);
  EXPECT_NEAR(result.inference.parameters[2].value / bench.truth(kFour[2]), 1.0, 0.10);
}

// A second is what the windows have to grow to, through some fifty impacts; each run is one more of the same, and its errors are allowed what they
// say of themselves, so that fewer runs hold the intervals as well.
TEST(CalibrateLong, FourParametersFromThreeRunsOfASecond) {
  expect_four_parameters(Bench({1.5, 2.1, 2.85}, 1.0, false));
}
TEST(CalibrateNight, FourParametersFromTenRunsOfASecond) { expect_four_parameters(four_bar::ten_runs()); }

// BORESIGHT_CALIBRATION_SEED: of the first set; BORESIGHT_CALIBRATION_SETS: how many, a minute of one core each.
void expect_truth_inside(int sets, int starts) {
  const auto number = [](const char* name, int otherwise) {
    const char* asked = std::getenv(name);
    return asked ? std::atoi(asked) : otherwise;
  };
  sets = number("BORESIGHT_CALIBRATION_SETS", sets);
  const int first = number("BORESIGHT_CALIBRATION_SEED", 2000);
  const Bench bench({2.0, 2.4, 2.8}, 0.2, true);
  std::vector<std::vector<ParameterEstimate>> found(sets);
  for_each_on_threads(sets, 2, [&](int set) {
    SyntheticRig rig;
    rig.seed = static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(set);
    CalibrationProblem problem = bench.problem(rig, kFour);
    CalibrationOptions options;
    options.profile = true;
    options.starts = starts;
    found[set] = calibrate(problem, options).inference.parameters;
  });
  for (int p = 0; p < 4; ++p) {
    const double truth = bench.truth(kFour[p]);
    int inside = 0;
    double worst = 0.0;
    for (const auto& set : found) {
      inside += set[p].low <= truth && truth <= set[p].high;
      worst = std::max(worst, std::abs(set[p].value / truth - 1.0));
    }
    std::printf("  %s: truth inside %d of %d intervals of 95 %%, largest error %.3g %%\n", kFour[p].c_str(), inside,
                sets, 100.0 * worst);
    // 90 to 99 % of many sets; of few, what chance makes of 95 % (2.5 deviations of the binomial).
    EXPECT_GE(inside, sets >= 100 ? 0.90 * sets : 0.95 * sets - 2.5 * std::sqrt(0.95 * 0.05 * sets)) << kFour[p];
    if (sets >= 100) {
      EXPECT_LE(inside, 0.99 * sets) << kFour[p];
    }
    if (p == 0) {
      EXPECT_LE(worst, 0.01);
    }
    if (p == 2) {
      EXPECT_LE(worst, 0.10);
    }
  }
}

// Of 5 sets one may miss: an interval that holds the truth in 60 cases of 100 where it says 95 % is found out with a chance of 66 % by each of the
// four parameters, one that holds it in half with 81 %, and one that does what it says passes with 98 %. By one start: that further ones find the
// valley of the truth is held above.
TEST(CalibrateLong, TruthIsInsideTheIntervalOfMultibodyDataAsOftenAsStated) { expect_truth_inside(5, 1); }
// Of 20 sets three may, by as many starts as a study has: 77 % and 98 %.
TEST(CalibrateNight, TruthIsInsideTheIntervalOfTwentySetsAsOftenAsStated) { expect_truth_inside(20, 4); }

}  // namespace calibrate_test
}  // namespace boresight
