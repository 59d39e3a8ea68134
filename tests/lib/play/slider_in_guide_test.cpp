// A slider in its guide against the equations of its contacts, the gradient of its energy, and its rest against closed forms.
#include "boresight/play/guide/slider_in_guide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "boresight/contact/hertz.hpp"
#include "boresight/play/flat_face_stiffness.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace slider_in_guide_test {

constexpr double kWidthGap = 0.05e-3, kHeightGap = 0.03e-3, kWidth = 40e-3, kHeight = 24e-3, kLength = 60e-3;

ClearanceDescription description(JournalAxes axes, const char* law = "flores", double friction = 0.0) {
  ClearanceDescription d;
  d.contact_law = law;
  d.axes = axes;
  d.guide = GuideShape::rectangular;
  d.parameters.width = kWidth;
  d.parameters.height = kHeight;
  d.parameters.length = kLength;
  d.parameters.width_gap = kWidthGap;
  d.parameters.height_gap = kHeightGap;
  d.parameters.contact.restitution = 0.7;
  d.parameters.friction.coefficient = friction;
  return d;
}

JointPlay slider(JournalAxes axes, const char* law = "flores", double friction = 0.0) {
  const ClearanceDescription d = description(axes, law, friction);
  return JointPlay(d, JointType::prismatic, d.parameters);
}

ImpactSpeeds<double> speeds(double v) {
  ImpactSpeeds<double> all;
  all.fill(v);
  return all;
}

// Its slope's rate is that of its axis, which turns with it.
void turn_with_spin(PlayMotion<double>& m) {
  const Vec3 a(m.slope[0], 1.0, m.slope[1]), a_dot = m.w.cross(a);
  m.slope_rate = {a_dot.x() - a_dot.y() * m.slope[0], a_dot.z() - a_dot.y() * m.slope[1]};
}

// Anywhere that it can be, most of the time touching a face or several, at any speed.
PlayMotion<double> anywhere(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3(uniform(generator), uniform(generator), uniform(generator)); };
  PlayMotion<double> m;
  m.e = Vec3(0.8 * kWidthGap * uniform(generator), 0.2 * uniform(generator), 0.8 * kHeightGap * uniform(generator));
  m.e_dot = 0.02 * vector();
  m.w = 0.5 * vector();
  m.slope = {kWidthGap / kLength * uniform(generator), kHeightGap / kLength * uniform(generator)};
  m.roll = 0.8 * kHeightGap / kWidth * uniform(generator);
  turn_with_spin(m);
  return m;
}

double power(const PlayWrench<double>& wrench, const PlayMotion<double>& m) {
  return wrench.force.dot(m.e_dot) + (wrench.moment - m.e.cross(wrench.force)).dot(m.w);
}

PlayMotion<double> later(PlayMotion<double> m, double dt) {
  m.e += dt * m.e_dot;
  m.slope += dt * m.slope_rate;
  m.roll += dt * m.w.dot(roll_axis(m));
  return m;
}

double force_of(const PlayWrench<double>& wrench) {
  double sum = 0.0;
  for (const ContactState<double>& c : wrench.contact) sum += c.normal_force;
  return sum;
}

TEST(EdgeContact, IsTheSumAlongTheEdge) {
  constexpr int kParts = 200000;
  for (const double depth : {2e-6, 0.5e-6, -0.7e-6, -3e-6})
    for (const double swing : {0.0, 1e-6}) {
      double force = 0.0, moment = 0.0, energy = 0.0;
      for (int i = 0; i < kParts; ++i) {
        const double s = -1.0 + (2.0 * i + 1.0) / kParts, d = depth + swing * s;
        if (d <= 0.0) continue;
        force += 1e8 * d / kParts;
        moment += 1e8 * d * s / kParts;
        energy += 0.5e8 * d * d / kParts;
      }
      const EdgeForce<double> edge = edge_contact(1e8, depth, swing);
      EXPECT_NEAR(edge.force, force, 1e-4) << depth << ' ' << swing;
      EXPECT_NEAR(edge.force * edge.moment_arm, moment, 1e-4) << depth << ' ' << swing;
      EXPECT_NEAR(edge.energy, energy, 1e-9) << depth << ' ' << swing;
    }
}

// King (1987): a rigid square punch, 2 / sqrt(pi) 1.012 E_s a.
TEST(SliderInGuide, StiffnessIsThatOfAFlatRectangularPunch) {
  const ContactParameters contact;
  const double a = 30e-3, square = flat_face_stiffness(contact, a, a) / (composite_modulus(contact) * a);
  EXPECT_NEAR(square / (2.0 / std::sqrt(std::numbers::pi) * 1.012), 1.0, 0.01);
  EXPECT_DOUBLE_EQ(flat_face_stiffness(contact, a, 2.0 * a), flat_face_stiffness(contact, 2.0 * a, a));
}

TEST(SliderInGuide, AParallelSliderIsPressedOverAWholeFace) {
  const JointPlay law = slider(JournalAxes::parallel, "flores", 0.2);
  const ClearanceDescription d = description(JournalAxes::parallel);
  const double h = 8.0 * 0.3 / (5.0 * 0.7), depth = 2e-6, rate = 0.01, v0 = 0.03;
  const double Kx = flat_face_stiffness(d.parameters.contact, kLength, kHeight),
               Kz = flat_face_stiffness(d.parameters.contact, kLength, kWidth);
  for (const int side : {-1, 1}) {
    PlayMotion<double> m{{side * (kWidthGap + depth), 0.1, 0.0}, {side * rate, -0.4, 0.3}, {0.0, 0.0, 0.0}};
    PlayWrench<double> wrench;
    law.wrench(m, speeds(v0), wrench);
    const double F = Kx * depth * (1.0 + h * rate / v0);
    EXPECT_NEAR(wrench.force.x(), -side * F, 1e-12 * F);
    EXPECT_NEAR(wrench.force.y(), 0.2 * F * 0.8, 1e-12 * F);
    EXPECT_NEAR(wrench.force.z(), -0.2 * F * 0.6, 1e-12 * F);
    m = {{0.0, 0.1, side * (kHeightGap + depth)}, {0.0, 0.0, side * rate}, {0.0, 0.0, 0.0}};
    law.wrench(m, speeds(v0), wrench);
    EXPECT_NEAR(wrench.force.z(), -side * Kz * depth * (1.0 + h * rate / v0), 1e-10 * F);
  }
}

TEST(SliderInGuide, ElasticForcesTakeFromTheEnergyWhatTheyGive) {
  std::mt19937 generator(7);
  const JointPlay law = slider(JournalAxes::free, "hertz");
  int touching = 0, several = 0;
  for (int k = 0; k < 4000; ++k) {
    const PlayMotion<double> m = anywhere(generator);
    PlayWrench<double> wrench;
    law.wrench(m, speeds(0.01), wrench);
    int contacts = 0;
    for (const ContactState<double>& c : wrench.contact) contacts += c.normal_force > 0.0;
    if (!(force_of(wrench) > 0.1)) continue;  // shallower than what the difference steps over
    ++touching;
    several += contacts > 1;
    const double dt = 2e-9;
    const double fed = (law.elastic_energy(later(m, dt)) - law.elastic_energy(later(m, -dt))) / (2.0 * dt);
    EXPECT_NEAR(power(wrench, m), -fed, 1e-6 * force_of(wrench) * 0.05) << k;
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(several, 200);
}

// What damping takes it never gives back, and friction never drives.
TEST(SliderInGuide, OnlyLosesEnergy) {
  std::mt19937 generator(9);
  const JointPlay law = slider(JournalAxes::free, "flores", 0.3), elastic = law.elastic_only();
  for (int k = 0; k < 4000; ++k) {
    const PlayMotion<double> m = anywhere(generator);
    PlayWrench<double> whole, lossless;
    law.wrench(m, speeds(0.5), whole);
    elastic.wrench(m, speeds(0.5), lossless);
    EXPECT_LE(power(whole, m), power(lossless, m) + 1e-9 * force_of(lossless)) << k;
  }
}

// Its tangent is what its force changes by.
TEST(SliderInGuide, TangentIsTheForcesChange) {
  std::mt19937 generator(11);
  const ClearanceDescription d = description(JournalAxes::free, "hertz");
  const SliderInGuide law(d, JointType::prismatic, d.parameters);
  for (int k = 0; k < 500; ++k) {
    PlayMotion<double> m = anywhere(generator);
    m.e_dot.setZero();
    m.w.setZero();
    m.slope_rate.setZero();
    Eigen::Matrix<double, kMostOffsets, kMostOffsets> K = Eigen::Matrix<double, kMostOffsets, kMostOffsets>::Zero(), by;
    const ContactTangent tangent = law.tangent(m);
    for (int i = 0; i < tangent.count; ++i) K += tangent.column[i].n * tangent.column[i].n.transpose();
    for (int j = 0; j < kMostOffsets; ++j) {
      const double h = j < 3 ? 1e-10 : 1e-9;
      PlayOffsets to = PlayOffsets::Zero();
      to[j] = h;
      by.col(j) =
          (law.elastic_force(at_rest_at(offsets_of(m) + to)) - law.elastic_force(at_rest_at(offsets_of(m) - to))) /
          (2.0 * h);
    }
    EXPECT_LT((K + by).norm(), 1e-3 * (1.0 + K.norm())) << k;
  }
}

// Under a load it rests where its contacts carry it.
TEST(SliderInGuide, RestsInBalance) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const ClearanceDescription d = description(JournalAxes::free, "hertz");
  const SliderInGuide law(d, JointType::prismatic, d.parameters);
  for (int k = 0; k < 300; ++k) {
    PlayOffsets load;
    load << 200.0 * uniform(generator), 0.0, 200.0 * uniform(generator), 8.0 * uniform(generator),
        8.0 * uniform(generator), 4.0 * uniform(generator);
    if (k % 3 == 0) load[5] = 0.0;
    if (k % 4 == 0) load[3] = 0.0;
    const RestingPlay rest = law.rest_under(load, {.slide = 0.1}, {});
    PlayOffsets left = load + law.elastic_force(rest.motion);
    left.tail<3>() /= 0.5 * kLength;
    EXPECT_LT(left.norm(), 1e-6 * load.norm()) << k;
    EXPECT_DOUBLE_EQ(rest.motion.e.y(), 0.1);
  }
}

// A torque about the axis rolls it until opposite edges touch; which faces, its narrower room for the roll decides.
TEST(SliderInGuide, RollsAsFarAsItsGapsLeaveIt) {
  ClearanceDescription d = description(JournalAxes::free, "hertz");
  d.parameters.contact.stiffness_scale = 1e4;
  const SliderInGuide law(d, JointType::prismatic, d.parameters);
  PlayOffsets load = PlayOffsets::Zero();
  load[5] = 1.0;
  const RestingPlay rest = law.rest_under(load, {}, {});
  EXPECT_NEAR(rest.motion.roll / std::min(kWidthGap / (0.5 * kHeight), kHeightGap / (0.5 * kWidth)), 1.0, 1e-3);
  EXPECT_GT(rest.contact[static_cast<int>(ContactPlace::height_plus_front)].normal_force, 0.0);
  EXPECT_GT(rest.contact[static_cast<int>(ContactPlace::height_minus_rear)].normal_force, 0.0);
  EXPECT_EQ(rest.contact[static_cast<int>(ContactPlace::width_plus_front)].normal_force, 0.0);
}

}  // namespace slider_in_guide_test
}  // namespace boresight
