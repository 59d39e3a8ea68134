// Andrews' squeezing mechanism (IFToMM multibody benchmark A03; Test Set for IVP Solvers, Bari) as its
// example file describes it.
#include <gtest/gtest.h>

#include "published_examples.hpp"
#include "reference/reference.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace andrews_squeezer_test {

using scenes::carried;
using scenes::example;
using scenes::follow;
using scenes::sample;

const char* const kBari = "Bari test set, Andrews' squeezer, at 0.03 s";
const double kAndrewsStart[] = {-0.0617138900142764496, 0.0,
                                0.455279819163070380,   0.222668390165885885,
                                0.487364979543842550,   -0.222668390165885885,
                                1.23054744454982119};

// From beta, theta, gamma, phi, delta, Omega, epsilon to the angles of the bodies in the plane: beta; beta +
// theta; gamma; phi + delta; delta; Omega + epsilon; epsilon. Rates and accelerations likewise.
std::array<double, 7> of_bodies(const double* q) {
  return {q[0], q[0] + q[1], q[2], q[3] + q[4], q[4], q[5] + q[6], q[6]};
}

// Angles, rates and accelerations at 0.03 s from the Test Set for IVP Solvers (Bari): PSIDE with tolerance
// 1e-14.
TEST(AndrewsSqueezer, IsWhereTheBariTestSetPutsIt) {
  const auto mechanism = example("andrews-squeezer", {{"motion.duration", "0.03 s"}});
  const double end[] = {15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                        0.5244099658805304, 0.5347301163226948, 1.048080741042263};
  const double rate[] = {1139.920302151208,  -1424.379294994111, 11.03291221937134, 19.29337464421385,
                         0.5735699284790808, -19.29337464421385, 0.3231791658026955};
  const double acceleration[] = {-24631.76316945196, 51850.37701610329,  324102.5686413781, 566749.3645176213,
                                 16743.62929479361,  -566749.3645176222, 9826.520791458422};
  // The published accelerations of the angles satisfy the problem's own equations at the published positions
  // and velocities to 0.06 only, a ten-millionth of the largest; solving those equations there gives the
  // second row.
  const double solved[] = {-24631.76425, 51850.32138, 324102.6006, 566749.4218, 16743.6354, -566749.4218, 9826.507826};
  const double first_acceleration[] = {
      14222.4439199541138705911625887, -10666.8329399655854029433719415, 0, 0, 0, 0, 0};
  const auto difference = [](double a, double b) { return std::remainder(a - b, 2.0 * std::numbers::pi); };
  const RunResult result = follow(mechanism, 1e-5, 1e-3);
  for (int b = 0; b < 7; ++b) {
    const PoseSample& s = sample(result, b, 0.03);
    const Quat q = s.pose.q;
    EXPECT_NEAR(difference(2.0 * std::atan2(q.z(), q.w()), of_bodies(end)[b] - of_bodies(kAndrewsStart)[b]), 0.0, 1e-7)
        << "body " << b + 1;
    EXPECT_NEAR(s.w.z(), of_bodies(rate)[b], 1e-5) << "body " << b + 1;
    EXPECT_NEAR(s.alpha.z(), of_bodies(acceleration)[b], 2.0 * 0.06) << "body " << b + 1;
    EXPECT_NEAR(s.alpha.z() / of_bodies(solved)[b], 1.0, 1e-7) << "body " << b + 1;
    EXPECT_NEAR(sample(result, b, 0.0).alpha.z(), of_bodies(first_acceleration)[b], 1e-7) << "body " << b + 1;
  }
  // Of the bodies whose own angle it prints.
  const struct {
    int body;
    const char *name, *angle, *rate;
  } printed[] = {{0, "beta", "15.81077119629904", "1139.920302151208"},
                 {2, "gamma", "0.04082224013073101", "11.03291221937134"},
                 {4, "delta", "0.5244099658805304", "0.5735699284790808"},
                 {6, "epsilon", "1.048080741042263", "0.3231791658026955"}};
  for (const auto& p : printed) {
    const PoseSample& s = sample(result, p.body, 0.03);
    // The whole turns are those that are printed.
    const double turned = kAndrewsStart[p.body] + 2.0 * std::atan2(s.pose.q.z(), s.pose.q.w());
    const double angle = std::stod(p.angle) + difference(turned, std::stod(p.angle));
    validation::expect_printed(kBari, std::string(p.name) + " [rad]", p.angle, angle, 1e-7);
    validation::expect_printed(kBari, std::string("rate of ") + p.name + " [rad/s]", p.rate, s.w.z(), 1e-5);
  }
}

// The crank up to 0.05 s, recomputed in extended precision; and what its motor, the spring and the bodies
// keep.
TEST(AndrewsSqueezer, TurnsItsCrankAsRecomputedAndKeepsItsEnergy) {
  const auto mechanism = example("andrews-squeezer");
  const double spacing = 1e-4;
  const RunResult result = follow(mechanism, 5e-6, spacing);
  // The crank's angle without the jumps of the circle.
  std::vector<double> beta = {kAndrewsStart[0]};
  const auto turned = [](const PoseSample& s) { return 2.0 * std::atan2(s.pose.q.z(), s.pose.q.w()); };
  for (std::size_t k = 1; k < result.time.size(); ++k) {
    const PoseSample &now = sample(result, 0, result.time[k]), &before = sample(result, 0, result.time[k - 1]);
    beta.push_back(beta.back() + std::remainder(turned(now) - turned(before), 2.0 * std::numbers::pi));
  }
  // t, beta, its rate, the end of the crank.
  const auto reference = reference::table("andrews_squeezer", "crank");
  for (const auto& r : reference) {
    const PoseSample& s = sample(result, 0, r[0]);
    EXPECT_NEAR(beta[static_cast<std::size_t>(std::lround(r[0] / spacing))], r[1], 1e-7) << r[0];
    EXPECT_NEAR(s.w.z(), r[2], 1e-5) << r[0];
    const Vec3 home(0.007 * std::cos(kAndrewsStart[0]), 0.007 * std::sin(kAndrewsStart[0]), 0.0);
    const Vec3 F = carried(*mechanism, 0, home, s);
    EXPECT_NEAR(F.x(), r[3], 1e-9) << r[0];
    EXPECT_NEAR(F.y(), r[4], 1e-9) << r[0];
  }
  const MechanismDescription& m = mechanism->description();
  for (std::size_t k = 0; k < result.time.size(); k += 50) {
    const Vec3 D = carried(*mechanism, m.springs[0].second, m.springs[0].second_point,
                           sample(result, m.springs[0].second, result.time[k]));
    const double stretched = (D - m.springs[0].first_point).norm() - 0.07785;
    double energy = 0.5 * 4530.0 * stretched * stretched - 0.033 * beta[k];
    for (int b = 0; b < 7; ++b) {
      const PoseSample& s = sample(result, b, result.time[k]);
      energy += 0.5 * m.bodies[b].mass * s.v.squaredNorm() + 0.5 * m.bodies[b].inertia(2, 2) * s.w.z() * s.w.z();
    }
    EXPECT_NEAR(energy, reference::line("andrews_squeezer", "energy")[0], 1e-9) << result.time[k];
  }
}

// One of its three chains to the point E: a link from E to a pin, and a crank from the pin to a pivot on the
// ground.
struct Chain {
  int link, crank;
  Vec3 pin, pivot;  // at home [m]
  double moment;    // of the motor on the crank [N m]
};

// What acts on the link at E, from the accelerations by Newton and Euler [N]: two unknown forces, and for
// four equations the link's three and the crank's turn about its pivot.
Vec3 force_at_E(const Mechanism& mechanism, const RunResult& result, double t, const Chain& chain, const Vec3& E) {
  const MechanismDescription& m = mechanism.description();
  const PoseSample &link = sample(result, chain.link, t), &crank = sample(result, chain.crank, t);
  const Vec3 pin = carried(mechanism, chain.link, chain.pin, link), end = carried(mechanism, chain.link, E, link);
  const Vec3 to_end = end - link.pose.p, to_pin = pin - link.pose.p, arm = pin - chain.pivot;
  const double turning =
      m.bodies[chain.crank].inertia(2, 2) + m.bodies[chain.crank].mass * (crank.pose.p - chain.pivot).squaredNorm();
  Eigen::Matrix4d equations;
  equations << 1, 0, 1, 0, 0, 1, 0, 1, -to_end.y(), to_end.x(), -to_pin.y(), to_pin.x(), 0, 0, arm.y(), -arm.x();
  Eigen::Vector4d right(m.bodies[chain.link].mass * link.a.x(), m.bodies[chain.link].mass * link.a.y(),
                        m.bodies[chain.link].inertia(2, 2) * link.alpha.z(), turning * crank.alpha.z() - chain.moment);
  const Eigen::Vector4d forces = equations.fullPivLu().solve(right);
  return {forces[0], forces[1], 0.0};
}

// The multipliers of the test set are the forces at E, where four links meet, on three of them: K3, K4 and
// K6.
TEST(AndrewsSqueezer, CarriesTheForcesThatAreTheTestSetsMultipliers) {
  const auto mechanism = example("andrews-squeezer", {{"motion.duration", "0.03 s"}});
  const RunResult result = follow(mechanism, 1e-5, 1e-3);
  const auto joint = [&](const std::string& name) {
    for (const JointDescription& j : mechanism->description().joints)
      if (j.name == name) return j.point;
    throw std::logic_error("no joint " + name);
  };
  const Vec3 E = joint("E3");
  const Chain motor{1, 0, joint("F"), joint("O"), 0.033}, fourth{3, 4, joint("H"), joint("A5"), 0.0},
      sixth{5, 6, joint("G"), joint("A7"), 0.0};
  const double t = 0.03;
  const Vec3 on4 = force_at_E(*mechanism, result, t, fourth, E), on6 = force_at_E(*mechanism, result, t, sixth, E);
  const Vec3 on3 = -force_at_E(*mechanism, result, t, motor, E) - on4 - on6;
  const double computed[] = {on3.x(), on3.y(), on4.x(), on4.y(), on6.x(), on6.y()};
  const char* const reference[] = {"199.1753333731910", "-29.75531228015052", "23.06654119098399",
                                   "31.45271365475927", "22.64249232082739",  "11.61740700019673"};
  // Like the accelerations, they satisfy the problem's equations at the published positions to 1e-7 of the
  // largest.
  for (int k = 0; k < 6; ++k)
    validation::expect_printed(kBari, "multiplier " + std::to_string(k + 1) + " [N]", reference[k], computed[k],
                               1e-7 * 200.0);
  // At first the spring is held by the motor's chain alone, which is in line then, so that its own two links
  // cannot tell how much of it.
  EXPECT_NEAR(force_at_E(*mechanism, result, 0.0, fourth, E).norm(), 0.0, 1e-9);
  EXPECT_NEAR(force_at_E(*mechanism, result, 0.0, sixth, E).norm(), 0.0, 1e-9);
}

}  // namespace andrews_squeezer_test
}  // namespace boresight
