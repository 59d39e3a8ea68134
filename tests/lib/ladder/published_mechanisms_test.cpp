// The mechanisms of the multibody benchmarks, as their example files describe them, against published and
// recomputed numbers.
//
// IFToMM multibody benchmark library: A01 simple pendulum, A02 double four-bar, A04 Bricard (A03, Andrews'
// squeezer, is in andrews_squeezer_test.cpp). The library prints no numbers to compare with: they come from exact solutions and from
// equations of motion of their own, tests/reference.
#include <gtest/gtest.h>

#include <cstdio>

#include "boresight/mechanism/kinematic_report.hpp"
#include "published_examples.hpp"
#include "reference/reference.hpp"

namespace boresight {
namespace published_mechanisms_test {

using scenes::carried;
using scenes::example;
using scenes::follow;
using scenes::sample;

std::string seconds(double t) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g s", t);
  return text;
}

TEST(Pendulum, SwingsAsTheEllipticFunctionSays) {
  const auto mechanism = example("pendulum");
  const RunResult result = follow(mechanism, 1e-3, 0.01);
  // sin(theta / 2) = -sin(pi / 4) cd(w0 t | 1/2), w0 = sqrt(9.81): t, x, y, vx, vy.
  const auto reference = reference::table("pendulum", "swing");
  for (const auto& r : reference) {
    const PoseSample& s = sample(result, 0, r[0]);
    EXPECT_NEAR(s.pose.p.x(), r[1], 1e-9) << r[0];
    EXPECT_NEAR(s.pose.p.y(), r[2], 1e-9) << r[0];
    EXPECT_NEAR(s.v.x(), r[3], 1e-8) << r[0];
    EXPECT_NEAR(s.v.y(), r[4], 1e-8) << r[0];
    // Tension of the rod: 3 m g sin(depression), along it.
    const Vec3 rod_force = s.a - mechanism->description().gravity;
    EXPECT_NEAR(-rod_force.dot(s.pose.p), -3.0 * 9.81 * r[2], 1e-7) << r[0];
    EXPECT_NEAR(rod_force.cross(s.pose.p).norm(), 0.0, 1e-7) << r[0];
  }
}

TEST(Pendulum, ReturnsAfterThePeriodOfTheEllipticIntegral) {
  const double period = reference::line("pendulum", "period")[0];  // 4 K(1/2) / w0
  const auto mechanism = example("pendulum", {{"motion.duration", seconds(period)}});
  const PoseSample s = sample(follow(mechanism, period / 2000, period / 20), 0, period);
  EXPECT_NEAR((s.pose.p - Vec3(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(s.v.norm(), 0.0, 1e-8);
}

// Cranks of the correct branch turn alike: 3 phi'' = 3.5 g sin phi, phi(0) = 0, phi'(0) = 1. The first
// singular position is passed at 0.714356 s; EXUDYN's Richardson limit at 10 s agrees with this to 1e-8.
// Rows: t, angle from the upright and its rate, the end of the first crank and its velocity.
void expect_double_four_bar(double duration, double from, double to) {
  const auto mechanism = example("double-four-bar", {{"motion.duration", std::to_string(duration) + " s"}});
  const RunResult result = follow(mechanism, 5e-4, 0.1);
  int held = 0;
  for (const auto& r : reference::table("double_four_bar", "crank")) {
    if (r[0] < from || r[0] > to) continue;
    ++held;
    const PoseSample& s = sample(result, 0, r[0]);
    EXPECT_NEAR(2.0 * s.pose.p.x(), r[3], 1e-6) << r[0];
    EXPECT_NEAR(2.0 * s.pose.p.y(), r[4], 1e-6) << r[0];
    EXPECT_NEAR(2.0 * s.v.x(), r[5], 1e-5) << r[0];
    EXPECT_NEAR(2.0 * s.v.y(), r[6], 1e-5) << r[0];
    EXPECT_NEAR(-s.w.z(), r[2], 1e-5) << r[0];
    const double turned = -2.0 * std::atan2(s.pose.q.z(), s.pose.q.w());
    EXPECT_NEAR(std::remainder(turned - r[1], 2.0 * std::numbers::pi), 0.0, 1e-6) << r[0];
    // The right-hand crank turns with it: no loop has folded.
    EXPECT_NEAR(sample(result, 4, r[0]).pose.p.x() - 2.0, s.pose.p.x(), 1e-6) << r[0];
  }
  EXPECT_GE(held, 2);
}

TEST(DoubleFourBar, PassesItsSingularPositionOnTheRightBranch) { expect_double_four_bar(1.0, 0.0, 1.0); }

TEST(DoubleFourBar, PassesTenSingularPositionsOnTheRightBranch) { expect_double_four_bar(10.0, 2.0, 10.0); }

TEST(DoubleFourBar, IsLevelAndUprightAgainWhenItsQuadratureSays) {
  const auto times = reference::line("double_four_bar", "times");
  const double level = times[0], revolution = times[1];
  const PoseSample upright = sample(follow(example("double-four-bar", {{"motion.duration", seconds(revolution)}}),
                                           revolution / 4000, revolution / 20),
                                    0, revolution);
  EXPECT_NEAR(upright.pose.p.x(), 0.0, 1e-6);
  EXPECT_NEAR(upright.w.z(), -1.0, 1e-5);
  const PoseSample across = sample(
      follow(example("double-four-bar", {{"motion.duration", seconds(level)}}), level / 1500, level / 20), 0, level);
  EXPECT_NEAR(across.pose.p.y(), 0.0, 1e-6);
  const auto mechanism = example("double-four-bar", {{"motion.duration", "2 s"}});
  double fastest = 0.0;
  for (const PoseSample& s : follow(mechanism, 5e-4, 5e-4).boresight.samples) fastest = std::max(fastest, -s.w.z());
  EXPECT_NEAR(fastest, times[2], 1e-5);
}

double energy(const Mechanism& mechanism, const RunResult& result, double t) {
  double sum = 0.0;
  const MechanismDescription& m = mechanism.description();
  for (int b = 0; b < mechanism.bodies(); ++b) {
    const PoseSample& s = sample(result, b, t);
    const Vec3 w = s.pose.q.toRotationMatrix().transpose() * s.w;
    sum += 0.5 * m.bodies[b].mass * s.v.squaredNorm() + 0.5 * w.dot(m.bodies[b].inertia * w) -
           m.bodies[b].mass * m.gravity.dot(s.pose.p);
  }
  return sum;
}

TEST(Bricard, MovesAsItsExactMotionAlthoughOneConstraintIsRedundant) {
  const auto mechanism = example("bricard");
  const KinematicReport kinematics = analyse_kinematics(*mechanism);
  EXPECT_EQ(kinematics.mobility, 1);
  EXPECT_EQ(kinematics.redundant_rows, 1);
  const RunResult result = follow(mechanism, 5e-4, 0.01);
  // The far end of bar 2, and what bar 1 has turned.
  const auto reference = reference::table("bricard", "far end of bar 2");
  for (const auto& r : reference) {
    const Vec3 P = carried(*mechanism, 1, Vec3(1.0, -1.0, 0.0), sample(result, 1, r[0]));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(P[k], r[k + 1], 1e-8) << r[0];
    const Quat q = sample(result, 0, r[0]).pose.q;
    EXPECT_NEAR(std::abs(2.0 * std::atan2(q.y(), q.w())), r[4], 1e-7) << r[0];
    EXPECT_NEAR(energy(*mechanism, result, r[0]), -29.43, 1e-9) << r[0];
  }
  // The corner between bars 3 and 4.
  for (const auto& r : reference::table("bricard", "corner between bars 3 and 4"))
    EXPECT_NEAR((carried(*mechanism, 2, Vec3(1.0, -1.0, 1.0), sample(result, 2, r[0])) - Vec3(r[1], r[2], r[3])).norm(),
                0.0, 1e-8)
        << r[0];
  // How fast the far end of bar 2 moves after 1 s.
  const PoseSample& bar2 = sample(result, 1, 1.0);
  const Vec3 arm = carried(*mechanism, 1, Vec3(1.0, -1.0, 0.0), bar2) - bar2.pose.p;
  const auto velocity = reference::line("bricard", "velocity of the far end after 1 s");
  EXPECT_NEAR((bar2.v + bar2.w.cross(arm) - Vec3(velocity[0], velocity[1], velocity[2])).norm(), 0.0, 1e-7);
  // At first the hinges y z x y z accelerate by 1.958 rad/s^2 with alternating signs.
  const double first = reference::line("bricard", "acceleration of the first hinge")[0];
  const Vec3 hinge[] = {Vec3::UnitY(), -Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ()};
  Vec3 sum = Vec3::Zero();
  for (int b = 0; b < 5; ++b) {
    sum += first * hinge[b];
    EXPECT_NEAR((sample(result, b, 0.0).alpha - sum).norm(), 0.0, 1e-7) << "bar " << b + 1;
  }
  // It is back, at rest, after 4.9917 s.
  double back = 0.0;
  for (double t = 4.9; t < 5.05; t += 0.01) {
    const double now = sample(result, 1, t).v.x(), next = sample(result, 1, t + 0.01).v.x();
    if (now > 0.0 && next <= 0.0) back = t + 0.01 * now / (now - next);
  }
  EXPECT_NEAR(back, reference::line("bricard", "period")[0], 5e-5);
}

}  // namespace published_mechanisms_test
}  // namespace boresight
