// The mechanisms of the multibody benchmarks, as their example files describe them, against published and
// recomputed numbers.
//
// IFToMM multibody benchmark library: A01 simple pendulum, A02 double four-bar, A03 Andrews' squeezer, A04
// Bricard. Where the library prints no numbers to compare with, they come from exact solutions or were
// computed with two formulations of their own in extended precision.
#include <gtest/gtest.h>

#include "boresight/mechanism/kinematic_report.hpp"
#include "boresight/rungs/ideal_simulation.hpp"
#include "boresight/rungs/rung.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

std::shared_ptr<const Mechanism> example(const std::string& name, const std::vector<Setting>& settings = {}) {
  return scenes::build(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + name + "/" + name + ".toml", settings));
}

RunResult follow(const std::shared_ptr<const Mechanism>& mechanism, double step, double sample) {
  RunOptions options;
  options.step = step;
  options.sample_spacing = sample;
  for (int b = 0; b < mechanism->bodies(); ++b) options.pose_bodies.push_back(b);
  return make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
}

const PoseSample& sample(const RunResult& result, int body, double t) {
  const double spacing = result.time[1] - result.time[0];
  const std::size_t k = static_cast<std::size_t>(std::lround(t / spacing));
  EXPECT_NEAR(result.time[k], t, 1e-9);
  for (const BodyHistory& history : result.others)
    if (history.body == body) return history.samples[k];
  throw std::out_of_range("no such body");
}

// A point given at home in world coordinates, carried by a body.
Vec3 carried(const Mechanism& mechanism, int body, const Vec3& at_home, const PoseSample& now) {
  const BodyDescription& b = mechanism.description().bodies[body];
  return now.pose.p + now.pose.q.toRotationMatrix() * b.axes.transpose() * (at_home - b.center_of_mass);
}

TEST(Pendulum, SwingsAsTheEllipticFunctionSays) {
  const auto mechanism = example("pendulum");
  const RunResult result = follow(mechanism, 1e-3, 0.01);
  // sin(theta / 2) = -sin(pi / 4) cd(w0 t | 1/2), w0 = sqrt(9.81): t, x, y, vx, vy.
  const double reference[][5] = {{0.1, -0.9987974827499, -0.04902640566556, 0.0480833351124, -0.979584642613},
                                 {0.5, -0.3910487915505, -0.9203699487852, 3.91104800396, -1.66173460755},
                                 {1, 0.9862917511319, -0.1650108531255, 0.296905515916, 1.77464364111},
                                 {3, 0.1766517899228, -0.9842734097379, 4.32536867454, 0.776292553343},
                                 {5, -0.9423054350438, -0.334754338414, 0.857904256886, -2.41492865437},
                                 {10, -0.2750874625761, -0.9614192050991, 4.17559810095, -1.19474905456}};
  for (const auto& r : reference) {
    const PoseSample& s = sample(result, 0, r[0]);
    EXPECT_NEAR(s.pose.p.x(), r[1], 1e-9) << r[0];
    EXPECT_NEAR(s.pose.p.y(), r[2], 1e-9) << r[0];
    EXPECT_NEAR(s.v.x(), r[3], 1e-8) << r[0];
    EXPECT_NEAR(s.v.y(), r[4], 1e-8) << r[0];
  }
}

// Angles of the seven bodies at 0.03 s from the Test Set for IVP Solvers (Bari): PSIDE with tolerance 1e-14.
TEST(AndrewsSqueezer, IsWhereTheBariTestSetPutsIt) {
  const auto mechanism = example("andrews-squeezer", {{"motion.duration", "0.03 s"}});
  const double start[] = {-0.0617138900142764496, 0.0,
                          0.455279819163070380,   0.222668390165885885,
                          0.487364979543842550,   -0.222668390165885885,
                          1.23054744454982119};
  const double end[] = {15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                        0.5244099658805304, 0.5347301163226948, 1.048080741042263};
  const auto turned =
      [&](int body) {  // beta; beta + theta; gamma; phi + delta; delta; Omega + epsilon; epsilon
        const auto sum = [&](const double* q) {
          const double angle[] = {q[0], q[0] + q[1], q[2], q[3] + q[4], q[4], q[5] + q[6], q[6]};
          return angle[body];
        };
        return sum(end) - sum(start);
      };
  const auto difference = [](double a, double b) { return std::remainder(a - b, 2.0 * std::numbers::pi); };
  const RunResult result = follow(mechanism, 1e-5, 1e-3);
  const double rate[] = {1139.920302151208,  -1424.379294994111, 11.03291221937134, 19.29337464421385,
                         0.5735699284790808, -19.29337464421385, 0.3231791658026955};
  const double body_rate[] = {rate[0], rate[0] + rate[1], rate[2], rate[3] + rate[4],
                              rate[4], rate[5] + rate[6], rate[6]};
  for (int b = 0; b < 7; ++b) {
    const PoseSample& s = sample(result, b, 0.03);
    const Quat q = s.pose.q;
    EXPECT_NEAR(difference(2.0 * std::atan2(q.z(), q.w()), turned(b)), 0.0, 1e-7) << "body " << b + 1;
    EXPECT_NEAR(s.w.z(), body_rate[b], 1e-5) << "body " << b + 1;
  }
  // The crank's end up to 0.03 s, recomputed in extended precision.
  for (const auto& [t, x, y] :
       {std::tuple{.005, 0.00684464175, 0.00146658762}, std::tuple{.010, -0.00389055239, 0.00581924412},
        std::tuple{.020, -0.00227442092, 0.00662019709}, std::tuple{.030, -0.00696303943, -0.00071838843}}) {
    const Vec3 home(0.007 * std::cos(start[0]), 0.007 * std::sin(start[0]), 0.0);
    const Vec3 F = carried(*mechanism, 0, home, sample(result, 0, t));
    EXPECT_NEAR(F.x(), x, 1e-9) << t;
    EXPECT_NEAR(F.y(), y, 1e-9) << t;
  }
}

// Cranks of the correct branch turn alike: 3 phi'' = 3.5 g sin phi, phi(0) = 0, phi'(0) = 1. The first
// singular position is passed at 0.714356 s; EXUDYN's Richardson limit at 10 s agrees with this to 1e-8.
void expect_double_four_bar(double duration, const std::vector<std::array<double, 5>>& reference) {
  const auto mechanism = example("double-four-bar", {{"motion.duration", std::to_string(duration) + " s"}});
  const RunResult result = follow(mechanism, 5e-4, 0.1);
  for (const auto& r : reference) {
    const PoseSample& s = sample(result, 0, r[0]);
    EXPECT_NEAR(2.0 * s.pose.p.x(), r[1], 1e-6) << r[0];  // B0, the end of the first crank
    EXPECT_NEAR(2.0 * s.pose.p.y(), r[2], 1e-6) << r[0];
    EXPECT_NEAR(2.0 * s.v.x(), r[3], 1e-5) << r[0];
    EXPECT_NEAR(2.0 * s.v.y(), r[4], 1e-5) << r[0];
    // The right-hand crank turns with it: no loop has folded.
    EXPECT_NEAR(sample(result, 4, r[0]).pose.p.x() - 2.0, s.pose.p.x(), 1e-6) << r[0];
  }
}

TEST(DoubleFourBar, PassesItsSingularPositionOnTheRightBranch) {
  expect_double_four_bar(1.0, {{0.5, 0.695286633164, 0.718732563436, 1.9602054254, -1.8962611406},
                               {1.0, -0.195020301949, -0.980799205662, -6.6766780369, 1.3275783252}});
}

TEST(DoubleFourBar, PassesTenSingularPositionsOnTheRightBranch) {
  expect_double_four_bar(10.0, {{2.0, 0.057815795768, 0.998327267863, 1.0172601366, -0.0589122487},
                                {3.0, -0.549339739302, -0.83559909695, -5.4804640312, 3.6029678505},
                                {4.0, 0.117616102377, 0.993059138451, 1.069039265, -0.1266150492},
                                {5.0, -0.811310461005, -0.584615545349, -3.5691173972, 4.9531051713},
                                {8.0, 0.251055914628, 0.967972586249, 1.2743121057, -0.3305089377},
                                {10.0, 0.328458111541, 0.944518538179, 1.4230514702, -0.49486884549}});
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
  const RunResult result = follow(mechanism, 5e-4, 0.1);
  // The far end of bar 2: DOP853 with projection on a 5-angle chain, energy kept to 1.4e-13 J.
  const double reference[][4] = {
      {0.1, 0.9902415380, -0.9999528486, -0.0097108483},  {0.5, 0.7747178080, -0.9798150477, -0.1999061590},
      {1.0, 0.2744813193, -0.8867079387, -0.4623300027},  {1.5, -0.2790175754, -0.8873613788, -0.4610745963},
      {2.0, -0.7781353730, -0.9803526834, -0.1972526706}, {3.0, -0.7712813590, -0.9792693298, -0.2025625327},
      {4.0, 0.2835510791, -0.8880228141, -0.4597993928},  {5.0, 0.9999327423, -0.9999999977, -0.0000672554},
      {8.0, -0.7643526022, -0.9781537944, -0.2078825497}, {10.0, 0.9997309873, -0.9999999638, -0.0002689765}};
  for (const auto& r : reference) {
    const Vec3 P = carried(*mechanism, 1, Vec3(1.0, -1.0, 0.0), sample(result, 1, r[0]));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(P[k], r[k + 1], 1e-8) << r[0];
    EXPECT_NEAR(energy(*mechanism, result, r[0]), -29.43, 1e-9) << r[0];
  }
}

}  // namespace
}  // namespace boresight
