// Mechanisms of any number of joints on lanes: the forces' form, in windows of the scene (lane_window_step.hpp).
#include <gtest/gtest.h>

#include <filesystem>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/mechanism/error.hpp"
#include "scenes.hpp"

namespace boresight {
namespace many_joints_test {

Statistics of_the_rung(const std::shared_ptr<const Mechanism>& mechanism, double step) {
  RunOptions options;
  options.step = step;
  options.sample_spacing = 0.0;
  return make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).index.position_error;
}

Statistics of_the_rung_closely(const std::shared_ptr<const Mechanism>& mechanism) {
  RunOptions options;
  options.integrator = "rosenbrock";
  options.tolerance = 1e-7;
  options.share_of_longest_step = 0.1;  // means over time are sums over steps
  options.sample_spacing = 0.0;
  return make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).index.position_error;
}

LaneOutcome on_lanes(const std::shared_ptr<const Mechanism>& mechanism, double tolerance) {
  LaneOutcome out;
  PerturbationLanes(mechanism, PointingQuantity::position_error)
      .run({&mechanism->parameters(), 1}, {&out, 1}, tolerance);
  return out;
}

// Twelve joints: 33 coordinates, three of them along the axes of cylindrical joints.
TEST(ManyJoints, FollowTheRungWithPlayInAllJoints) {
  const auto mechanism = scenes::build(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml", {{"motion.duration", "0.01 s"}}));
  ASSERT_EQ(mechanism->clearances(), 12);
  const Statistics expected = of_the_rung(mechanism, 1e-6);
  const LaneOutcome out = on_lanes(mechanism, 1e-6);
  EXPECT_EQ(out.status, LaneStatus::done);
  EXPECT_NEAR(out.max, expected.max, 1e-3 * expected.max);
  EXPECT_NEAR(std::sqrt(out.mean_square), expected.rms, 1e-3 * expected.rms);
}

// Gimbals with bearing pairs, whose offsets are tied; loops without drives; springs and dampers; planar linkages.
// Against steps under control: of the gimbal in bearing pairs rk4's of 2 us leave 0.2 % of the maximum, and those of 1 us 0.5 %.
TEST(ManyJoints, FollowTheRungOnTheGauntletsArchetypes) {
  int followed = 0, moved = 0;
  for (const auto& file : std::filesystem::directory_iterator(BORESIGHT_CORPUS)) {
    if (file.path().extension() != ".toml") continue;
    const std::string name = file.path().filename();
    const auto mechanism =
        scenes::build(read_mechanism(file.path(), {{"motion.duration", "0.02 s"}, {"initial.journals", "centred"}}));
    if (!PerturbationLanes::serve(*mechanism)) continue;
    Statistics expected;
    try {
      expected = of_the_rung_closely(mechanism);
    } catch (const ComputationError& refused) {  // the rung has no scene of it, and lanes have none either
      EXPECT_THROW(on_lanes(mechanism, 1e-6), ComputationError) << name << ": " << refused.what();
      continue;
    }
    const LaneOutcome out = on_lanes(mechanism, 1e-6);
    ++followed;
    moved += expected.max > 1e-7;
    EXPECT_EQ(out.status, LaneStatus::done) << name;
    EXPECT_NEAR(out.max, expected.max, 1e-3 * expected.max + 1e-10) << name;
    EXPECT_NEAR(std::sqrt(out.mean_square), expected.rms, 1e-3 * expected.rms + 1e-10) << name;
    std::printf("%-32s %2d joints: maximum %.5g m (%+.2g m), %ld steps\n", name.c_str(), mechanism->clearances(),
                out.max, out.max - expected.max, out.steps + out.rejected);
  }
  EXPECT_GT(followed, 25);
  EXPECT_GT(moved, 20) << "what stands still tells nothing";
}

// No gravity, no motion: nothing sets a scale for rates but the time that the motion takes.
TEST(ManyJoints, FloatWhereNothingLoadsThem) {
  MechanismDescription d = scenes::rrcpr({{"motion.duration", "0.02 s"},
                                          {"motion.angles.psi", "0.4"},
                                          {"motion.angles.theta", "0.2"},
                                          {"motion.angles.phi", "-0.4"},
                                          {"motion.position.z", "500*cos(theta)"}});
  d.gravity.setZero();
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    d.clearances[0].axes = axes;
    const LaneOutcome out = on_lanes(scenes::build(MechanismDescription(d)), 1e-3);
    EXPECT_EQ(out.status, LaneStatus::done);
    EXPECT_LT(out.max, 1e-9);
  }
}

// What one joint does tells nothing of the others: the share is that of the joint least in contact.
TEST(ManyJoints, TellTheFreeFlightOfTheJointThatFliesMost) {
  const auto mechanism = scenes::build(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml", {{"motion.duration", "0.01 s"}}));
  RunOptions options;
  options.step = 1e-6;
  const RunResult run = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
  double least = 1.0, impacts = 0.0;
  for (const ContactSummary& joint : run.contact) {
    least = std::min(least, joint.contact_fraction);
    impacts += static_cast<double>(joint.impacts);
  }
  const LaneOutcome out = on_lanes(mechanism, 1e-6);
  EXPECT_NEAR(1.0 - out.free_flight_share, least, 0.01);
  EXPECT_NEAR(static_cast<double>(out.impacts), impacts, 3.0);
}

}  // namespace many_joints_test
}  // namespace boresight
