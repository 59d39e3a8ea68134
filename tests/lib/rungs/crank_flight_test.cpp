// The slider-crank of Flores, Leine and Glocker (2010), whose block has play in its guide, up to where the
// block first touches: until then crank, rod and block fly as a free chain.
//
// Parameters from Siconos' sample of it. The impacts themselves are between a block's corners and two flat
// guides with constant restitution, which no joint with clearance here has.
#include <gtest/gtest.h>

#include "boresight/rungs/rung.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

MechanismDescription chain(double duration) {
  MechanismDescription m;
  m.name = "crank, rod and block before the first contact";
  m.gravity = Vec3(0.0, -9.81, 0.0);
  const struct {
    const char* name;
    double mass, inertia, from, center;
    double rate;  // relative to the body before it: 150, -75 and 0 rad/s in all
  } links[] = {{"crank", 0.038, 7.4e-5, 0.0, 0.0765, 150.0},
               {"rod", 0.038, 5.9e-4, 0.153, 0.306, -225.0},
               {"block", 0.076, 2.7e-6, 0.459, 0.459, 75.0}};
  for (int k = 0; k < 3; ++k) {
    BodyDescription b;
    b.name = links[k].name;
    b.mass = links[k].mass;
    b.center_of_mass = Vec3(links[k].center, 0.0, 0.0);
    b.inertia = links[k].inertia * Mat3::Identity();
    if (k == 2) b.boresight = Vec3::UnitX();
    m.bodies.push_back(b);
    JointDescription j;
    j.name = std::string("joint ") + links[k].name;
    j.first = k - 1;
    j.second = k;
    j.point = Vec3(links[k].from, 0.0, 0.0);
    m.joints.push_back(j);
    m.initial_rates.push_back({k, InitialRateDescription::Freedom::angle, links[k].rate, {}});
  }
  m.motion.duration = duration;
  return m;
}

struct State {
  double q1, q2, u1, u2, y, vy;  // crank and rod [rad], [rad/s]; height of the block [m], [m/s]
};
State after(double t) {
  const auto mechanism = scenes::build(chain(t));
  RunOptions options;
  options.step = t / 1000;
  options.sample_spacing = t;
  options.pose_bodies = {0, 1};
  const RunResult result = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const PoseSample &crank = result.others[0].samples.back(), &rod = result.others[1].samples.back(),
                   &block = result.boresight.samples.back();
  EXPECT_NEAR(block.w.z(), 0.0, 1e-8);  // nothing turns it
  const auto angle = [](const PoseSample& s) { return 2.0 * std::atan2(s.pose.q.z(), s.pose.q.w()); };
  return {angle(crank), angle(rod), crank.w.z(), rod.w.z(), block.pose.p.y(), block.v.y()};
}

TEST(SliderCrankWithPlayInItsGuide, FliesAsComputedUntilItsBlockTouches) {
  State s = after(1e-3);
  EXPECT_NEAR(s.q1, .146090844, 1e-9);
  EXPECT_NEAR(s.q2, -.0725963954, 1e-9);
  EXPECT_NEAR(s.u1, 139.115876, 1e-6);
  EXPECT_NEAR(s.u2, -68.2762942, 1e-6);
  s = after(2e-3);
  EXPECT_NEAR(s.q1, .27579441, 1e-8);
  EXPECT_NEAR(s.q2, -.13494926, 1e-8);
  // At the first contact: 1 mm of play is used up, and the block rises.
  s = after(.002692502752);
  EXPECT_NEAR(s.q1, .355304455028, 1e-9);
  EXPECT_NEAR(s.q1 / (2.0 * std::numbers::pi), 0.056548460, 1e-9);
  EXPECT_NEAR(s.q2, -.171509540940, 1e-9);
  EXPECT_NEAR(s.u1, 109.557681543, 1e-6);
  EXPECT_NEAR(s.u2, -49.330789962, 1e-6);
  EXPECT_NEAR(s.y, 1e-3, 1e-9);
  EXPECT_NEAR(s.vy, .841612322, 1e-7);
}

}  // namespace
}  // namespace boresight
