// Accuracy against speed: what the chart measures, and what it makes of it.
#include "boresight_analyses/chart/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "scenes.hpp"

namespace boresight {
namespace chart_test {

ChartPoint point(double cpu, double error, const std::string& refusal = "") {
  ChartPoint p;
  p.measured.cpu_seconds = cpu;
  p.measured.refusal = refusal;
  p.error = error;
  return p;
}

TEST(ParetoFront, HoldsThePointsThatNoOtherBeats) {
  const std::vector<ChartPoint> points = {point(3.0, 0.01), point(1.0, 0.1), point(2.0, 0.2), point(4.0, 0.001),
                                          point(0.1, 1e-9, "failed")};
  EXPECT_EQ(pareto_front(points, 0.0), (std::vector<std::size_t>{1, 0, 3}));
}

TEST(ParetoFront, EndsWhereTheReferenceTellsNothingApart) {
  const std::vector<ChartPoint> points = {point(1.0, 0.1), point(2.0, 0.004), point(3.0, 0.001)};
  EXPECT_EQ(pareto_front(points, 0.005), (std::vector<std::size_t>{0, 1}));
}

TEST(ParetoFront, AWayIsWithinAnAccuracyWhereTheReferenceLeavesNoDoubt) {
  ChartResult result;
  result.reference.uncertainty = 0.004;
  ChartPoint near, nearer;
  near.error = 0.008;
  near.measured.cpu_seconds = 1.0;
  nearer.error = 0.005;
  nearer.measured.cpu_seconds = 2.0;
  result.points = {near, nearer};
  ASSERT_NE(result.cheapest_within(0.01), nullptr);
  EXPECT_EQ(result.cheapest_within(0.01)->error, 0.005);
  EXPECT_EQ(result.cheapest_within(0.013)->error, 0.008);
  EXPECT_EQ(result.cheapest_within(0.008), nullptr);
}

TEST(ChartWays, CoverEveryRungFormulationAndIntegratorFromCoarseToFine) {
  const std::vector<SetupFamily> families = chart_setups(1e-4);
  std::set<std::string> rungs, names, integrators;
  for (const SetupFamily& f : families) {
    EXPECT_TRUE(names.insert(f.name).second) << f.name;
    rungs.insert(f.setups.front().rung);
    integrators.insert(f.setups.front().integrator);
    for (std::size_t k = 1; k < f.setups.size(); ++k) {
      EXPECT_LE(f.setups[k].step, f.setups[k - 1].step);
      EXPECT_LE(f.setups[k].tolerance, f.setups[k - 1].tolerance);
    }
  }
  EXPECT_EQ(rungs.size(), rung_names().size());
  for (const char* name : {"rk4", "dopri5", "rosenbrock", "generalized-alpha"})
    EXPECT_TRUE(integrators.count(name)) << name;
  for (const char* name :
       {"multibody, tree, projection, rk4", "multibody, paper, baumgarte, rk4", "multibody, paper, projection, rk4"})
    EXPECT_TRUE(names.count(name)) << name;
}

class MeasureTest : public testing::Test {
 protected:
  std::shared_ptr<const Mechanism> mechanism_ = scenes::build(scenes::rrcpr({{"motion.duration", "0.05 s"}}));
};

TEST_F(MeasureTest, AWayThatFailsSaysWhyAndIsNoError) {
  const auto rung = make_rung("multibody", mechanism_);
  const Parameters p = mechanism_->parameters();
  RungSetup setup{.rung = "multibody", .formulation = "tree", .integrator = "rk4", .step = 2e-3};
  EXPECT_NE(measure(*rung, p, setup, {}).refusal.find("largest stable step"), std::string::npos);
  setup.integrator = "euler";
  EXPECT_NE(measure(*rung, p, setup, {}).refusal.find("integrator: found"), std::string::npos);
  setup.integrator = "rk4";
  setup.step = 1e-6;
  MeasureOptions hasty;
  hasty.most_seconds = 1e-3;
  EXPECT_NE(measure(*rung, p, setup, hasty).refusal.find("given up"), std::string::npos);
}

TEST_F(MeasureTest, CountsByTheMedianOfNeighboursWithTheirSpread) {
  const auto rung = make_rung("perturbation", mechanism_);
  const Parameters p = mechanism_->parameters();
  const RungSetup setup{.rung = "perturbation", .step = 5e-5};
  const Measurement m = measure(*rung, p, setup, {.index = {"position_error", "rms"}});
  std::vector<double> values;
  for (double share : {1.0, 0.985, 0.97}) {
    RunOptions options = setup.options();
    options.step *= share;
    values.push_back(rung->run(p, options).index.position_error.rms);
  }
  std::sort(values.begin(), values.end());
  EXPECT_EQ(m.value, values[1]);
  EXPECT_EQ(m.half_spread, 0.5 * (values[2] - values[0]));
  EXPECT_GT(m.cpu_seconds, 0.0);
  EXPECT_NEAR(m.step, 5e-5, 1e-9);
}

TEST_F(MeasureTest, TheReferenceKnowsItsOwnUncertainty) {
  const auto rung = make_rung("multibody", mechanism_);
  ReferenceOptions options;
  options.measure.index = {"position_error", "rms"};
  options.target = 1e-4;
  const Reference reference = find_reference(*rung, mechanism_->parameters(), options);
  ASSERT_GE(reference.refinements.size(), 2u);
  EXPECT_LT(reference.uncertainty, 1e-3);
  // A way of another formulation, fine, lands within a few of the uncertainties.
  const RungSetup paper{.rung = "multibody",
                        .formulation = "paper",
                        .stabilisation = "projection",
                        .integrator = "rk4",
                        .step = reference.refinements.back().step};
  const Measurement m = measure(*rung, mechanism_->parameters(), paper, options.measure);
  EXPECT_LT(relative_error(m, reference.value), 5.0 * std::max(reference.uncertainty, 1e-4));
}

TEST_F(MeasureTest, BeforeTheFirstImpactEachMethodShowsItsOrder) {
  const FreeFlight flight = fly(*mechanism_, mechanism_->parameters(), 5e-5, 10.0, [] { return true; });
  ASSERT_EQ(flight.why_not, "");
  EXPECT_LT(flight.rounding, 1e-8);
  EXPECT_LT(flight.end, flight.first_contact);
  std::vector<double> rk4, perturbation;
  for (const FlightPoint& p : flight.points) {
    if (p.family == "multibody, tree, projection, rk4") rk4.push_back(p.error);
    if (p.family == "perturbation, rk4") perturbation.push_back(p.error);
  }
  ASSERT_GE(rk4.size(), 6u);
  // Order four while above the roundings, which lie some 1e-12 of the clearance: from four steps in the flight to sixteen.
  EXPECT_NEAR(std::log2(rk4[0] / rk4[1]), 4.0, 0.1);
  EXPECT_NEAR(std::log2(rk4[1] / rk4[2]), 4.0, 0.15);
  EXPECT_LT(rk4.back(), 1e-10);
  // Perturbation's trajectory stays off by what the model leaves out, whatever the step.
  EXPECT_NEAR(perturbation.back() / perturbation[perturbation.size() - 2], 1.0, 0.01);
  EXPECT_GT(perturbation.back(), 10.0 * rk4.back());
}

TEST_F(MeasureTest, AChartMarksThePapersSettingAndItsFront) {
  ChartOptions options;
  options.index = {"position_error", "rms"};
#ifdef __SANITIZE_ADDRESS__
  constexpr double slower = 30.0;  // what the sanitisers' checks cost
#else
  constexpr double slower = 1.0;
#endif
  options.total_seconds = 0.5 * slower;
  options.most_seconds = 0.2 * slower;
  options.reference_seconds = 0.3 * slower;
  options.flight = false;
  const ChartResult result = make_chart(mechanism_, mechanism_->parameters(), options);
  ASSERT_NE(result.papers(), nullptr);
  EXPECT_EQ(result.papers()->setup.formulation, "paper");
  EXPECT_EQ(result.papers()->setup.step, 1e-4);
  ASSERT_GE(result.front.size(), 2u);
  for (std::size_t k = 1; k < result.front.size(); ++k) {
    EXPECT_GT(result.points[result.front[k]].measured.cpu_seconds,
              result.points[result.front[k - 1]].measured.cpu_seconds);
    EXPECT_LT(result.points[result.front[k]].error, result.points[result.front[k - 1]].error);
  }
  // What there was no time for is named, not left out in silence.
  std::set<std::string> there(result.left_out.begin(), result.left_out.end());
  for (const ChartPoint& p : result.points) there.insert(p.family);
  EXPECT_EQ(there.size(), chart_setups(1e-4).size());
}

TEST_F(MeasureTest, AChartStopsWhereItIsTold) {
  ChartOptions options;
  options.progress = [](double share, const std::string&) { return share < 0.2; };
  EXPECT_TRUE(make_chart(mechanism_, mechanism_->parameters(), options).interrupted);
}

TEST(ChartWays, SayHowFinelyTheyStep) {
  EXPECT_EQ(fineness({.rung = "quasistatic", .tolerance = 1e-3}), "no steps");
  EXPECT_EQ(fineness({.rung = "multibody", .integrator = "dopri5", .tolerance = 1e-3}), "tolerance 0.001");
  EXPECT_EQ(fineness({.rung = "multibody", .step = 5e-5}), "h = 50 us");
}

}  // namespace chart_test
}  // namespace boresight
