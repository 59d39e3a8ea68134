// Ways of computing a motion, and finer ones of them.
#include "boresight_analyses/study/measurement.hpp"

#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "scenes.hpp"

namespace boresight {
namespace measurement_test {

TEST(RungSetup, FinerIsHalfTheStepOrATenthOfTheTolerance) {
  const RungSetup steps{.rung = "multibody", .step = 1e-4};
  EXPECT_DOUBLE_EQ(steps.finer().step, 5e-5);
  EXPECT_EQ(steps.finer().tolerance, 0.0);
  const RungSetup controlled{.rung = "multibody", .integrator = "dopri5", .tolerance = 1e-3};
  EXPECT_DOUBLE_EQ(controlled.finer().tolerance, 1e-4);
  // Where none is given, of the one that is taken then.
  const RungSetup own{.rung = "multibody", .integrator = "dopri5"};
  EXPECT_DOUBLE_EQ(own.finer().tolerance, 0.1 * tolerance_of(own.options(), "multibody"));
  // An integrator with error control that was given a step takes that one.
  const RungSetup held{.rung = "multibody", .integrator = "dopri5", .step = 1e-4};
  EXPECT_DOUBLE_EQ(held.finer().step, 5e-5);
  const RungSetup lanes{.rung = "perturbation", .tolerance = 2e-3, .lanes = true},
      plain{.rung = "perturbation", .lanes = true};
  EXPECT_DOUBLE_EQ(lanes.finer().tolerance, 2e-4);
  EXPECT_DOUBLE_EQ(plain.finer().tolerance, 0.1 * kLaneTolerance);
  EXPECT_TRUE(lanes.finer().lanes);
}

TEST(RungSetup, IsNamedByAllButHowFinely) {
  const RungSetup setup{
      .rung = "multibody", .formulation = "paper", .stabilisation = "baumgarte", .integrator = "rk4", .step = 1e-4};
  EXPECT_EQ(setup.family(), "multibody, paper, baumgarte, rk4");
  EXPECT_EQ(setup.finer().family(), setup.family());
  EXPECT_EQ((RungSetup{.rung = "quasistatic", .integrator = "rk4"}.family()), "quasistatic");
}

// Its mean step is none of rk4's: the motion blew up where a neighbour took it for one.
TEST(Measurement, HasNeighboursOfTheIntegratorThatTookOver) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "200 ms"}, {"payload.mass", "250 kg"}}));
  const auto rung = make_rung("multibody", mechanism);
  const RungSetup own{.rung = "multibody"};
  ASSERT_EQ(rung->run(mechanism->parameters(), own.options()).integrator_taken, "rosenbrock");
  const Measurement m = measure(*rung, mechanism->parameters(), own, {});
  EXPECT_EQ(m.refusal, "");
  EXPECT_EQ(m.integrator, "rosenbrock");
  EXPECT_EQ(m.values.size(), 3u);
  EXPECT_LT(m.half_spread, 0.02 * m.value);
}

// Sighted from 400 km, a displacement of a tenth of a millimetre is 0.25 nrad: an error like any other.
TEST(Measurement, OfALineOfSightIsNothingOnlyWhereTheDisplacementIs) {
  MechanismDescription d = scenes::rrcpr();
  d.line_of_sight = {.from = {0.0, 0.0, 0.5}, .target = {0.0, 0.0, 4e5}, .origin = {}};
  const Mechanism far{d};
  EXPECT_NEAR(distance_of_target(far), 4e5, 1.0);
  Measurement m;
  m.value = 2.0e-10;
  EXPECT_GT(relative_error(m, 2.5e-10, nothing_of({"line_of_sight_error", "max"}, far)), 0.1);
  EXPECT_EQ(relative_error(m, 2.5e-10, nothing_of({"position_error", "max"}, far)), 0.0);
}

}  // namespace measurement_test
}  // namespace boresight
