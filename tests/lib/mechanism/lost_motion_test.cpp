// Loops that a drive carries through a pose where they could go on in another way.
#include "boresight/mechanism/lost_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/formulations/starting_state.hpp"
#include "boresight/io/expression.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "boresight/mechanism/rank_analysis.hpp"
#include "scenes.hpp"

namespace boresight {
namespace lost_motion_test {

const std::vector<Vec3> kParallelogram = {{0, 0, 0}, {0, 0, 1}, {2, 0, 1}, {2, 0, 0}};

// Largest turn and displacement of the coupler of a parallelogram, its crank turned by `angle`, off where it stays parallel.
double off_parallel(const IdealMotion& motion, double (*angle)(double)) {
  double worst = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const double t = motion.duration() * k / 1000;
    const BodyMotion coupler = motion.body(t, 1);
    const Vec3 parallel(1.0 + std::sin(angle(t)), 0.0, std::cos(angle(t)));
    worst = std::max({worst, (coupler.R - Mat3::Identity()).norm(), (coupler.p - parallel).norm(), coupler.w.norm()});
  }
  return worst;
}

class ChangePoint : public testing::TestWithParam<bool> {};

TEST_P(ChangePoint, IsPassedOnTheBranchThatGoesOnSmoothly) {
  // At a state of the motion's table, between its states, at its end; passed once and twice.
  struct Case {
    const char* law;
    double (*angle)(double);
    std::vector<double> lost;
  };
  const double pi = std::numbers::pi;
  for (const Case& c : {Case{"2*pi*t", [](double t) { return 2.0 * std::numbers::pi * t; }, {0.25}},
                        Case{"5*t", [](double t) { return 5.0 * t; }, {pi / 10.0}},
                        Case{"pi*t", [](double t) { return std::numbers::pi * t; }, {0.5}},
                        Case{"7*pi*t",
                             [](double t) { return 7.0 * std::numbers::pi * t; },
                             {1.0 / 14.0, 3.0 / 14.0, 5.0 / 14.0, 0.5}}}) {
    const auto mechanism = scenes::build(scenes::four_bar(kParallelogram, GetParam(), c.law));
    const IdealMotion motion = ideal_motion(*mechanism, mechanism->parameters());
    EXPECT_LT(off_parallel(motion, c.angle), 1e-8) << c.law;
    EXPECT_LT(motion.error(), IdealMotion::kAccuracy) << c.law;
    ASSERT_EQ(motion.lost().size(), c.lost.size()) << c.law;
    for (std::size_t k = 0; k < c.lost.size(); ++k) EXPECT_NEAR(motion.lost()[k].t, c.lost[k], 1e-6) << c.law;
    EXPECT_NE(doubt_of(motion).find("singular pose at t = "), std::string::npos) << doubt_of(motion);
    EXPECT_EQ(analyse_kinematics(*mechanism).lost.size(), c.lost.size()) << c.law;
  }
}

INSTANTIATE_TEST_SUITE_P(OfAParallelogram, ChangePoint, testing::Bool(), [](const auto& p) {
  return p.param ? std::string("WithRedundantRows") : std::string("WithIndependentRows");
});

TEST(LostMotions, AreNoneOfALoopThatComesNearOneOnly) {
  // A bar longer by a thousandth of itself: crank and coupler never lie in one line with the ground.
  const auto mechanism =
      scenes::build(scenes::four_bar({{0, 0, 0}, {0, 0, 1}, {2.001, 0, 1.002}, {2, 0, 0}}, true, "2*pi*t"));
  const IdealMotion motion = ideal_motion(*mechanism, mechanism->parameters());
  EXPECT_TRUE(motion.lost().empty());
  EXPECT_EQ(doubt_of(motion), "");
  const auto paper = scenes::build(scenes::rrcpr());
  EXPECT_TRUE(ideal_motion(*paper, paper->parameters()).lost().empty());
}

// The locks of a linkage five thousand times smaller are weaker everywhere than those of the large one are near its singular pose.
TEST(LostMotions, AreNotHiddenByAPartThatIsHeldWeaklyEverywhere) {
  MechanismDescription m = scenes::four_bar(kParallelogram, true, "6.1*t");  // singular between looks, not at one
  const auto large = scenes::build(m);
  const std::size_t alone = ideal_motion(*large, large->parameters()).lost().size();
  ASSERT_GT(alone, 0u);
  MechanismDescription small =
      scenes::four_bar({{0, 0, 0}, {0, 0, 2e-4}, {4.4e-4, 0, 2.6e-4}, {4e-4, 0, 0}}, true, "0.1*t");
  const int bodies = static_cast<int>(m.bodies.size()), joints = static_cast<int>(m.joints.size());
  for (BodyDescription& body : small.bodies) {
    body.name += " small";
    body.boresight.reset();
    m.bodies.push_back(body);
  }
  for (JointDescription joint : small.joints) {
    joint.name += " small";
    if (joint.first != kGround) joint.first += bodies;
    if (joint.second != kGround) joint.second += bodies;
    m.joints.push_back(joint);
  }
  m.motion.drives[joints] = small.motion.drives.at(0);
  const auto mechanism = scenes::build(m);
  EXPECT_EQ(ideal_motion(*mechanism, mechanism->parameters()).lost().size(), alone);
}

TEST(LostMotions, AreOneWhereTheDriveStaysInOne) {
  const auto mechanism = scenes::build(scenes::four_bar(kParallelogram, true, "pi/2+0*t"));
  const IdealMotion motion = ideal_motion(*mechanism, mechanism->parameters());
  EXPECT_EQ(motion.lost().size(), 1u);
}

TEST(LostMotions, AreSaidOfTheDrawnMotionBesideWhatIsNotKnownOfTheBuiltOne) {
  const auto mechanism = scenes::build(scenes::four_bar(kParallelogram, true, "2*pi*t"));
  const std::string doubt = doubt_of(ideal_motion(*mechanism, mechanism->parameters()), 1e-3);
  EXPECT_NE(doubt.find("known to 1.0e-03"), std::string::npos) << doubt;
  EXPECT_NE(doubt.find("passes a singular pose"), std::string::npos) << doubt;
}

TEST(AFreeMotion, IsLookedAtForSingularPosesToo) {
  MechanismDescription m = scenes::four_bar(kParallelogram, true, "t");
  m.joints[0].driven = false;
  m.motion.drives.clear();
  m.motion.duration = 0.3;
  m.initial_rates.push_back({0, InitialRateDescription::Freedom::angle, 8.0, {}});
  const auto mechanism = scenes::build(m);
  const IdealMotion motion = ideal_motion(*mechanism, mechanism->parameters());
  KinematicReport report = analyse_kinematics(*mechanism);
  EXPECT_TRUE(report.along.empty());
  look_along(*mechanism, motion, report);
  EXPECT_EQ(report.along.size(), 201u);
  ASSERT_EQ(report.passed.size(), 1u);
  EXPECT_NEAR(motion.body(report.passed[0], 0).p.z(), 0.0, 1e-6);  // the crank lies in the line of the ground's pivots
  m.motion.duration = 0.1;
  const auto before = scenes::build(m);
  KinematicReport sound = analyse_kinematics(*before);
  look_along(*before, ideal_motion(*before, before->parameters()), sound);
  EXPECT_TRUE(sound.passed.empty());
  EXPECT_GT(sound.along.back().smallest_singular_value, 1e-3);
}

TEST(AFreeMotion, IsLookedAtWhereJointsCloseLoopsAlone) {
  MechanismDescription m = scenes::four_bar(kParallelogram, true, "t");
  m.joints[0].driven = false;
  m.motion.drives.clear();
  const auto size_of_loops = [](const MechanismDescription& description) {
    const auto mechanism = scenes::build(description);
    ConstraintSystem system(*mechanism, {.clearance = ClearanceRows::closed});
    system.evaluate(home_state(*mechanism).bodies, std::vector<TimeValue>(mechanism->joints()));
    return singular_values_of_loops(*mechanism, system).size();
  };
  const auto loop = size_of_loops(m);
  EXPECT_GT(loop, 0);
  const auto hang_a_chain = [](MechanismDescription& description) {
    for (int k = 0, above = kGround; k < 3; ++k) {
      BodyDescription body;
      body.name = "chain" + std::to_string(k);
      body.mass = 1.0;
      body.inertia = Mat3::Identity();
      if (description.bodies.empty()) body.boresight = Vec3::UnitZ();
      JointDescription joint;
      joint.name = "hinge" + std::to_string(k);
      joint.first = above;
      joint.second = above = static_cast<int>(description.bodies.size());
      joint.axis = Vec3::UnitY();
      joint.point = Vec3(0.0, 0.0, -k);
      description.bodies.push_back(body);
      description.joints.push_back(joint);
    }
  };
  hang_a_chain(m);
  EXPECT_EQ(size_of_loops(m), loop);
  m.bodies.clear();
  m.joints.clear();
  hang_a_chain(m);
  EXPECT_EQ(size_of_loops(m), 0);
}

TEST(ALawWithAKink, IsFollowedThroughItFarFromASingularPose) {
  const auto mechanism = scenes::build(scenes::four_bar(kParallelogram, true, "0.5-abs(t-0.26)"));
  const IdealMotion motion = ideal_motion(*mechanism, mechanism->parameters());
  EXPECT_TRUE(motion.lost().empty());
  EXPECT_LT((motion.body(0.4, 1).R - Mat3::Identity()).norm(), 1e-9);
}

}  // namespace lost_motion_test
}  // namespace boresight
