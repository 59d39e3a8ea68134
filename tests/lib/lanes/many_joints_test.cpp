// Mechanisms of any number of joints on lanes: the forces' form, in windows of the scene (lane_window_step.hpp).
#include <gtest/gtest.h>

#include <filesystem>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

Statistics of_the_rung(const std::shared_ptr<const Mechanism>& mechanism, double step) {
  RunOptions options;
  options.step = step;
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
TEST(ManyJoints, FollowTheRungOnTheGauntletsArchetypes) {
  int followed = 0;
  for (const auto& file : std::filesystem::directory_iterator(BORESIGHT_CORPUS)) {
    if (file.path().extension() != ".toml") continue;
    const std::string name = file.path().filename();
    try {
      const auto mechanism =
          scenes::build(read_mechanism(file.path(), {{"motion.duration", "0.02 s"}, {"initial.journals", "centred"}}));
      if (!PerturbationLanes::serve(*mechanism)) continue;
      const Statistics expected = of_the_rung(mechanism, 2e-6);
      const LaneOutcome out = on_lanes(mechanism, 1e-6);
      ++followed;
      EXPECT_EQ(out.status, LaneStatus::done) << name;
      EXPECT_NEAR(out.max, expected.max, 1e-3 * expected.max + 1e-10) << name;
      EXPECT_NEAR(std::sqrt(out.mean_square), expected.rms, 1e-3 * expected.rms + 1e-10) << name;
      std::printf("%-32s %2d joints: maximum %.5g m (%+.3f %%), %ld steps\n", name.c_str(), mechanism->clearances(),
                  out.max, 100.0 * (out.max / expected.max - 1.0), out.steps + out.rejected);
    } catch (const std::exception& refused) {
      std::printf("%-32s %s\n", name.c_str(), refused.what());
    }
  }
  EXPECT_GT(followed, 20);
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

}  // namespace
}  // namespace boresight
