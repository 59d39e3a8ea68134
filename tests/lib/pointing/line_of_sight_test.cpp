// The line of sight: an angle at a target, with all its digits however far that is.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/pointing/indices.hpp"

namespace boresight {
namespace line_of_sight_test {

const Quat kTurned(Eigen::AngleAxisd(0.3, Vec3(1, 2, -1).normalized()));

double line_of_sight(const Pose& truth, const Pose& ideal, const LineOfSight& sight) {
  return pose_error(truth, ideal, {Vec3::UnitZ(), sight}).line_of_sight;
}

TEST(LineOfSight, IsTheAngleAtTheTargetBetweenTrueAndIdealReferencePoint) {
  const LineOfSight sight{.from_B = Vec3::Zero(), .target = {0.0, 0.0, 4.0}};
  const Pose ideal{Vec3::Zero(), kTurned}, aside{{3.0, 0.0, 0.0}, kTurned}, along{{0.0, 0.0, 1.5}, kTurned};
  EXPECT_NEAR(line_of_sight(aside, ideal, sight), std::atan2(3.0, 4.0), 1e-15);
  EXPECT_NEAR(line_of_sight(along, ideal, sight), 0.0, 1e-15);
}

TEST(LineOfSight, SeesATurnThatMovesItsReferencePoint) {
  const LineOfSight sight{.from_B = {0.0, 0.0, 0.5}, .target = {0.0, 0.0, 10.5}};
  const Pose ideal, turned{Vec3::Zero(), Quat(Eigen::AngleAxisd(1e-5, Vec3::UnitX()))};
  EXPECT_NEAR(line_of_sight(turned, ideal, sight) / (0.5e-5 / 10.0), 1.0, 1e-9);
  const LineOfSight from_centre{.from_B = Vec3::Zero(), .target = {0.0, 0.0, 10.5}};
  EXPECT_EQ(line_of_sight(turned, ideal, from_centre), 0.0);
}

TEST(LineOfSight, KeepsAllDigitsToATargetInOrbit) {
  const double range = 4e5;
  const LineOfSight sight{.from_B = Vec3::Zero(), .target = {0.0, 0.0, range}};
  const Pose ideal{Vec3::Zero(), kTurned}, truth{{3.1e-5, -4.2e-5, 7e-6}, kTurned};
  const double expected = std::hypot(3.1e-5, 4.2e-5) / (range - 7e-6);
  EXPECT_NEAR(line_of_sight(truth, ideal, sight) / expected, 1.0, 1e-14);
  EXPECT_NEAR(
      error_vector(PointingQuantity::line_of_sight_error, truth, ideal, {Vec3::UnitZ(), sight}).norm() / expected, 1.0,
      1e-14);
}

TEST(LineOfSight, ItsGainIsTheErrorToFirstOrder) {
  const LineOfSight sight{.from_B = {0.1, -0.2, 0.05}, .target = {1.0, 2.0, -3.0}};
  const Pose ideal{{0.4, 0.1, -0.3}, kTurned};
  Vec6 x;
  x << 2e-6, -1e-6, 3e-6, 1e-6, 2e-6, -4e-6;
  const Vec3 turn = x.tail<3>();
  const Pose truth{ideal.p + x.head<3>(), Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * ideal.q};
  EXPECT_NEAR((sight.gain(ideal) * x).norm() / line_of_sight(truth, ideal, sight), 1.0, 1e-5);
}

TEST(LineOfSight, WithoutATargetThereIsNone) {
  IndicesOverTime none(false), some(true);
  for (IndicesOverTime* indices : {&none, &some}) {
    indices->add(0.0, {});
    indices->add(1.0, {});
  }
  EXPECT_FALSE(none.result().has_line_of_sight);
  EXPECT_TRUE(some.result().has_line_of_sight);
}

// e(t) = 1 - t over one second, from 0.35 s on: by hand.
TEST(StatisticsOverTime, LeaveOutWhatComesBeforeTheirStart) {
  StatisticsOverTime all, late(0.35);
  for (int k = 0; k <= 10; ++k)
    for (StatisticsOverTime* s : {&all, &late}) s->add(0.1 * k, 1.0 - 0.1 * k);
  EXPECT_DOUBLE_EQ(all.result().max, 1.0);
  EXPECT_NEAR(all.result().mean, 0.5, 1e-15);
  EXPECT_NEAR(late.result().max, 0.65, 1e-15);
  EXPECT_NEAR(late.result().time_of_max, 0.35, 1e-15);
  EXPECT_NEAR(late.result().mean, 0.325, 1e-15);
}

TEST(StatisticsOverTime, AStartAtZeroLeavesOutNothing) {
  StatisticsOverTime s(0.0);
  s.add(0.0, 2.0);
  s.add(1.0, 1.0);
  EXPECT_EQ(s.result().max, 2.0);
  EXPECT_EQ(s.result().time_of_max, 0.0);
}

}  // namespace line_of_sight_test
}  // namespace boresight
