// What a mechanism file becomes.
#include "boresight/io/mechanism_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace boresight {
namespace mechanism_file_test {

const std::string kExamples = BORESIGHT_EXAMPLES;

MechanismDescription default_scene(const std::vector<Setting>& settings = {}) {
  return read_mechanism(kExamples + "/3-rrcpr/3-rrcpr.toml", settings);
}

int joint(const MechanismDescription& m, const std::string& name) {
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    if (m.joints[j].name == name) return static_cast<int>(j);
  }
  return -1;
}

int body(const MechanismDescription& m, const std::string& name) {
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    if (m.bodies[b].name == name) return static_cast<int>(b);
  }
  return -1;
}

TEST(DefaultScene, HasThirteenBodiesAndFifteenJointsOfWhichSixAreDriven) {
  const MechanismDescription m = default_scene();
  EXPECT_EQ(m.bodies.size(), 13u);
  EXPECT_EQ(m.joints.size(), 15u);
  int driven = 0;
  for (const auto& j : m.joints) driven += j.driven;
  EXPECT_EQ(driven, 6);
  EXPECT_EQ(m.gravity, Vec3(0, 0, -9.81));
  EXPECT_EQ(m.motion.duration, 1.0);
  EXPECT_EQ(m.content_hash.size(), 32u);
}

TEST(DefaultScene, HasAAxesAtRightAnglesToEachOtherAndLegsOfTheStatedLength) {
  const MechanismDescription m = default_scene();
  for (int i = 1; i <= 3; ++i) {
    const std::string n = std::to_string(i), k = std::to_string(i % 3 + 1);
    const auto& a = m.joints[joint(m, "A" + n)];
    EXPECT_NEAR(a.axis.dot(m.joints[joint(m, "A" + k)].axis), 0.0, 1e-15);
    EXPECT_LT(a.axis.z(), 0.0);
    EXPECT_NEAR(a.axis.dot(m.joints[joint(m, "B" + n)].axis), 0.0, 1e-15);
    const Vec3 leg = m.joints[joint(m, "F" + n)].point - m.joints[joint(m, "C" + n)].point;
    EXPECT_NEAR(leg.norm(), 0.5671453287025843, 1e-14);
    EXPECT_NEAR(leg.normalized().dot(m.joints[joint(m, "P" + n)].axis), 1.0, 1e-15);
    const auto& rod = m.bodies[body(m, "rod" + n)];
    EXPECT_NEAR((rod.axes.col(2) - leg.normalized()).norm(), 0.0, 1e-14);
    EXPECT_NEAR((rod.axes.col(1) - m.joints[joint(m, "F" + n)].axis).norm(), 0.0, 1e-14);
    EXPECT_NEAR((rod.axes.transpose() * rod.axes - Mat3::Identity()).norm(), 0.0, 1e-14);
    EXPECT_NEAR(rod.axes.determinant(), 1.0, 1e-14);
    const auto& crank = m.bodies[body(m, "crank" + n)];
    EXPECT_NEAR((crank.axes.col(0) - a.axis).norm(), 0.0, 1e-14);
    EXPECT_NEAR((m.bodies[body(m, "carriage" + n)].axes.col(0) - a.axis).norm(), 0.0, 1e-14);
  }
}

TEST(DefaultScene, HasTheClearanceAndThePoseLawOfTheStudy) {
  const MechanismDescription m = default_scene();
  ASSERT_EQ(m.clearances.size(), 1u);
  const auto& c = m.clearances[0];
  EXPECT_EQ(m.joints[c.joint].name, "F1");
  EXPECT_EQ(m.bodies[c.journal].name, "rod1");
  EXPECT_DOUBLE_EQ(c.parameters.radial, 1e-4);
  EXPECT_DOUBLE_EQ(c.parameters.sleeve_length, 0.03);
  EXPECT_DOUBLE_EQ(c.parameters.contact.young[1], 72e9);
  EXPECT_EQ(c.parameters.friction.coefficient, 0.03);
  ASSERT_TRUE(m.motion.pose.has_value());
  const auto& pose = *m.motion.pose;
  EXPECT_EQ(pose.sequence, (std::array<int, 3>{2, 1, 2}));
  const double t = 0.3, s = std::sin(std::numbers::pi * t), psi = 2 * std::numbers::pi * s,
               theta = std::numbers::pi / 6 * s;
  EXPECT_NEAR(pose.angle[0]->at(t).value, psi, 1e-14);
  EXPECT_NEAR(pose.position[0]->at(t).value, 0.5 * std::sin(theta) * std::cos(psi), 1e-15);
  EXPECT_NEAR(pose.position[2]->at(t).value, 0.5 * std::cos(theta) + 0.005 * s, 1e-15);
}

}  // namespace mechanism_file_test
}  // namespace boresight
