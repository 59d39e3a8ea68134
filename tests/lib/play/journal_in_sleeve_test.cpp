#include "boresight/play/journal/journal_in_sleeve.hpp"

#include <gtest/gtest.h>

#include <random>

namespace boresight {
namespace journal_in_sleeve_test {

JournalInSleeve default_joint() {
  ClearanceDescription d;
  d.parameters.radial = d.parameters.axial = 1e-4;
  d.parameters.journal_radius = 10e-3;
  d.parameters.cap_radius = 16e-3;
  d.parameters.sleeve_length = 30e-3;
  d.parameters.friction.coefficient = 0.03;
  return {d, JointType::revolute, d.parameters};
}

const std::array<double, kContactPlaces> kImpactSpeed{0.02, 0.02, 0.02, 0.02, 0.02};

// The same forces by vectors, straight from the equations: normal, contact point, velocity of the journal's material there.
void expected_wrench(const JournalInSleeve& joint, const PlayMotion<double>& m, Vec3& force, Vec3& moment) {
  force.setZero();
  moment.setZero();
  const auto add = [&](const Vec3& point, const Vec3& push, double normal_force) {
    const Vec3 v = m.e_dot + m.w.cross(point - m.e);
    const Vec3 sliding = v - v.dot(push) * push;
    const Vec3 f = normal_force * push - normal_force * joint.friction.force_per_velocity(sliding.norm()) * sliding;
    force += f;
    moment += point.cross(f);
  };
  const Vec3 radial(m.e.x(), 0.0, m.e.z());
  const Vec3 n = radial.normalized();
  const double d = radial.norm() - joint.radial_clearance;
  if (d > 0.0) add(joint.bore_radius * n, -n, joint.radial_law.force(d, m.e_dot.dot(n), kImpactSpeed[0]));
  for (double side : {-1.0, 1.0}) {
    const double depth = -side * m.e.y() - joint.axial_clearance;
    if (depth > 0.0) add(Vec3(0, side * joint.half_length, 0), Vec3(0, side, 0), joint.face_stiffness * depth);
  }
}

TEST(JournalInSleeve, ForcesAreThoseOfTheVectorEquations) {
  const JournalInSleeve joint = default_joint();
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int touching = 0;
  for (int k = 0; k < 1000; ++k) {
    PlayMotion<double> m;
    m.e = 1.4e-4 * Vec3(uniform(generator), uniform(generator), uniform(generator));
    m.e_dot = 0.01 * Vec3(uniform(generator), uniform(generator), uniform(generator));
    m.w = Vec3(0.0, 5.0 * uniform(generator), 0.0);  // parallel axes: the spin is along the axis
    PlayWrench<double> wrench;
    joint.wrench(m, kImpactSpeed, wrench);
    Vec3 force, moment;
    expected_wrench(joint, m, force, moment);
    touching += force.norm() > 0.0;
    EXPECT_LT((wrench.force - force).norm(), 1e-11 * (1.0 + force.norm()));
    EXPECT_LT((wrench.moment - moment).norm(), 1e-11 * (1.0 + moment.norm()));
  }
  EXPECT_GT(touching, 300);
}

TEST(JournalInSleeve, AConcentricJournalFeelsNothing) {
  PlayMotion<double> m{Vec3::Zero(), Vec3::Zero(), Vec3(0, 100, 0)};
  PlayWrench<double> wrench;
  default_joint().wrench(m, kImpactSpeed, wrench);
  EXPECT_EQ(wrench.force, Vec3::Zero());
  EXPECT_EQ(wrench.moment, Vec3::Zero());
}

TEST(JournalInSleeve, SpinRubsInContinuousContact) {
  // The journal rests against the bore and turns on the spot: friction drives it round against its spin.
  PlayMotion<double> m{Vec3(1.1e-4, 0, 0), Vec3::Zero(), Vec3(0, 10, 0)};
  PlayWrench<double> wrench;
  const JournalInSleeve joint = default_joint();
  joint.wrench(m, kImpactSpeed, wrench);
  const double normal = wrench.contact[static_cast<int>(ContactPlace::radial)].normal_force;
  EXPECT_NEAR(wrench.moment.y(), -0.03 * normal * joint.bore_radius, 1e-12 * normal);
}

TEST(JournalInSleeve, ACylindricalJointHasNoEndFaces) {
  ClearanceDescription d;
  d.parameters.radial = 1e-4;
  d.parameters.journal_radius = 10e-3;
  const JournalInSleeve joint(d, JointType::cylindrical, d.parameters);
  PlayMotion<double> m{Vec3(0, 0.5, 0), Vec3::Zero(), Vec3::Zero()};
  PlayWrench<double> wrench;
  joint.wrench(m, kImpactSpeed, wrench);
  EXPECT_EQ(wrench.force, Vec3::Zero());
}

}  // namespace journal_in_sleeve_test
}  // namespace boresight
