// The energy's balance of a run sees what its steps, its stabilisation and its joints' drift make or lose.
#include "boresight/formulations/energy_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "published_examples.hpp"
#include "scenes.hpp"
#include "slider_in_guide_file.hpp"

namespace boresight {
namespace energy_balance_test {

struct RungSetup {
  std::string formulation, integrator;
  double step = 0.0, tolerance = 0.0;
};

RunResult run(const std::shared_ptr<const Mechanism>& mechanism, const RungSetup& setup) {
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  options.formulation = setup.formulation;
  options.integrator = setup.integrator;
  options.step = setup.step;
  options.tolerance = setup.tolerance;
  return make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
}

double energy_error(const std::shared_ptr<const Mechanism>& mechanism, const RungSetup& setup) {
  return run(mechanism, setup).energy_error;
}

// Smooth: half the step, at the fourth order, leaves a sixteenth.
TEST(EnergyBalance, ShrinksWithTheOrderOfTheMethodWhereTheMotionIsSmooth) {
  const auto mechanism = scenes::example("heavy-top", {{"motion.duration", "0.1 s"}});
  const double coarse = energy_error(mechanism, {"tree", "rk4", 1e-3}),
               fine = energy_error(mechanism, {"tree", "rk4", 5e-4});
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(coarse, 10.0 * fine);
  EXPECT_GT(fine, 0.0);
}

// With drives, gravity, impacts and friction.
TEST(EnergyBalance, HoldsThroughContactWithDrivesAndShrinksWithTheStep) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "30 ms"}}));
  for (const char* formulation : {"tree", "paper"}) {
    const double coarse = energy_error(mechanism, {formulation, "rk4", 1e-4}),
                 fine = energy_error(mechanism, {formulation, "rk4", 1e-5});
    EXPECT_LT(fine, 1e-5) << formulation;
    EXPECT_GT(coarse, 10.0 * fine) << formulation;
  }
}

TEST(EnergyBalance, FollowsTheToleranceOfEveryIntegrator) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "30 ms"}}));
  for (const char* integrator : {"dopri5", "rosenbrock", "generalized-alpha"}) {
    const double loose = energy_error(mechanism, {"tree", integrator, 0.0, 3e-3}),
                 tight = energy_error(mechanism, {"tree", integrator, 0.0, 1e-4});
    EXPECT_LT(tight, 10.0 * 1e-4) << integrator << ": many steps, each within the tolerance";
    EXPECT_GT(loose, 4.0 * tight) << integrator;
  }
}

TEST(EnergyBalance, IsWarnedOfWhereStepsLoseMoreThanAHundredth) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "30 ms"}}));
  for (const double tolerance : {0.1, 1e-3}) {
    const RunResult result = run(mechanism, {"tree", "generalized-alpha", 0.0, tolerance});
    bool warned = false;
    for (const std::string& warning : result.warnings)
      warned = warned || warning.find("of the largest energy of this motion") != std::string::npos;
    EXPECT_EQ(warned, tolerance > 0.01) << result.energy_error;
    EXPECT_EQ(warned, result.energy_error > 0.01);
  }
}

// A slider that its weight presses on its guide: nothing moves, and rounding has no share that steps could keep.
TEST(EnergyBalance, IsNotLookedAtWhereNothingMoves) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism_text(scenes::slider_in_guide("40 mm", "60 mm"), "slider.toml", std::vector<Setting>{}));
  for (const char* integrator : {"rk4", "rosenbrock"}) {
    const RunResult result = run(mechanism, {"tree", integrator});
    EXPECT_GT(result.index.position_error.max, 15e-6);
    EXPECT_EQ(result.energy_error, 0.0) << integrator;
    for (const std::string& warning : result.warnings)
      EXPECT_EQ(warning.find("energy"), std::string::npos) << integrator << ": " << warning;
  }
}

TEST(EnergyBalance, DoesNotDependOnWhereTheDrawingLies) {
  const std::string file = std::string(BORESIGHT_EXAMPLES) + "/heavy-top/heavy-top.toml";
  MechanismDescription near = read_mechanism(file, {{"motion.duration", "0.05 s"}}), far = near;
  const Vec3 moved(0.0, 0.0, 10.0);
  for (BodyDescription& b : far.bodies) b.center_of_mass += moved;
  for (JointDescription& j : far.joints) j.point += moved;
  const RungSetup setup{"tree", "rk4", 1e-3};
  const double here = energy_error(scenes::build(std::move(near)), setup);
  EXPECT_GT(here, 0.0);
  EXPECT_NEAR(energy_error(scenes::build(std::move(far)), setup) / here, 1.0, 0.01);
}

// No drives, no springs, no contacts: whatever speeds the bodies have, joints that open included, nothing is done to them but by gravity and,
// where they open, by the joints.
TEST(EnergyBalance, FindsNoPowerInAFreeMechanismWhoseJointsOpen) {
  const auto mechanism = scenes::example("double-four-bar");
  IdealState start;
  ideal_motion(*mechanism, mechanism->parameters()).state(0.0, start);
  const std::vector<ContactMemory> none(static_cast<std::size_t>(mechanism->clearances()));
  const auto formulation =
      make_paper_formulation(*mechanism, mechanism->parameters(), nullptr, {.with_clearance = false});
  VecX y;
  formulation->start(start, y);
  VecX dy(y.size());
  constexpr int kPerBody = 13;
  for (int b = 0; b < mechanism->bodies(); ++b)
    for (int k = 7; k < kPerBody; ++k) y[kPerBody * b + k] += 0.1 * std::sin(1.0 + 3.0 * b + k);
  formulation->derivative(0.0, y, none, dy);
  const std::vector<BodyMotion> bodies = formulation->bodies(0.0, y);
  const EnergyBalance balance(*mechanism, mechanism->parameters(), bodies);
  EXPECT_GT(std::abs(formulation->opening_power()), 1e-3);
  EXPECT_NEAR(balance.power(*formulation, bodies), 0.0, 1e-9 * std::abs(formulation->opening_power()));
}

}  // namespace energy_balance_test
}  // namespace boresight
