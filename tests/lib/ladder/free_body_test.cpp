// Bodies that turn in space: Euler's equations for a free body, and a heavy top.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "reference/reference.hpp"
#include "scenes.hpp"
#include "stepper.hpp"
#include "tree_formulation_scenes.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace free_body_test {

MechanismDescription one_body(double mass, const Vec3& center, const Vec3& inertia) {
  MechanismDescription m;
  m.name = "one body";
  BodyDescription b;
  b.name = "body";
  b.mass = mass;
  b.center_of_mass = center;
  b.inertia = inertia.asDiagonal();
  b.boresight = Vec3::UnitZ();
  m.bodies.push_back(b);
  return m;
}

struct Turning {
  Vec3 p, w;  // world, body [m], [rad/s]
  Quat q;
};

// From home, turning with w about `fixed`, for some time.
struct Follower {
  Follower(bool paper, const MechanismDescription& description, const Vec3& fixed, const Vec3& w)
      : mechanism(description), formulation(scenes::formulate(paper, mechanism)) {
    IdealState start = scenes::at_home(mechanism);
    start.bodies[0].w = w;
    start.bodies[0].v = w.cross(start.bodies[0].p - fixed);
    stepper = std::make_unique<scenes::Stepper>(*formulation, start);
  }
  Turning at(double t, double h) {
    const int steps = static_cast<int>(std::lround((t - stepper->t) / h));
    for (int k = 0; k < steps; ++k) stepper->step(h);
    const BodyMotion& b = formulation->bodies(stepper->t, stepper->y)[0];
    Quat q(b.R);
    return {b.p, b.R.transpose() * b.w, q};
  }
  double energy() { return formulation->energy(stepper->t, stepper->y); }
  Mechanism mechanism;
  std::unique_ptr<Formulation> formulation;
  std::unique_ptr<scenes::Stepper> stepper;
};

// Up to the sign, which turns nothing.
void expect_turned(const Quat& q, const Quat& reference, double tolerance) {
  const double sign = q.dot(reference) < 0.0 ? -1.0 : 1.0;
  EXPECT_NEAR((sign * q.coeffs() - reference.coeffs()).norm(), 0.0, tolerance);
}

// Of a row of tests/reference/free_body.txt.
Quat turn_of(const reference::Row& row, std::size_t first) {
  return {row[first], row[first + 1], row[first + 2], row[first + 3]};
}
Vec3 vector_of(const reference::Row& row, std::size_t first) { return {row[first], row[first + 1], row[first + 2]}; }

// Moments of inertia 1, 2, 3 kg m^2, starting with (1, 1, 1) rad/s.
TEST(FreeBody, TumblesAsEulersEquationsSay) {
  for (const bool paper : {false, true}) {
    const Vec3 inertia(1.0, 2.0, 3.0);
    Follower body(paper, one_body(1.0, Vec3::Zero(), inertia), Vec3::Zero(), Vec3(1.0, 1.0, 1.0));
    const auto kept = [&](const Turning& now) {
      const Vec3 L = inertia.cwiseProduct(now.w);
      EXPECT_NEAR(now.w.dot(L), 6.0, 1e-10);
      EXPECT_NEAR(L.squaredNorm(), 14.0, 1e-10);
      EXPECT_NEAR((now.q * L - inertia).norm(), 0.0, 1e-10);
      EXPECT_NEAR(body.energy(), 3.0, 1e-10);
    };
    for (const reference::Row& row : reference::table("free_body", "free")) {
      const Turning now = body.at(row[0], 1e-3);
      EXPECT_NEAR((now.w - vector_of(row, 1)).norm(), 0.0, 1e-9);
      expect_turned(now.q, turn_of(row, 4), 1e-9);
      kept(now);
    }
  }
}

// A symmetric body: its axis goes around the angular momentum at L / A, its spin seen from the body goes
// around the axis at (A - C) / A w_3 (Goldstein, Classical Mechanics, section 5.6).
TEST(FreeBody, PrecessesSteadilyWhereItIsSymmetric) {
  const double A = 2.0, C = 0.8;
  const Vec3 w(0.4, 0.0, 3.0), L(A * w.x(), 0.0, C * w.z());
  for (const bool paper : {false, true}) {
    Follower body(paper, one_body(1.0, Vec3::Zero(), Vec3(A, A, C)), Vec3::Zero(), w);
    const Turning now = body.at(5.0, 1e-3);
    const Vec3 axis = Eigen::AngleAxisd(5.0 * L.norm() / A, L.normalized()) * Vec3::UnitZ();
    EXPECT_NEAR((now.q * Vec3::UnitZ() - axis).norm(), 0.0, 1e-9);
    const double turned = 5.0 * (C - A) / A * w.z();
    EXPECT_NEAR((now.w - Vec3(w.x() * std::cos(turned), w.x() * std::sin(turned), w.z())).norm(), 0.0, 1e-9);
  }
}

// EXUDYN's heavy top (15 kg, centre of mass 1 m from the fixed point), which prints its orientation after 0.2 s to five digits. Positions
// are of the centre of mass.
TEST(HeavyTop, PrecessesAndNutatesAsComputedIndependently) {
  MechanismDescription m = one_body(15.0, Vec3(0.0, 1.0, 0.0), Vec3(0.234375, 0.46875, 0.234375));
  m.gravity = Vec3(0.0, 0.0, -9.81);
  JointDescription j;
  j.name = "point";
  j.type = JointType::spherical;
  j.first = kGround;
  j.second = 0;
  m.joints.push_back(j);
  for (const bool paper : {false, true}) {
    Follower top(paper, m, Vec3::Zero(), Vec3(0.0, 150.0, -4.61538));
    const double h = 2e-5;
    const double energy = reference::line("free_body", "top energy")[0];
    EXPECT_NEAR(top.energy(), energy, 1e-8);
    const Turning now = top.at(0.2, h);
    const double sign = now.q.w() < 0.0 ? 1.0 : -1.0;  // the sign turns nothing
    const std::pair<const char*, const char*> published[] = {
        {"-0.70828", "w"}, {"0.43878", "x"}, {"0.54573", "y"}, {"0.0894", "z"}};
    const double ours[] = {now.q.w(), now.q.x(), now.q.y(), now.q.z()};
    for (int k = 0; k < 4; ++k)
      validation::expect_printed(
          "EXUDYN, heavy top, at 0.2 s",
          std::string("quaternion, ") + published[k].second + (paper ? ", multipliers" : ", tree"), published[k].first,
          sign * ours[k], 1e-5);
    expect_turned(now.q, turn_of(reference::line("free_body", "top orientation"), 1), 1e-8);
    for (const reference::Row& row : reference::table("free_body", "top position"))
      EXPECT_NEAR((top.at(row[0], h).p - vector_of(row, 1)).norm(), 0.0, 1e-9) << row[0];
    EXPECT_NEAR(top.energy() / energy, 1.0, 1e-10);
  }
}

// The example files hold both in gimbals without weight.
RunResult example(const std::string& name, double step, double spacing) {
  const auto mechanism =
      scenes::build(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + name + "/" + name + ".toml"));
  RunOptions options;
  options.step = step;
  options.sample_spacing = spacing;
  return make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
}

TEST(FreeBody, TumblesTheSameInAGimbalWithoutWeight) {
  const RunResult result = example("free-body", 1e-3, 1.0);
  for (const reference::Row& row : reference::table("free_body", "free"))
    expect_turned(result.boresight.samples[static_cast<std::size_t>(std::lround(row[0]))].pose.q, turn_of(row, 4),
                  1e-9);
}

TEST(HeavyTop, MovesTheSameInAGimbalWithoutWeight) {
  const RunResult result = example("heavy-top", 1e-4, 0.1);
  const std::vector<PoseSample>& s = result.boresight.samples;
  expect_turned(s[2].pose.q, turn_of(reference::line("free_body", "top orientation"), 1), 1e-8);
  for (const reference::Row& row : reference::table("free_body", "top position"))
    EXPECT_NEAR((s[static_cast<std::size_t>(std::lround(10.0 * row[0]))].pose.p - vector_of(row, 1)).norm(), 0.0, 1e-9)
        << row[0];
}

}  // namespace free_body_test
}  // namespace boresight
