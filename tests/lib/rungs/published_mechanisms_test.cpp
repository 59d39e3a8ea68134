// The mechanisms of the multibody benchmarks, as their example files describe them, against published and
// recomputed numbers.
//
// IFToMM multibody benchmark library: A01 simple pendulum, A02 double four-bar, A04 Bricard (A03, Andrews'
// squeezer, is in andrews_squeezer_test.cpp). Where the library prints no numbers to compare with, they come
// from exact solutions or were computed with two formulations of their own in extended precision.
#include <gtest/gtest.h>

#include "boresight/mechanism/kinematic_report.hpp"
#include "published_examples.hpp"

namespace boresight {
namespace {

using scenes::carried;
using scenes::example;
using scenes::follow;
using scenes::sample;

TEST(Pendulum, SwingsAsTheEllipticFunctionSays) {
  const auto mechanism = example("pendulum");
  const RunResult result = follow(mechanism, 1e-3, 0.01);
  // sin(theta / 2) = -sin(pi / 4) cd(w0 t | 1/2), w0 = sqrt(9.81): t, x, y, vx, vy.
  const double reference[][5] = {{0.1, -0.9987974827499, -0.04902640566556, 0.0480833351124, -0.979584642613},
                                 {0.5, -0.3910487915505, -0.9203699487852, 3.91104800396, -1.66173460755},
                                 {1, 0.9862917511319, -0.1650108531255, 0.296905515916, 1.77464364111},
                                 {2, -0.7935661953433, -0.6084839304438, -2.10243787444, 2.74193539301},
                                 {3, 0.1766517899228, -0.9842734097379, 4.32536867454, 0.776292553343},
                                 {5, -0.9423054350438, -0.334754338414, 0.857904256886, -2.41492865437},
                                 {7, -0.9986187791755, -0.0525407829983, -0.0533450728427, 1.01390555065},
                                 {9.99, -0.316436469913, -0.9486137045758, 4.09245199149, -1.36515112024},
                                 {10, -0.2750874625761, -0.9614192050991, 4.17559810095, -1.19474905456}};
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
  const double period = 2.36784194757623745;  // 4 K(1/2) / w0
  const auto mechanism = example("pendulum", {{"motion.duration", "2.36784194757623745 s"}});
  const PoseSample s = sample(follow(mechanism, period / 2000, period / 20), 0, period);
  EXPECT_NEAR((s.pose.p - Vec3(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(s.v.norm(), 0.0, 1e-8);
}

// Cranks of the correct branch turn alike: 3 phi'' = 3.5 g sin phi, phi(0) = 0, phi'(0) = 1. The first
// singular position is passed at 0.714356 s; EXUDYN's Richardson limit at 10 s agrees with this to 1e-8.
struct Crank {
  double t, phi, rate, x, y, vx,
      vy;  // angle from the upright, B0 (the end of the first crank) and its velocity
};
void expect_double_four_bar(double duration, const std::vector<Crank>& reference) {
  const auto mechanism = example("double-four-bar", {{"motion.duration", std::to_string(duration) + " s"}});
  const RunResult result = follow(mechanism, 5e-4, 0.1);
  for (const Crank& r : reference) {
    const PoseSample& s = sample(result, 0, r.t);
    EXPECT_NEAR(2.0 * s.pose.p.x(), r.x, 1e-6) << r.t;
    EXPECT_NEAR(2.0 * s.pose.p.y(), r.y, 1e-6) << r.t;
    EXPECT_NEAR(2.0 * s.v.x(), r.vx, 1e-5) << r.t;
    EXPECT_NEAR(2.0 * s.v.y(), r.vy, 1e-5) << r.t;
    EXPECT_NEAR(-s.w.z(), r.rate, 1e-5) << r.t;
    const double turned = -2.0 * std::atan2(s.pose.q.z(), s.pose.q.w());
    EXPECT_NEAR(std::remainder(turned - r.phi, 2.0 * std::numbers::pi), 0.0, 1e-6) << r.t;
    // The right-hand crank turns with it: no loop has folded.
    EXPECT_NEAR(sample(result, 4, r.t).pose.p.x() - 2.0, s.pose.p.x(), 1e-6) << r.t;
  }
}

TEST(DoubleFourBar, PassesItsSingularPositionOnTheRightBranch) {
  expect_double_four_bar(
      1.0,
      {{0.5, 0.768818627555, 2.72730849428, 0.695286633164, 0.718732563436, 1.9602054254, -1.8962611406},
       {1.0, 3.33787080311, 6.80738524087, -0.195020301949, -0.980799205662, -6.6766780369, 1.3275783252}});
}

TEST(DoubleFourBar, PassesTenSingularPositionsOnTheRightBranch) {
  expect_double_four_bar(
      10.0,
      {{2.0, 6.34103336131, 1.01896459144, 0.057815795768, 0.998327267863, 1.0172601366, -0.0589122487},
       {3.0, 10.0063518288, 6.55872421506, -0.549339739302, -0.83559909695, -5.4804640312, 3.6029678505},
       {4.0, 12.6842595935, 1.07651118009, 0.117616102377, 0.993059138451, 1.069039265, -0.1266150492},
       {5.0, 16.6543534867, 6.10506755352, -0.811310461005, -0.584615545349, -3.5691173972, 4.9531051713},
       {8.0, 25.3865121816, 1.31647540834, 0.251055914628, 0.967972586249, 1.2743121057, -0.3305089377},
       {10.0, 31.750597187, 1.50664218084, 0.328458111541, 0.944518538179, 1.4230514702, -0.49486884549}});
}

TEST(DoubleFourBar, IsLevelAndUprightAgainWhenItsQuadratureSays) {
  const double revolution = 1.942514922607084, level = 0.71435552929296;
  const PoseSample upright =
      sample(follow(example("double-four-bar", {{"motion.duration", "1.942514922607084 s"}}),
                    revolution / 4000, revolution / 20),
             0, revolution);
  EXPECT_NEAR(upright.pose.p.x(), 0.0, 1e-6);
  EXPECT_NEAR(upright.w.z(), -1.0, 1e-5);
  const PoseSample across =
      sample(follow(example("double-four-bar", {{"motion.duration", "0.71435552929296 s"}}), level / 1500,
                    level / 20),
             0, level);
  EXPECT_NEAR(across.pose.p.y(), 0.0, 1e-6);
  const auto mechanism = example("double-four-bar", {{"motion.duration", "2 s"}});
  double fastest = 0.0;
  for (const PoseSample& s : follow(mechanism, 5e-4, 5e-4).boresight.samples)
    fastest = std::max(fastest, -s.w.z());
  EXPECT_NEAR(fastest, 6.8395906310246, 1e-5);
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
  // The far end of bar 2, and what bar 1 has turned: DOP853 with projection on a 5-angle chain, energy kept
  // to 1.4e-13 J.
  const double reference[][5] = {{0.1, 0.9902415380, -0.9999528486, -0.0097108483, 0.0098062307},
                                 {0.2, 0.9613495506, -0.9992814034, -0.0379035208, 0.0394069967},
                                 {0.5, 0.7747178080, -0.9798150477, -0.1999061590, 0.2525288405},
                                 {0.8, 0.4889996848, -0.9248057469, -0.3804396542, 0.6611789395},
                                 {1.0, 0.2744813193, -0.8867079387, -0.4623300027, 1.0350284595},
                                 {1.5, -0.2790175754, -0.8873613788, -0.4610745963, 2.1149912646},
                                 {2.0, -0.7781353730, -0.9803526834, -0.1972526706, 2.8933282060},
                                 {3.0, -0.7712813590, -0.9792693298, -0.2025625327, 2.8847616045},
                                 {4.0, 0.2835510791, -0.8880228141, -0.4597993928, 1.0181991818},
                                 {5.0, 0.9999327423, -0.9999999977, -0.0000672554, 0.0000672600},
                                 {8.0, -0.7643526022, -0.9781537944, -0.2078825497, 2.8760436704},
                                 {10.0, 0.9997309873, -0.9999999638, -0.0002689765, 0.0002690489}};
  for (const auto& r : reference) {
    const Vec3 P = carried(*mechanism, 1, Vec3(1.0, -1.0, 0.0), sample(result, 1, r[0]));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(P[k], r[k + 1], 1e-8) << r[0];
    const Quat q = sample(result, 0, r[0]).pose.q;
    EXPECT_NEAR(std::abs(2.0 * std::atan2(q.y(), q.w())), r[4], 1e-7) << r[0];
    EXPECT_NEAR(energy(*mechanism, result, r[0]), -29.43, 1e-9) << r[0];
  }
  // The corner between bars 3 and 4.
  for (const auto& [t, x, y, z] : {std::tuple{1.0, 0.5105014612, -1.6491675994, 0.1401231146},
                                   std::tuple{2.0, -0.9693403448, -1.2212468950, 0.7542780108}})
    EXPECT_NEAR((carried(*mechanism, 2, Vec3(1.0, -1.0, 1.0), sample(result, 2, t)) - Vec3(x, y, z)).norm(),
                0.0, 1e-8)
        << t;
  // How fast the far end of bar 2 moves after 1 s.
  const PoseSample& bar2 = sample(result, 1, 1.0);
  const Vec3 arm = carried(*mechanism, 1, Vec3(1.0, -1.0, 0.0), bar2) - bar2.pose.p;
  EXPECT_NEAR((bar2.v + bar2.w.cross(arm) - Vec3(-1.09491945, 0.15669908, -0.30053494)).norm(), 0.0, 1e-7);
  // At first the hinges y z x y z accelerate by 1.958 rad/s^2 with alternating signs.
  const Vec3 hinge[] = {Vec3::UnitY(), -Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ()};
  Vec3 sum = Vec3::Zero();
  for (int b = 0; b < 5; ++b) {
    sum += 1.95808383 * hinge[b];
    EXPECT_NEAR((sample(result, b, 0.0).alpha - sum).norm(), 0.0, 1e-7) << "bar " << b + 1;
  }
  // It is back, at rest, after 4.9917 s.
  double back = 0.0;
  for (double t = 4.9; t < 5.05; t += 0.01) {
    const double now = sample(result, 1, t).v.x(), next = sample(result, 1, t + 0.01).v.x();
    if (now > 0.0 && next <= 0.0) back = t + 0.01 * now / (now - next);
  }
  EXPECT_NEAR(back, 4.9917, 5e-5);
}

}  // namespace
}  // namespace boresight
