#include "boresight/mechanism/ideal_motion.hpp"

#include <gtest/gtest.h>

#include "boresight/io/expression.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "reference/reference.hpp"
#include "scenes.hpp"

namespace boresight {
namespace ideal_motion_test {

constexpr double kEta = -35.264389682754654 * std::numbers::pi / 180.0;

Mat3 rotation(double angle, int axis) { return Eigen::AngleAxisd(angle, Vec3::Unit(axis)).toRotationMatrix(); }

// A leg's inverse kinematics in closed form: from the platform's pose (R, p) to the drives' angle a and length L.
struct Leg {
  double a, b, c, d, L;
};
Leg leg_in_closed_form(int leg, const Mat3& R, const Vec3& p) {
  const Mat3 Q = rotation((leg - 1) * 2.0 * std::numbers::pi / 3.0, 2);
  const Mat3 E = Q * rotation(-kEta, 1);
  const Vec3 p_C(0.1 / std::cos(kEta), 0.0, 0.0);
  const Vec3 p_F = E.transpose() * (p + R * Q * Vec3(0.3, 0.0, -0.04));
  const Vec3 u = E.transpose() * R * Q * Vec3::UnitY();
  Leg x;
  x.b = -std::asin(u.x());
  x.a = std::atan2(u.z(), u.y());
  const Vec3 w = rotation(-x.b, 2) * rotation(-x.a, 0) * (p_F - p_C);
  x.c = std::atan2(w.x(), w.z());
  x.d = w.y();
  x.L = std::hypot(w.x(), w.z());
  return x;
}

int joint_named(const Mechanism& mechanism, const std::string& name) {
  for (int j = 0; j < mechanism.joints(); ++j)
    if (mechanism.description().joints[j].name == name) return j;
  return -1;
}

TEST(IdealMotion, DrivesOfThePaperAgreeWithTheLegInClosedForm) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const IdealMotion motion = IdealMotion::kinematic(*mechanism);
  std::vector<TimeValue> laws(mechanism->joints());
  const BodyDescription& home = mechanism->description().bodies[mechanism->boresight_body()];
  double shortest = 1.0, longest = 0.0, slide = 0.0, swing = 0.0;
  for (int i = 0; i <= 500; ++i) {
    const double t = i / 500.0;
    motion.drive_laws(t, laws);
    const PrescribedPose pose = prescribed_pose(mechanism->description(), t);
    for (int leg = 1; leg <= 3; ++leg) {
      const Leg exact = leg_in_closed_form(leg, pose.R, pose.p);
      const Leg at_home = leg_in_closed_form(leg, home.axes, home.center_of_mass);
      EXPECT_NEAR(laws[joint_named(*mechanism, "A" + std::to_string(leg))].value, exact.a - at_home.a, 1e-11);
      EXPECT_NEAR(laws[joint_named(*mechanism, "P" + std::to_string(leg))].value, exact.L - at_home.L, 1e-11);
      shortest = std::min(shortest, exact.L);
      longest = std::max(longest, exact.L);
      slide = std::max(slide, std::abs(exact.d));
      swing = std::max(swing, std::abs(exact.b));
    }
  }
  const reference::Row ranges = reference::line("leg", "ranges");
  EXPECT_NEAR(shortest, ranges[0], 1e-6);
  EXPECT_NEAR(longest, ranges[1], 1e-6);
  EXPECT_NEAR(slide, ranges[2], 1e-6);
  EXPECT_NEAR(swing * 180.0 / std::numbers::pi, ranges[3], 1e-4);
}

TEST(IdealMotion, DriveRatesAndAccelerationsAreTheDerivativesOfTheDrives) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const IdealMotion motion = IdealMotion::kinematic(*mechanism);
  std::vector<TimeValue> now(mechanism->joints()), plus = now, minus = now;
  const double dt = 2e-5;
  for (double t : {0.05, 0.2, 0.41, 0.5, 0.77, 0.95}) {
    motion.drive_laws(t, now);
    motion.drive_laws(t + dt, plus);
    motion.drive_laws(t - dt, minus);
    for (int j = 0; j < mechanism->joints(); ++j) {
      if (!mechanism->description().joints[j].driven) continue;
      // Third derivatives reach 2e4 1/s^3: differences err by dt^2/6 of that, 1.4e-6.
      EXPECT_NEAR(now[j].rate, (plus[j].value - minus[j].value) / (2.0 * dt), 2e-6);
      EXPECT_NEAR(now[j].acceleration, (plus[j].rate - minus[j].rate) / (2.0 * dt), 5e-5);
    }
  }
}

TEST(IdealMotion, AllJointsStayClosedWithTheirRatesAndAccelerations) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const IdealMotion motion = IdealMotion::kinematic(*mechanism);
  ConstraintSystem system(*mechanism, {.clearance = ClearanceRows::closed, .drives = true});
  std::vector<TimeValue> laws(mechanism->joints());
  IdealState state;
  std::vector<Vec6> Ja = system.block_vector();
  for (int i = 0; i <= 97; ++i) {
    motion.state(i / 97.0, state);
    motion.drive_laws(state.t, laws);
    system.evaluate(state.bodies, laws);
    EXPECT_LT(system.violation(), 1e-11);
    system.multiply(state.acceleration, Ja);
    for (int k = 0; k < system.blocks(); ++k) {
      EXPECT_LT(system.rows(k).rate.lpNorm<Eigen::Infinity>(), 1e-8);
      const int n = system.joints()[k].count();
      EXPECT_LT((Ja[k] - system.rows(k).gamma).head(n).lpNorm<Eigen::Infinity>(), 1e-4);
    }
  }
}

TEST(KinematicReport, DefaultMechanismHasSixFreedomsAndItsKnownConditioning) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const KinematicReport report = analyse_kinematics(*mechanism);
  EXPECT_EQ(report.mobility, 6);
  EXPECT_EQ(report.redundant_rows, 0);
  EXPECT_EQ(report.constraint_rows, 72);
  EXPECT_TRUE(report.feasible);
  EXPECT_TRUE(report.lost.empty());
  double orientation = 1.0, position = 1.0;
  for (const ConditioningSample& s : report.along) {
    orientation = std::min(orientation, s.orientation);
    position = std::min(position, s.position);
  }
  // Found on 201 instants here, on 501 there.
  const reference::Row conditioning = reference::line("leg", "conditioning");
  EXPECT_NEAR(orientation, conditioning[0], 1e-4);
  EXPECT_NEAR(position, conditioning[1], 1e-4);
}

TEST(KinematicReport, LevelAxesLoseTheTurnAboutTheVertical) {
  const auto mechanism = scenes::build(scenes::rrcpr_with_legs(0.0, 0.1, 0.3));
  const KinematicReport report = analyse_kinematics(*mechanism, 21);
  ASSERT_FALSE(report.lost.empty());
  EXPECT_EQ(report.lost.front().t, 0.0);
  EXPECT_NE(report.lost.front().description.find("turns about (0, 0, 1)"), std::string::npos)
      << report.lost.front().description;
}

TEST(KinematicReport, EqualRadiiLoseASidewaysMotion) {
  const auto mechanism = scenes::build(scenes::rrcpr_with_legs(kEta, 0.3, 0.3));
  const KinematicReport report = analyse_kinematics(*mechanism, 21);
  ASSERT_FALSE(report.lost.empty());
  const std::string& lost = report.lost.front().description;
  EXPECT_NE(lost.find("moves along"), std::string::npos) << lost;
  EXPECT_NE(lost.find(", 0)"), std::string::npos) << "the rods are upright, so the lost motion is level: " << lost;
}

TEST(ConstraintSystem, RedundantRowsGiveTheSameMotionAsAnIndependentSet) {
  // Three rows of a planar four-bar in space repeat others; with one revolute made spherical and one cylindrical the same motion
  // has independent rows.
  const auto four_bar = [](bool redundant) {
    return scenes::build(
        scenes::four_bar({{0, 0, 0}, {0, 0, 1}, {2, 0, 1.5}, {2.5, 0, 0}}, redundant, "0.4*sin(3*t)+0.1*t"));
  };
  const auto loose = four_bar(false), tight = four_bar(true);
  EXPECT_EQ(analyse_kinematics(*tight, 21).redundant_rows, 3);
  EXPECT_EQ(analyse_kinematics(*loose, 21).redundant_rows, 0);
  EXPECT_EQ(analyse_kinematics(*tight, 21).mobility, 1);
  const IdealMotion a = IdealMotion::kinematic(*loose), b = IdealMotion::kinematic(*tight);
  for (double t : {0.0, 0.13, 0.31, 0.5}) {
    BodyAcceleration ax, bx;
    const BodyMotion x = a.body(t, 1, &ax), y = b.body(t, 1, &bx);
    EXPECT_LT((x.p - y.p).norm(), 1e-11);
    EXPECT_LT((x.w - y.w).norm(), 1e-9);
    EXPECT_LT((ax - bx).norm(), 1e-6);
  }
}

// A pose that starts half a turn from home is another one than home.
TEST(IdealMotion, StartsWhereThePoseSaysAlsoHalfATurnFromHome) {
  const std::string text = R"(format = 1
name = "mount"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "fork"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "0 mm"]
inertia = ["0.1 kg m^2", "0.1 kg m^2", "0.1 kg m^2"]
[[body]]
name = "tube"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "0 mm"]
inertia = ["0.1 kg m^2", "0.1 kg m^2", "0.1 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "azimuth"
type = "revolute"
connects = ["ground", "fork"]
point = ["0 mm", "0 mm", "-100 mm"]
axis = [0, 0, 1]
driven = true
[[joint]]
name = "elevation"
type = "revolute"
connects = ["fork", "tube"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 1, 0]
driven = true
[motion]
duration = "1 s"
body = "tube"
angles = { convention = "ZYZ", psi = "pi", theta = "0.3 + 0.2*t", phi = "0" }
position = { unit = "mm", x = "0", y = "0", z = "0" }
)";
  const Mechanism mechanism(read_mechanism_text(text, "mount.toml"));
  const IdealMotion ideal = IdealMotion::kinematic(mechanism);
  for (const double t : {0.0, 0.5, 1.0}) {
    const Mat3 expected = rotation(std::numbers::pi, 2) * rotation(0.3 + 0.2 * t, 1);
    EXPECT_LE((ideal.body(t, 1).R - expected).cwiseAbs().maxCoeff(), 1e-9) << t;
  }
}

// An arm whose end is led to its pose keeps the elbow that it is drawn with.
// A slip of the unit or the frequency: the pose is a good one, and what is wrong is said.
TEST(IdealMotion, SaysWhereALawIsTooFastForAnyStep) {
  for (const char* law : {"1e9*t", "0.01*sin(1e8*t)"}) {
    const auto mechanism = std::make_shared<const Mechanism>(
        read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", {{"motion.drives.A", law}}));
    try {
      IdealMotion::kinematic(*mechanism);
      FAIL() << law;
    } catch (const ComputationError& e) {
      EXPECT_NE(std::string(e.what()).find("fast"), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find("singular"), std::string::npos) << e.what();
    }
  }
}

TEST(IdealMotion, AnArmLedByItsEndKeepsItsElbow) {
  const double bend = 0.3;
  MechanismDescription m;
  m.name = "arm";
  std::vector<Vec3> points = {Vec3::Zero()};
  const std::vector<double> lengths = {1.0, 1.0, 0.3}, angles = {0.4, 0.4 - bend, 0.4 - 2.0 * bend};
  for (int k = 0; k < 3; ++k)
    points.emplace_back(points.back() + lengths[k] * Vec3(std::cos(angles[k]), std::sin(angles[k]), 0.0));
  for (int k = 0; k < 3; ++k) {
    BodyDescription b;
    b.name = "link" + std::to_string(k);
    b.mass = 1.0;
    b.center_of_mass = k == 2 ? points[3] : Vec3(0.5 * (points[k] + points[k + 1]));
    b.inertia = Mat3::Identity();
    if (k == 2) b.boresight = Vec3::UnitX();
    m.bodies.push_back(b);
    JointDescription j;
    j.name = "j" + std::to_string(k);
    j.first = k - 1;
    j.second = k;
    j.point = points[k];
    j.axis = Vec3::UnitZ();
    j.driven = true;
    m.joints.push_back(j);
  }
  // The end goes round, seen from the base, by far more than a step of Newton's method keeps a branch.
  for (const double turn : {-1.2, 0.7, 1.5}) {
    const Mat3 R = rotation(turn, 2);
    const Vec3 end = R * points[3];
    PoseMotionDescription pose;
    pose.body = 2;
    pose.angle = {parse_expression(std::to_string(turn)), parse_expression("0"), parse_expression("0")};
    for (int k = 0; k < 3; ++k) pose.position[k] = parse_expression(std::to_string(end[k]));  // to a micrometre
    m.motion.pose = pose;
    m.motion.duration = 0.1;
    const Mechanism mechanism(m);
    const BodyMotion upper = IdealMotion::kinematic(mechanism).body(0.0, 0);
    EXPECT_LE((upper.p - R * m.bodies[0].center_of_mass).norm(), 1e-4) << turn;
  }
}

}  // namespace ideal_motion_test
}  // namespace boresight
