// Parallel mechanisms with play in every one of their joints: the perturbation rung against multibody. What a sample of them costs, the
// benchmark every_joint_benchmark.cpp prints.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "boresight/ladder/ladder.hpp"
#include "every_joint_scenes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace every_joint_test {

struct Indices {
  double position = 0.0, largest = 0.0, turn = 0.0;  // [m, m, rad]
};

// Means over motions of these tolerances; 0 is the rung's own choice.
Indices means(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
              const std::vector<double>& tolerances) {
  Indices mean;
  for (const double tolerance : tolerances) {
    RunOptions options;
    options.sample_spacing = 0.0;
    if (tolerance > 0.0) {
      options.integrator = "rosenbrock";
      options.tolerance = tolerance;
    }
    const PointingIndices index = make_rung(rung, mechanism)->run(mechanism->parameters(), options).index;
    const double share = 1.0 / static_cast<double>(tolerances.size());
    mean.position += share * index.position_error.rms;
    mean.largest += share * index.position_error.max;
    mean.turn += share * index.orientation_error.rms;
  }
  return mean;
}

// turns: whether the play turns the boresight body at all.
void expect_linear_as_exact(const MechanismDescription& m, bool turns, const std::vector<double>& tolerances = {0.0}) {
  const auto mechanism = scenes::build(m);
  const Indices exact = means("multibody", mechanism, tolerances),
                linear = means("perturbation", mechanism, tolerances);
  ASSERT_GT(exact.position, 1e-5);
  EXPECT_NEAR(linear.position / exact.position, 1.0, 0.01);
  EXPECT_NEAR(linear.largest / exact.largest, 1.0, 0.02);
  ASSERT_EQ(exact.turn > 1e-7, turns);
  if (turns) {
    EXPECT_NEAR(linear.turn / exact.turn, 1.0, 0.01);
  }
}

TEST(PlayInEveryJoint, OfTheDefaultMechanismIsFollowedAlike) {
  const MechanismDescription m = scenes::fifteen_joints(JournalAxes::parallel, 0.05);
  ASSERT_EQ(m.clearances.size(), 15u);
  ASSERT_EQ(m.joints.size(), 15u);
  expect_linear_as_exact(m, false);
}
TEST(PlayInEveryJointNight, OfTheDefaultMechanismIsFollowedAlikeForHalfASecond) {
  expect_linear_as_exact(scenes::fifteen_joints(JournalAxes::parallel, 0.5), false);
}
// Its platform hangs over by some 20 mrad: what twelve bearings of 30 mm let it. It strikes so often that single motions of either rung
// scatter by 0.5 % with the tolerance (1e-3 to 1e-5); means of four are known to a quarter of a percent.
TEST(PlayInEveryJointNight, OfTheDefaultMechanismThatTiltsIsFollowedAlike) {
  expect_linear_as_exact(scenes::fifteen_joints(JournalAxes::free, 0.12), true, {8e-4, 4e-4, 2e-4, 1e-4});
}
TEST(PlayInEveryJoint, OfAHexapodIsFollowedAlikeForASecondLong) {
  const MechanismDescription m = scenes::eighteen_joints(JournalAxes::parallel, 1.0);
  ASSERT_EQ(m.clearances.size(), 24u);  // two to each universal joint
  ASSERT_EQ(m.joints.size(), 24u);
  expect_linear_as_exact(m, true);
}
TEST(PlayInEveryJointLong, OfAHexapodThatTiltsIsFollowedAlike) {
  expect_linear_as_exact(scenes::eighteen_joints(JournalAxes::free, 0.3), true);
}
TEST(PlayInEveryJointNight, OfAHexapodThatTiltsIsFollowedAlikeForASecond) {
  expect_linear_as_exact(scenes::eighteen_joints(JournalAxes::free, 1.0), true);
}

}  // namespace every_joint_test
}  // namespace boresight
