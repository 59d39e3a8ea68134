// Parallel mechanisms with play in every one of their joints: the perturbation rung against multibody. What a sample of them costs, the
// benchmark every_joint_benchmark.cpp prints.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "every_joint_scenes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace every_joint_test {

// turns: whether the play turns the boresight body at all.
void expect_linear_as_exact(const MechanismDescription& m, bool turns) {
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 0.0;
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
  const double position = exact.index.position_error.rms, turn = exact.index.orientation_error.rms;
  ASSERT_GT(position, 1e-5);
  EXPECT_NEAR(linear.index.position_error.rms / position, 1.0, 0.01);
  EXPECT_NEAR(linear.index.position_error.max / exact.index.position_error.max, 1.0, 0.02);
  ASSERT_EQ(turn > 1e-7, turns);
  if (turns) {
    EXPECT_NEAR(linear.index.orientation_error.rms / turn, 1.0, 0.01);
  }
}

TEST(PlayInEveryJoint, OfTheDefaultMechanismIsFollowedAlike) {
  const MechanismDescription m = scenes::fifteen_joints(JournalAxes::parallel, 0.05);
  ASSERT_EQ(m.clearances.size(), 15u);
  ASSERT_EQ(m.joints.size(), 15u);
  expect_linear_as_exact(m, false);
}
TEST(PlayInEveryJoint, OfTheDefaultMechanismIsFollowedAlikeForHalfASecondLong) {
  expect_linear_as_exact(scenes::fifteen_joints(JournalAxes::parallel, 0.5), false);
}
// Its platform hangs over by some 20 mrad: what twelve bearings of 30 mm let it.
TEST(PlayInEveryJoint, OfTheDefaultMechanismThatTiltsIsFollowedAlikeLong) {
  expect_linear_as_exact(scenes::fifteen_joints(JournalAxes::free, 0.2), true);
}
TEST(PlayInEveryJoint, OfAHexapodIsFollowedAlikeForASecondLong) {
  const MechanismDescription m = scenes::eighteen_joints(JournalAxes::parallel, 1.0);
  ASSERT_EQ(m.clearances.size(), 24u);  // two to each universal joint
  ASSERT_EQ(m.joints.size(), 24u);
  expect_linear_as_exact(m, true);
}
TEST(PlayInEveryJoint, OfAHexapodThatTiltsIsFollowedAlikeForASecondLong) {
  expect_linear_as_exact(scenes::eighteen_joints(JournalAxes::free, 1.0), true);
}

}  // namespace every_joint_test
}  // namespace boresight
