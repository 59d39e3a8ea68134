// The slider-crank of Flores, Leine and Glocker (2010), whose block has play in its guide, up to where the
// block first touches: until then crank, rod and block fly as a free chain.
//
// Parameters from Siconos' sample of it. The impacts that follow are those of a rectangular guide:
// slider_crank_guide_test.cpp.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "reference/reference.hpp"
#include "scenes.hpp"

namespace boresight {
namespace crank_flight_test {

struct State {
  double q1, q2, u1, u2, y, vy;  // crank and rod [rad], [rad/s]; height of the block [m], [m/s]
};
constexpr State kStart{0.0, 0.0, 150.0, -75.0, 0.0, 0.0};

// The block turns with nothing and stays level. lift: pushes the block up, through its centre [N].
MechanismDescription chain(const State& start, double lift) {
  constexpr double crank = 0.153, rod = 0.306;  // lengths [m]
  const Vec3 along_crank(std::cos(start.q1), std::sin(start.q1), 0.0),
      along_rod(std::cos(start.q2), std::sin(start.q2), 0.0);
  const Vec3 crank_pin = crank * along_crank, block_pin = crank_pin + rod * along_rod;
  MechanismDescription m;
  m.name = "crank, rod and block in flight";
  m.gravity = Vec3(0.0, -9.81, 0.0);
  const struct {
    const char* name;
    double mass, inertia;
    Vec3 from, center;
    double rate;  // relative to the body before it
  } links[] = {{"crank", 0.038, 7.4e-5, Vec3::Zero(), 0.5 * crank_pin, start.u1},
               {"rod", 0.038, 5.9e-4, crank_pin, 0.5 * (crank_pin + block_pin), start.u2 - start.u1},
               {"block", 0.076, 2.7e-6, block_pin, block_pin, -start.u2}};
  for (int k = 0; k < 3; ++k) {
    BodyDescription b;
    b.name = links[k].name;
    b.mass = links[k].mass;
    b.center_of_mass = links[k].center;
    b.inertia = links[k].inertia * Mat3::Identity();
    if (k == 2) b.boresight = Vec3::UnitX();
    m.bodies.push_back(b);
    JointDescription j;
    j.name = std::string("joint ") + links[k].name;
    j.first = k - 1;
    j.second = k;
    j.point = links[k].from;
    m.joints.push_back(j);
    m.initial_rates.push_back({k, InitialRateDescription::Freedom::angle, links[k].rate, {}});
  }
  LoadDescription load;
  load.body = 2;
  load.point = block_pin;
  for (int axis = 0; axis < 3; ++axis) load.force[axis] = std::make_shared<ConstantFunction>(axis == 1 ? lift : 0.0);
  m.loads.push_back(load);
  return m;
}

State after(double t, const State& start = kStart, double lift = 0.0, const std::string& integrator = "",
            double steps = 1000.0) {
  MechanismDescription description = chain(start, lift);
  description.motion.duration = t;
  const auto mechanism = scenes::build(std::move(description));
  RunOptions options;
  options.integrator = integrator;
  options.step = t / steps;
  options.sample_spacing = t;
  options.pose_bodies = {0, 1};
  const RunResult result = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const PoseSample &crank = result.others[0].samples.back(), &rod = result.others[1].samples.back(),
                   &block = result.boresight.samples.back();
  // Nothing turns it: it is the difference of speeds of hundreds of radians a second, which few large steps, by a Jacobian of differences, keep to
  // nine digits.
  EXPECT_NEAR(block.w.z(), 0.0, 1e-9 * std::max(std::abs(start.u1), 1.0));
  const auto turned = [](const PoseSample& s) { return 2.0 * std::atan2(s.pose.q.z(), s.pose.q.w()); };
  return {start.q1 + turned(crank), start.q2 + turned(rod), crank.w.z(), rod.w.z(), block.pose.p.y(), block.v.y()};
}

TEST(SliderCrankWithPlayInItsGuide, FliesAsComputedUntilItsBlockTouches) {
  const auto expect_state = [](const State& s, const reference::Row& r) {
    EXPECT_NEAR(s.q1, r[1], 1e-9) << r[0];
    EXPECT_NEAR(s.q2, r[2], 1e-9) << r[0];
    EXPECT_NEAR(s.u1, r[3], 1e-6) << r[0];
    EXPECT_NEAR(s.u2, r[4], 1e-6) << r[0];
  };
  for (const reference::Row& r : reference::table("slider_crank_flight", "flight")) expect_state(after(r[0]), r);
  // At the first contact: 1 mm of play is used up, and the block rises.
  const reference::Row contact = reference::line("slider_crank_flight", "contact");
  const State s = after(contact[0]);
  expect_state(s, contact);
  EXPECT_NEAR(s.q1 / (2.0 * std::numbers::pi), contact[6], 1e-9);
  EXPECT_NEAR(s.y, 1e-3, 1e-9);
  EXPECT_NEAR(s.vy, contact[5], 1e-7);
}

// The crank turns by 20 degrees here; a Jacobian kept for the whole of it would make the method one of the second order.
TEST(SliderCrankWithPlayInItsGuide, RosenbrockKeepsItsOrderOnAFastCrank) {
  const reference::Row contact = reference::line("slider_crank_flight", "contact");
  const double t = contact[0], q1 = contact[1];
  const auto error = [&](double steps) { return std::abs(after(t, kStart, 0.0, "rosenbrock", steps).q1 - q1); };
  // Steps that move the crank by more than the share for which a Jacobian is kept.
  const double coarse = error(5.0), fine = error(20.0);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, std::pow(4.0, 3.5));
  // Shorter ones share a Jacobian that is off by up to a hundredth: their errors are no longer those of the order, and small.
  EXPECT_LT(error(80.0), 1e-5);
}

// Both upper corners strike the guide at once, e = 0.4, without friction: the impulse reverses the block's rise. Here it is a
// force over a nanosecond, from which the change without it is taken off.
TEST(SliderCrankWithPlayInItsGuide, LeavesItsFirstImpactAsComputed) {
  const reference::Row contact = reference::line("slider_crank_flight", "contact"),
                       after_it = reference::line("slider_crank_flight", "impulse");
  const State before{contact[1], contact[2], contact[3], contact[4], 1e-3, contact[5]};
  constexpr double kMoment = 1e-9, kUnit = 1e-3;  // [s], [N s]
  const State free = after(kMoment, before);
  const double gained = after(kMoment, before, -kUnit / kMoment).vy - free.vy;
  const double impulse = -(1.0 + 0.4) * before.vy / gained * kUnit;
  EXPECT_NEAR(impulse, after_it[0], 1e-8);
  const State rebound = after(kMoment, before, -impulse / kMoment);
  EXPECT_NEAR(rebound.vy - free.vy, -1.4 * before.vy, 1e-8);
  EXPECT_NEAR(rebound.u1 - free.u1, after_it[1] - before.u1, 1e-6);
  EXPECT_NEAR(rebound.u2 - free.u2, after_it[2] - before.u2, 1e-6);
}

// A gap is a gap, also where the integrator leaves contacts out that are far away.
TEST(CrankFlight, ShowsTheGapOfAContactThatIsOpen) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.02 s"}}));
  RunOptions options;
  options.integrator = "rosenbrock";
  const RunResult result = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  ASSERT_FALSE(result.clearances.empty());
  const double clearance = mechanism->parameters().clearance[0].radial;
  for (const ClearanceSample& sample : result.clearances[0]) EXPECT_GT(sample.penetration, -2.0 * clearance);
}

}  // namespace crank_flight_test
}  // namespace boresight
