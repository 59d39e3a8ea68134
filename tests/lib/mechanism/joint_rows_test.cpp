// Values, Jacobians and gamma of every kind of joint row, held against differences along a curved motion of both bodies.
#include "boresight/mechanism/joint_rows.hpp"

#include <gtest/gtest.h>

#include <random>

namespace boresight {
namespace joint_rows_test {

constexpr JointType kTypes[] = {JointType::revolute,  JointType::prismatic, JointType::cylindrical,
                                JointType::universal, JointType::spherical, JointType::planar,
                                JointType::fixed};

MechanismDescription two_bodies(JointType type, bool driven, JournalAxes* axes, bool journal_first) {
  MechanismDescription m;
  m.name = to_string(type);
  BodyDescription a;
  a.name = "a";
  a.mass = 1.0;
  a.center_of_mass = Vec3(0.1, 0.2, -0.3);
  a.axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  a.boresight = Vec3::UnitZ();
  BodyDescription b = a;
  b.name = "b";
  b.center_of_mass = Vec3(0.5, -0.1, 0.2);
  b.boresight.reset();
  m.bodies = {a, b};
  JointDescription j;
  j.name = "j";
  j.type = type;
  j.first = 0;
  j.second = 1;
  j.point = Vec3(0.3, 0.1, 0.05);
  j.axis = Vec3(1, -2, 2).normalized();
  j.second_axis = Vec3(2, 2, 1).normalized();
  j.driven = driven;
  m.joints = {j};
  if (axes) {
    ClearanceDescription c;
    c.joint = 0;
    c.journal = journal_first ? 0 : 1;
    c.axes = *axes;
    c.parameters.radial = 1e-4;
    m.clearances = {c};
  }
  return m;
}

struct Motion {
  std::vector<BodyMotion> bodies;
  std::vector<BodyAcceleration> acceleration;
  // The bodies dt later, to second order in the poses and first in the velocities.
  std::vector<BodyMotion> after(double dt) const {
    std::vector<BodyMotion> moved = bodies;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      Vec6 step;
      step << bodies[k].v, bodies[k].w;
      displace(moved[k], dt * step + 0.5 * dt * dt * acceleration[k]);
      moved[k].v += dt * acceleration[k].head<3>();
      moved[k].w += dt * acceleration[k].tail<3>();
    }
    return moved;
  }
};

Motion random_motion(const Mechanism& mechanism, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3(uniform(generator), uniform(generator), uniform(generator)); };
  Motion m;
  for (int b = 0; b < mechanism.bodies(); ++b) {
    const BodyDescription& d = mechanism.description().bodies[b];
    BodyMotion body{d.center_of_mass + 0.05 * vector(), d.axes, vector(), vector()};
    Vec6 turn = Vec6::Zero();
    turn.tail<3>() = 0.3 * vector();  // off the constraints, where every term counts
    displace(body, turn);
    m.bodies.push_back(body);
    BodyAcceleration a;
    a << vector(), vector();
    m.acceleration.push_back(a);
  }
  return m;
}

void hold_against_differences(const Mechanism& mechanism, const JointConstraint& constraint, const std::string& what) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Motion motion = random_motion(mechanism, seed);
    const TimeValue law{};  // drives at rest: their laws only shift the rows
    JointRows now, plus, minus;
    constraint.evaluate(motion.bodies, law, now);
    const double dt = 1e-4;
    constraint.evaluate(motion.after(dt), law, plus);
    constraint.evaluate(motion.after(-dt), law, minus);
    const auto stacked = [](const BodyMotion& b) { return (Vec6() << b.v, b.w).finished(); };
    const Vec6 Jv = now.reference * stacked(motion.bodies[constraint.reference_body()]) +
                    now.other * stacked(motion.bodies[constraint.other_body()]);
    const Vec6 Ja = now.reference * motion.acceleration[constraint.reference_body()] +
                    now.other * motion.acceleration[constraint.other_body()];
    for (int i = 0; i < constraint.count(); ++i) {
      // Central differences err by dt^2 times a third derivative of order one: 1e-8; rounding adds 1e-16/dt, 1e-16/dt^2.
      EXPECT_NEAR(now.rate[i], (plus.value[i] - minus.value[i]) / (2.0 * dt), 2e-7) << what << " row " << i;
      EXPECT_NEAR(now.rate[i], Jv[i], 1e-13) << what << " row " << i;
      EXPECT_NEAR(Ja[i] - now.gamma[i], (plus.value[i] - 2.0 * now.value[i] + minus.value[i]) / (dt * dt), 2e-6)
          << what << " row " << i;
      EXPECT_NEAR(Ja[i] - now.gamma[i], (plus.rate[i] - minus.rate[i]) / (2.0 * dt), 1e-6) << what << " row " << i;
    }
  }
}

TEST(JointRows, JacobianAndGammaAreTheDerivativesOfTheValue) {
  for (JointType type : kTypes) {
    for (bool driven : {false, true}) {
      if (driven && type != JointType::revolute && type != JointType::prismatic) continue;
      const Mechanism mechanism(two_bodies(type, driven, nullptr, false));
      const JointConstraint constraint(mechanism, 0, ClearanceRows::closed, true);
      hold_against_differences(mechanism, constraint, std::string(to_string(type)) + (driven ? ", driven" : ""));
    }
  }
}

TEST(JointRows, OpenAndReleasedRowsOfAClearanceMakeUpTheIdealJoint) {
  JournalAxes parallel = JournalAxes::parallel;
  for (JointType type : {JointType::revolute, JointType::cylindrical}) {
    for (bool journal_first : {false, true}) {
      const Mechanism mechanism(two_bodies(type, type == JointType::revolute, &parallel, journal_first));
      const JointConstraint open(mechanism, 0, ClearanceRows::open, true);
      const JointConstraint released(mechanism, 0, ClearanceRows::released, true);
      const JointConstraint closed(mechanism, 0, ClearanceRows::closed, true);
      EXPECT_EQ(open.count() + released.count(), closed.count());
      EXPECT_EQ(open.reference_body(), journal_first ? 1 : 0) << "the sleeve is the reference";
      hold_against_differences(mechanism, open, "open");
      hold_against_differences(mechanism, released, "released");
    }
  }
}

TEST(JointRows, AJointHasAsManyRowsAsItTakesFreedoms) {
  const int taken[] = {5, 5, 4, 4, 3, 3, 6};
  for (int k = 0; k < 7; ++k) {
    const Mechanism mechanism(two_bodies(kTypes[k], false, nullptr, false));
    EXPECT_EQ(JointConstraint(mechanism, 0, ClearanceRows::closed, true).count(), taken[k]) << to_string(kTypes[k]);
  }
}

TEST(JointRows, OfWhatJointsLeaveFreeAreTheDerivativesOfTheirValue) {
  for (JointType type : kTypes) {
    const Mechanism mechanism(two_bodies(type, false, nullptr, false));
    const JointConstraint constraint(mechanism, 0, ClearanceRows::free, false);
    hold_against_differences(mechanism, constraint, std::string(to_string(type)) + ", free");
  }
}

// Its two turns are coordinates in every pose; slopes of its axes would fail a quarter of a turn away.
TEST(JointRows, OfAUniversalJointAreItsTwoTurnsInEveryPose) {
  const Mechanism mechanism(two_bodies(JointType::universal, false, nullptr, false));
  const MechanismDescription& m = mechanism.description();
  const JointConstraint free(mechanism, 0, ClearanceRows::free, false);
  ASSERT_EQ(free.count(), 2);
  const Vec3 first = m.joints[0].axis, second = m.joints[0].second_axis;  // across each other
  ASSERT_NEAR(first.dot(second), 0.0, 1e-15);
  std::vector<BodyMotion> bodies;
  for (const BodyDescription& b : m.bodies) bodies.push_back({b.center_of_mass, b.axes, Vec3::Zero(), Vec3::Zero()});
  const Mat3 home = bodies[1].R;
  JointRows rows, at_home;
  free.evaluate(bodies, {}, at_home);
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= 3; ++b) {
      const double q1 = 0.99 * a, q2 = 0.97 * b;
      const Mat3 turned = Eigen::AngleAxisd(q1, first).toRotationMatrix();
      bodies[1].R = turned * Eigen::AngleAxisd(q2, second) * home;
      free.evaluate(bodies, {}, rows);
      EXPECT_NEAR(std::remainder(rows.value[0] - at_home.value[0] - q1, 2.0 * M_PI), 0.0, 1e-13) << a << ' ' << b;
      EXPECT_NEAR(std::remainder(rows.value[1] - at_home.value[1] - q2, 2.0 * M_PI), 0.0, 1e-13) << a << ' ' << b;
      Eigen::Matrix2d rates;
      for (int i = 0; i < 2; ++i) {
        const Vec3 by_turn = rows.other.row(i).tail<3>();
        rates.row(i) << by_turn.dot(first), by_turn.dot(turned * second);
      }
      EXPECT_LT((rates - Eigen::Matrix2d::Identity()).norm(), 1e-13) << a << ' ' << b;
    }
}

TEST(JointRows, AllRowsVanishAtHome) {
  for (JointType type : kTypes) {
    const Mechanism mechanism(two_bodies(type, false, nullptr, false));
    std::vector<BodyMotion> home;
    for (const BodyDescription& b : mechanism.description().bodies)
      home.push_back({b.center_of_mass, b.axes, Vec3::Zero(), Vec3::Zero()});
    JointRows rows;
    JointConstraint(mechanism, 0, ClearanceRows::closed, true).evaluate(home, {}, rows);
    EXPECT_LT(rows.value.lpNorm<Eigen::Infinity>(), 1e-15) << to_string(type);
  }
}

}  // namespace joint_rows_test
}  // namespace boresight
