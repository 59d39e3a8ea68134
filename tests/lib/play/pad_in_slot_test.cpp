// A pad in its slot against the equations of its two contacts, the gradient of its energy, and its rest against closed forms.
#include "boresight/play/pad/pad_in_slot.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "boresight/contact/hertz.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace pad_in_slot_test {

constexpr double kGap = 0.05e-3, kRadius = 30e-3;

ClearanceDescription description(JournalAxes axes, const char* law = "flores", double friction = 0.0) {
  ClearanceDescription d;
  d.contact_law = law;
  d.axes = axes;
  d.parameters.axial = kGap;
  d.parameters.pad_radius = kRadius;
  d.parameters.contact.restitution = 0.7;
  d.parameters.friction.coefficient = friction;
  return d;
}

JointPlay pad(JournalAxes axes, const char* law = "flores", double friction = 0.0) {
  const ClearanceDescription d = description(axes, law, friction);
  return JointPlay(d, JointType::planar, d.parameters);
}

ImpactSpeeds<double> speeds(double v) {
  ImpactSpeeds<double> all;
  all.fill(v);
  return all;
}

// Its slope's rate is that of its normal, which turns with it.
void turn_with_spin(PlayMotion<double>& m) {
  const Vec3 a(m.slope[0], 1.0, m.slope[1]), a_dot = m.w.cross(a);
  m.slope_rate = {a_dot.x() - a_dot.y() * m.slope[0], a_dot.z() - a_dot.y() * m.slope[1]};
}

// Anywhere that it can be, half of the time touching one face or both, at any speed.
PlayMotion<double> anywhere(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3(uniform(generator), uniform(generator), uniform(generator)); };
  PlayMotion<double> m;
  m.e = Vec3(0.2 * uniform(generator), 1.1 * kGap * uniform(generator), 0.2 * uniform(generator));
  m.e_dot = 0.02 * vector();
  m.w = 0.5 * vector();
  m.slope = 1.2 * kGap / kRadius * Vec2T<double>(uniform(generator), uniform(generator));
  turn_with_spin(m);
  return m;
}

double power(const PlayWrench<double>& wrench, const PlayMotion<double>& m) {
  return wrench.force.dot(m.e_dot) + (wrench.moment - m.e.cross(wrench.force)).dot(m.w);
}

PlayMotion<double> later(PlayMotion<double> m, double dt) {
  m.e += dt * m.e_dot;
  m.slope += dt * m.slope_rate;
  return m;
}

TEST(PadInSlot, StiffnessIsThatOfAFlatPunch) {
  const ClearanceDescription d = description(JournalAxes::free);
  EXPECT_NEAR(pad(JournalAxes::free).normal_law().stiffness / (2.0 * kRadius * composite_modulus(d.parameters.contact)),
              1.0, 1e-14);
}

TEST(PadInSlot, AParallelPadIsPressedOverItsWholeFace) {
  const JointPlay law = pad(JournalAxes::parallel, "flores", 0.2);
  const ClearanceDescription d = description(JournalAxes::parallel);
  const double K = pad_stiffness(d.parameters), h = 8.0 * 0.3 / (5.0 * 0.7), depth = 2e-6, rate = 0.01, v0 = 0.03;
  for (const int side : {-1, 1}) {
    PlayMotion<double> m{{0.1, side * (kGap + depth), -0.2}, {0.3, side * rate, -0.4}, {0.0, 2.0, 0.0}};
    PlayWrench<double> wrench;
    law.wrench(m, speeds(v0), wrench);
    const double F = K * depth * (1.0 + h * rate / v0);
    EXPECT_NEAR(wrench.force.y(), -side * F, 1e-12 * F);
    // Rubs at its centre, against its sliding; what turns it about its normal does not.
    EXPECT_NEAR(wrench.force.x(), -0.2 * F * 0.6, 1e-12 * F);
    EXPECT_NEAR(wrench.force.z(), 0.2 * F * 0.8, 1e-12 * F);
    EXPECT_NEAR((wrench.moment - m.e.cross(wrench.force)).y(), 0.0, 1e-12 * F);
    const ContactPlace place = side < 0 ? ContactPlace::axial_minus : ContactPlace::axial_plus;
    EXPECT_NEAR(wrench.contact[static_cast<int>(place)].normal_force, F, 1e-12 * F);
    EXPECT_EQ(wrench.contact[static_cast<int>(ContactPlace::radial)].penetration, -1.0);
  }
}

TEST(PadInSlot, ElasticForcesTakeFromTheEnergyWhatTheyGive) {
  std::mt19937 generator(7);
  const JointPlay law = pad(JournalAxes::free, "hertz");
  int touching = 0, both = 0;
  for (int k = 0; k < 2000; ++k) {
    const PlayMotion<double> m = anywhere(generator);
    PlayWrench<double> wrench;
    law.wrench(m, speeds(0.01), wrench);
    if (wrench.force.isZero() && wrench.moment.isZero()) continue;
    ++touching;
    both += wrench.contact[3].normal_force > 0.0 && wrench.contact[4].normal_force > 0.0;
    const double dt = 2e-9;
    const double fed = (law.elastic_energy(later(m, dt)) - law.elastic_energy(later(m, -dt))) / (2.0 * dt);
    const double size = wrench.contact[3].normal_force + wrench.contact[4].normal_force;
    EXPECT_NEAR(power(wrench, m), -fed, 1e-6 * size * 0.05) << k;
  }
  EXPECT_GT(touching, 500);
  EXPECT_GT(both, 50);
}

// Whatever the tilt and whichever part of the rim closes or parts.
TEST(PadInSlot, DampingNeverGivesPower) {
  std::mt19937 generator(11);
  for (const char* name : {"flores", "exact", "kelvin-voigt"}) {
    ClearanceDescription d = description(JournalAxes::free, name);
    d.parameters.contact.linear_stiffness = 2e8;
    d.parameters.contact.linear_damping = 300.0;
    const JointPlay law(d, JointType::planar, d.parameters), elastic = law.elastic_only();
    for (int k = 0; k < 1000; ++k) {
      const PlayMotion<double> m = anywhere(generator);
      PlayWrench<double> with, without;
      law.wrench(m, speeds(0.01), with);
      elastic.wrench(m, speeds(0.01), without);
      for (const int place : {3, 4}) EXPECT_GE(with.contact[place].normal_force, 0.0);
      EXPECT_LE(power(with, m), power(without, m) + 1e-9 * std::abs(power(without, m))) << name << ' ' << k;
    }
  }
}

// The load balances what the contacts give, pressed on one face, on its edge, or jammed between both.
TEST(PadInSlot, RestsWhereItsLoadIsBalanced) {
  const JointPlay law = pad(JournalAxes::free);
  for (const double force : {-3000.0, -10.0, 0.0, 800.0})
    for (const double share : {0.0, 0.2, 0.5, 0.8, 0.99, 1.5, 40.0}) {
      PlayOffsets load = PlayOffsets::Zero();
      load[1] = force;
      load.segment<2>(3) = share * std::max(10.0, std::abs(force)) * kRadius * Vec2T<double>(0.6, -0.8);
      if (load.isZero()) continue;
      const RestingPlay rest = law.rest_under(load, {}, {});
      PlayWrench<double> wrench;
      law.elastic_only().wrench(rest.motion, speeds(1.0), wrench);
      const double size = load.head<3>().norm() + load.segment<2>(3).norm() / kRadius;
      EXPECT_NEAR(wrench.force.y() + force, 0.0, 1e-7 * size) << force << ' ' << share;
      const Vec3 couple = moment_of_couple(load[3], load[4], rest.motion);
      EXPECT_LT((wrench.moment - rest.motion.e.cross(wrench.force) + couple).norm() / kRadius, 1e-7 * size)
          << force << ' ' << share;
    }
}

TEST(PadInSlot, WithoutLoadStaysWhereItWas) {
  const JointPlay law = pad(JournalAxes::free);
  RestingPlay before;
  before.motion.e.y() = 0.4 * kGap;
  before.motion.slope = {0.2 * kGap / kRadius, 0.1 * kGap / kRadius};
  const RestingPlay rest = law.rest_under(PlayOffsets::Zero(), {}, before);
  EXPECT_EQ(rest.motion.e, before.motion.e);
  EXPECT_EQ(rest.motion.slope, before.motion.slope);
}

// Second differences of the energy, where the tilt and so the direction in which it grows stay.
TEST(PadInSlot, TangentIsTheCurvatureOfItsEnergy) {
  const JointPlay law = pad(JournalAxes::free, "hertz");
  for (const double share : {0.3, 0.9}) {
    PlayOffsets load = PlayOffsets::Zero();
    load << 0.0, 500.0, 0.0, 500.0 * share * kRadius, 0.0, 0.0;
    const PlayMotion<double> m = law.rest_under(load, {}, {}).motion;
    const ContactTangent tangent = law.tangent(m);
    Eigen::Matrix<double, kMostOffsets, kMostOffsets> K;
    K.setZero();
    for (int i = 0; i < tangent.count; ++i) K += tangent.column[i].n * tangent.column[i].n.transpose();
    for (const int k : {1, 3}) {
      const double h = (k == 1 ? 1.0 : 1.0 / kRadius) * 1e-9;
      PlayOffsets d = PlayOffsets::Zero();
      d[k] = h;
      const PlayOffsets o = offsets_of(m);
      const double curvature = (law.elastic_energy(at_rest_at(o + d)) - 2.0 * law.elastic_energy(m) +
                                law.elastic_energy(at_rest_at(o - d))) /
                               (h * h);
      EXPECT_NEAR(K(k, k) / curvature, 1.0, 1e-3) << share << ' ' << k;
    }
  }
}

}  // namespace pad_in_slot_test
}  // namespace boresight
