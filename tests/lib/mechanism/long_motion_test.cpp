// Motions of microseconds and of months: as dense as what moves asks for, whatever share of the duration that is, and refused in words
// where they cannot be held.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "boresight/keys/units.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "boresight/mechanism/motion_density.hpp"
#include "scenes.hpp"

namespace boresight {
namespace long_motion_test {

Mechanism four_bar(const std::string& law, const std::string& duration) {
  return Mechanism(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml",
                                  {{"motion.drives.A", law}, {"motion.duration", duration}}));
}

// The ideal motion against the same instant solved on its own.
double miss_at(const Mechanism& mechanism, const IdealMotion& motion, double t) {
  IdealState exact;
  motion.state(t, exact);
  IdealState table = exact;
  IdealSolver solver(mechanism);
  EXPECT_TRUE(solver.solve(t, exact));
  double worst = 0.0;
  for (int b = 0; b < mechanism.bodies(); ++b) {
    worst = std::max(worst, (table.bodies[b].p - exact.bodies[b].p).norm() / mechanism.characteristic_length());
    worst = std::max(worst, (table.bodies[b].R - exact.bodies[b].R).norm());
  }
  return worst;
}

TEST(LongMotion, OfMonthsIsFollowedWhereItIsSlow) {
  const Mechanism mechanism = four_bar("2*pi*t/1e6", "1e6 s");
  const IdealMotion motion = IdealMotion::kinematic(mechanism);
  EXPECT_LT(motion.knots(), 5000);
  for (const double t : {1.0, 123456.7, 999999.0}) EXPECT_LT(miss_at(mechanism, motion, t), 1e-11) << t;
}

TEST(LongMotion, OfHundredsOfTurnsIsFollowed) {
  const Mechanism mechanism = four_bar("2*pi*t", "200 s");
  const IdealMotion motion = IdealMotion::kinematic(mechanism);
  for (const double t : {0.37, 100.123, 199.9}) EXPECT_LT(miss_at(mechanism, motion, t), 1e-8) << t;
}

TEST(LongMotion, ThatMemoryCannotHoldIsRefusedWithWhatItWouldTake) {
  for (const char* duration : {"1e6 s", "1e8 s"}) {
    const Mechanism mechanism = four_bar("2*pi*t", duration);
    try {
      IdealMotion::kinematic(mechanism);
      ADD_FAILURE() << duration;
    } catch (const MotionTooDense& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("GB of memory; shorten motion.duration"), std::string::npos)
          << refusal.what();
    }
    const KinematicReport report = analyse_kinematics(mechanism);
    EXPECT_FALSE(report.feasible);
    ASSERT_FALSE(report.findings.empty());
    EXPECT_NE(report.findings.front().find("GB of memory"), std::string::npos) << report.findings.front();
  }
}

// A slew of a second in a quarter of an hour at rest: between two states of a coarse table nothing seems to move.
TEST(LongMotion, SlewBetweenLongRestsIsNotMissed) {
  const Mechanism mechanism = four_bar("0.4*(1 + tanh((t - 503.2)/0.5))", "1000 s");
  const IdealMotion motion = IdealMotion::kinematic(mechanism);
  for (const double t : {10.0, 502.0, 503.1, 503.6, 505.0, 900.0}) EXPECT_LT(miss_at(mechanism, motion, t), 1e-7) << t;
}

TEST(LongMotion, OfAMicrosecondIsFollowed) {
  const Mechanism mechanism = four_bar("1e5*t", "1 us");
  const IdealMotion motion = IdealMotion::kinematic(mechanism);
  for (const double t : {0.0, 0.4e-6, 1e-6}) EXPECT_LT(miss_at(mechanism, motion, t), 1e-11) << t;
}

// Nothing beyond the acceleration is asked of a law.
TEST(LongMotion, LawWhoseAccelerationHasACornerIsStillFollowed) {
  const Mechanism mechanism = four_bar("0.5*abs(t - 0.5)^3", "1 s");
  const IdealMotion motion = IdealMotion::kinematic(mechanism);
  for (const double t : {0.1, 0.4, 0.9}) EXPECT_LT(miss_at(mechanism, motion, t), 1e-10) << t;
}

TEST(LongMotion, LawWhoseRateJumpsIsRefusedWithItsTime) {
  for (const char* law : {"0.5*abs(t - 0.4321)", "0.1*asin(sin(3*(t-0.4321)+0.5*pi))", "0.5*sqrt(abs(t - 0.4321))"}) {
    SCOPED_TRACE(law);
    try {
      four_bar(law, "1 s");
      ADD_FAILURE() << "an impulse was taken for a motion";
    } catch (const InputError& refusal) {
      EXPECT_THAT(refusal.what(), testing::HasSubstr("motion.drives.A: found"));
      EXPECT_THAT(refusal.what(), testing::HasSubstr("jumps or has a corner at t = 0.432100 s"));
    }
  }
}

TEST(LongMotion, ThatJumpsForAMomentIsTabledThere) {
  const Mechanism mechanism = four_bar("0.1*tanh(1e5*(t-0.0512345))", "0.2 s");
  const IdealMotion motion = IdealMotion::kinematic(mechanism);
  for (const double t : {0.05, 0.0512345, 0.05124, 0.06}) EXPECT_LT(miss_at(mechanism, motion, t), 1e-6) << t;
}

TEST(LongMotion, ThatLeavesWhatTheMechanismReachesIsSaidToWhere) {
  // The driven bar is longer than the others let it turn: it reaches a dead point.
  for (const char* duration : {"1 s", "1000 s"}) {
    const double T = parse_quantity(duration, kDuration);
    MechanismDescription driven = scenes::four_bar(
        {Vec3(0, 0, 0), Vec3(0.3, 0, 0.1), Vec3(0.4, 0, 0.3), Vec3(0.5, 0, 0)}, false, "2*pi*t/" + std::to_string(T));
    driven.motion.duration = T;
    try {
      IdealMotion::kinematic(Mechanism(driven));
      ADD_FAILURE() << "a bar longer than the frame turned round";
    } catch (const ComputationError& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("cannot be followed beyond t = "), std::string::npos)
          << refusal.what();
      EXPECT_EQ(std::string(refusal.what()).find("beyond t = 0 s"), std::string::npos) << refusal.what();
    }
  }
}

std::atomic<int> looks{0};

TEST(LongWork, StopsWhereItsWatchWantsItTo) {
  const Mechanism mechanism = four_bar("2*pi*t", "2000 s");
  looks = 0;
  watch_work([](const char*, double share) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0 + 1e-12);
    return ++looks < 1000;
  });
  EXPECT_THROW(IdealMotion::kinematic(mechanism), Interrupted);
  EXPECT_EQ(looks, 1000);
  watch_work(nullptr);
}

// Whoever is answered in one thread is not stopped by what stops another.
TEST(LongWork, StopsWhereItsOwnThreadIsTold) {
  const Mechanism mechanism = four_bar("2*pi*t", "20 s");
  std::atomic<bool> stop{false}, other{true};
  {
    const StopOfThread heard(other);
    EXPECT_THROW(IdealMotion::kinematic(mechanism), Interrupted);
    const StopOfThread inner(stop);  // adds to it
    EXPECT_THROW(IdealMotion::kinematic(mechanism), Interrupted);
    std::jthread([&] { EXPECT_NO_THROW(IdealMotion::kinematic(mechanism)); }).join();
  }
  const StopOfThread heard(stop);
  EXPECT_NO_THROW(IdealMotion::kinematic(mechanism));
  stop = true;
  EXPECT_THROW(IdealMotion::kinematic(mechanism), Interrupted);
}

// Beyond 16,384 rad an angle is known to 4e-12: what closes the mechanism is the turn that it is in.
TEST(LongMotion, OfThousandsOfTurnsIsFollowed) {
  const Mechanism mechanism = four_bar("2*pi*t", "2700 s");
  const IdealMotion motion = IdealMotion::kinematic(mechanism);
  for (const double t : {1.23, 2610.37, 2699.9}) EXPECT_LT(miss_at(mechanism, motion, t), 1e-8) << t;
}

}  // namespace long_motion_test
}  // namespace boresight
