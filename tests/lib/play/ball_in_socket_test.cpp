// A ball in its socket against the vector equations of its one contact, and every kind of play against what play_kind.hpp asks.
#include "boresight/play/ball/ball_in_socket.hpp"

#include <gtest/gtest.h>

#include <random>

#include "boresight/contact/hertz.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace ball_in_socket_test {

ClearanceDescription ball_description(double friction = 0.03, const char* law = "flores") {
  ClearanceDescription d;
  d.contact_law = law;
  d.parameters.radial = 0.2e-3;
  d.parameters.journal_radius = 12e-3;
  d.parameters.friction.coefficient = friction;
  return d;
}

JointPlay ball(double friction = 0.03, const char* law = "flores") {
  const ClearanceDescription d = ball_description(friction, law);
  return JointPlay(d, JointType::spherical, d.parameters);
}

ImpactSpeeds<double> speeds(double v) {
  ImpactSpeeds<double> all;
  all.fill(v);
  return all;
}

TEST(BallInSocket, ForcesAreThoseOfTheVectorEquations) {
  const ClearanceDescription d = ball_description();
  const JointPlay joint = ball();
  const NormalLaw law = make_normal_law(d.contact_law, "", d.parameters);
  const FrictionLaw friction = make_friction_law(d.friction_law, d.parameters.friction);
  // Eq. 28 with the ball's radius.
  const double stiffness = 4.0 / 3.0 * composite_modulus(d.parameters.contact) * std::sqrt(12e-3 * 12.2e-3 / 0.2e-3);
  EXPECT_NEAR(law.stiffness / stiffness, 1.0, 1e-12);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    PlayMotion<double> m;
    const Vec3 direction = Vec3(uniform(generator), uniform(generator), uniform(generator)).normalized();
    m.e = (0.2e-3 + 3e-6 * uniform(generator)) * direction;
    m.e_dot = 0.02 * Vec3(uniform(generator), uniform(generator), uniform(generator));
    m.w = 3.0 * Vec3(uniform(generator), uniform(generator), uniform(generator));
    PlayWrench<double> wrench;
    joint.wrench(m, speeds(0.05), wrench);
    const Vec3 n = m.e.normalized();
    const double depth = m.e.norm() - 0.2e-3;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    if (depth > 0.0) {
      ++touching;
      const double F = law.force(depth, m.e_dot.dot(n), 0.05);
      const Vec3 Q = 12.2e-3 * n, v = m.e_dot + m.w.cross(Vec3(Q - m.e)), slip = v - v.dot(n) * n;
      const Vec3 rub = -F * friction.force_per_velocity(slip.norm()) * slip;
      force = -F * n + rub;
      moment = Q.cross(rub);
    }
    EXPECT_LT((wrench.force - force).norm(), 1e-11 * (1.0 + force.norm()));
    EXPECT_LT((wrench.moment - moment).norm(), 1e-12 * (1.0 + moment.norm()));
    EXPECT_NEAR(wrench.contact[static_cast<int>(ContactPlace::radial)].penetration, depth, 1e-18);
  }
  EXPECT_GT(touching, 100);
}

TEST(BallInSocket, AConcentricBallFeelsNothing) {
  PlayMotion<double> m{Vec3::Zero(), Vec3::Zero(), Vec3(10, 20, 30)};
  PlayWrench<double> wrench;
  ball().wrench(m, speeds(1e-3), wrench);
  EXPECT_EQ(wrench.force.norm(), 0.0);
  EXPECT_EQ(wrench.moment.norm(), 0.0);
}

TEST(BallInSocket, RestsStraightAgainstItsLoad) {
  const JointPlay joint = ball(0.0);
  const Vec3 push(30.0, -80.0, 10.0);
  PlayOffsets load = PlayOffsets::Zero();
  load.head<3>() = push;
  const RestingPlay rest = joint.rest_under(load, {}, {});
  EXPECT_LT(rest.motion.e.cross(push).norm(), 1e-15);
  PlayWrench<double> wrench;
  joint.wrench(rest.motion, speeds(1e-3), wrench);
  EXPECT_LT((wrench.force + push).norm(), 1e-9 * push.norm());
  EXPECT_NEAR(rest.normal_force(), push.norm(), 1e-12);
}

// Of every kind: forces without friction and dissipation are the gradient of the energy, the tangent is part of its change, and what
// does not touch does nothing once it is out of reach.
TEST(EveryKindOfPlay, KeepsItsEnergy) {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto& [type, axes] :
       {std::pair{JointType::revolute, JournalAxes::parallel}, std::pair{JointType::revolute, JournalAxes::free},
        std::pair{JointType::cylindrical, JournalAxes::parallel},
        std::pair{JointType::spherical, JournalAxes::parallel}}) {
    ClearanceDescription d = ball_description();
    d.axes = axes;
    d.parameters.axial = 0.1e-3;
    d.parameters.cap_radius = 18e-3;
    d.parameters.sleeve_length = 40e-3;
    const JointPlay joint = JointPlay(d, type, d.parameters).elastic_only();
    int pressing = 0;
    for (int k = 0; k < 100; ++k) {
      PlayOffsets at;
      for (double& x : at) x = 2.2e-4 * uniform(generator);
      at.segment<2>(3) *= axes == JournalAxes::free ? 40.0 : 0.0;
      PlayOffsets along = PlayOffsets::Random();
      along.segment<2>(3) *= axes == JournalAxes::free ? 40.0 : 0.0;
      PlayMotion<double> m = at_rest_at(at);
      m.e_dot = along.head<3>();
      m.slope_rate = along.segment<2>(3);
      m.w.setZero();
      // s' = w x a in the seat: (s_x', s_z') = (-w_z, w_x) where the axis keeps near y; exact through the couple's definition.
      PlayWrench<double> wrench;
      joint.wrench(m, speeds(1e-3), wrench);
      const double h = 1e-9;
      const double change =
          (joint.elastic_energy(at_rest_at(at + h * along)) - joint.elastic_energy(at_rest_at(at - h * along))) /
          (2.0 * h);
      const Vec3 couple = wrench.moment - m.e.cross(wrench.force);
      // The spin that moves the slopes so: w = a x a' / |a|^2 with a = (s_x, 1, s_z), without spin about a.
      const Vec3 a(m.slope[0], 1.0, m.slope[1]), a_rate(m.slope_rate[0], 0.0, m.slope_rate[1]);
      const Vec3 spin = a.cross(a_rate) / a.squaredNorm();
      const double work = wrench.force.dot(m.e_dot) + couple.dot(spin);
      EXPECT_NEAR(-work, change, 1e-5 * (std::abs(change) + 1.0)) << to_string(type);
      pressing += wrench.force.norm() > 0.0;

      JointPlay none = joint;
      none.keep_only({});
      none.wrench(m, speeds(1e-3), wrench);
      EXPECT_EQ(wrench.force.norm(), 0.0) << to_string(type);
    }
    EXPECT_GT(pressing, 20) << to_string(type);
  }
}

TEST(EveryKindOfPlay, IsWhatTheDescriptionAllows) {
  for (const JointType type : {JointType::revolute, JointType::prismatic, JointType::cylindrical, JointType::universal,
                               JointType::spherical, JointType::planar, JointType::fixed})
    EXPECT_EQ(JointPlay::serves({}, type), can_have_play(type)) << to_string(type);
}

}  // namespace ball_in_socket_test
}  // namespace boresight
