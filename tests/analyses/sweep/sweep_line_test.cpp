#include "boresight_analyses/sweep/sweep_line.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace sweep_line_test {

TEST(SweepLine, RisesOnlyIfEveryStepDoes) {
  EXPECT_TRUE(rises({1.0, 1.1, 1.2}));
  EXPECT_FALSE(rises({1.0, 1.1, 1.05}));
  EXPECT_FALSE(rises({1.0, 1.001}));
  EXPECT_TRUE(falls({3.0, 2.0, 1.0}));
  EXPECT_FALSE(rises({1.0}));
}

TEST(SweepLine, SlopeOfALine) { EXPECT_NEAR(slope({1.0, 2.0, 4.0}, {3.0, 5.0, 9.0}), 2.0, 1e-12); }

TEST(SweepLine, HoldsTheOtherAxesAtTheirFirstValueAndSkipsWhatIsNotDone) {
  SweepPlan plan;
  plan.axes = {{{"a"}, "m", {2.0, 1.0, 3.0}}, {{"b"}, "kg", {5.0, 6.0}}};
  SweepResult result;
  for (std::size_t k = 0; k < plan.points(); ++k)
    result.points.push_back({SweepPoint::Status::done, plan.values_at(k), {}, {}});
  result.points[4].status = SweepPoint::Status::failed;  // a = 3, b = 5
  const SweepLine line = line_along(plan, result, 0);
  EXPECT_EQ(line.values, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(line.point, (std::vector<std::size_t>{2, 0}));
}

TEST(SweepLine, MeanContactMeetsHertzWhereTheForceIsHertz) {
  RunResult result;
  constexpr double K = 1e11;
  result.clearances.resize(1);
  for (const double depth : {1e-6, 4e-6, -1.0})
    result.clearances[0].push_back(
        {Vec3::Zero(), depth, depth > 0.0 ? K * std::pow(depth, 1.5) : 0.0, depth > 0.0 ? 1 : 0});
  const auto mean = mean_contact(result, K);
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->penetration, 2.5e-6, 1e-15);
  EXPECT_NEAR(mean->hertz, mean->penetration, 1e-15);
  EXPECT_NEAR(mean->force, 0.5 * K * (1e-9 + 8e-9), 1e-9);
}

TEST(SweepLine, AwayFromTheBoreIsTheTimeOutsideRadialContacts) {
  RunResult result;
  result.end_time = 2.0;
  result.events = {{0, ContactPlace::radial, 0.1, 0, 1.0, 0, 0, 0},
                   {0, ContactPlace::axial_plus, 0.1, 0, 1.5, 0, 0, 0},
                   {0, ContactPlace::radial, 1.5, 0, 0.4, 0, 0, 0}};
  EXPECT_NEAR(*off_the_bore_share(result), 0.3, 1e-12);
}

TEST(SweepLine, AngularDisturbanceIsHeldAgainstTheLargestOfTheIdealMotion) {
  RunResult result;
  EXPECT_FALSE(angular_acceleration_disturbance(result));  // no histories
  result.boresight.samples.resize(3);
  result.boresight.samples[0].alpha = Vec3(0.0, 0.03, 0.04);
  EXPECT_FALSE(angular_acceleration_disturbance(result));  // ideally it does not turn
  result.boresight.samples[1].alpha = result.boresight.samples[1].ideal_alpha = Vec3(0.2, 0.0, 0.0);
  result.boresight.samples[2].ideal_alpha = Vec3(0.0, 0.1, 0.0);
  result.boresight.samples[2].alpha = Vec3(0.0, 0.0, 0.0);
  EXPECT_NEAR(*angular_acceleration_disturbance(result), 0.1 / 0.2, 1e-12);
}

}  // namespace sweep_line_test
}  // namespace boresight
