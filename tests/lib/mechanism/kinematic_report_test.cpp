// What `check` says of a drawing that leaves no motion by a rounding.
#include "boresight/mechanism/kinematic_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.hpp"

namespace boresight {
namespace kinematic_report_test {

// One shaft in two bearings, the second one `off` beside the axis of the first.
Mechanism shaft(double off) {
  MechanismDescription m;
  BodyDescription body;
  body.name = "shaft";
  body.mass = 1.0;
  body.inertia = Vec3(0.01, 0.01, 0.002).asDiagonal();
  body.center_of_mass = Vec3(0.0, 0.0, 0.05);
  body.boresight = Vec3::UnitX();
  m.bodies.push_back(body);
  for (int k = 0; k < 2; ++k) {
    JointDescription j;
    j.name = k == 0 ? "lower" : "upper";
    j.first = kGround;
    j.second = 0;
    j.point = Vec3(k * off, 0.0, 0.1 * k);
    j.axis = Vec3::UnitZ();
    j.driven = k == 0;
    m.joints.push_back(j);
  }
  m.motion.drives[0] = parse_expression("sin(t)");
  return Mechanism(std::move(m));
}

TEST(KinematicReport, NamesBodiesThatNoJointsHold) {
  MechanismDescription m = shaft(0.0).description();
  for (const char* name : {"cart", "wheel"}) {
    m.bodies.push_back(m.bodies.front());
    m.bodies.back().name = name;
    m.bodies.back().boresight.reset();
  }
  JointDescription axle = m.joints.front();
  axle.name = "axle";
  axle.first = 1;
  axle.second = 2;
  axle.driven = false;
  m.joints.push_back(axle);
  const std::vector<std::string> found = analyse_kinematics(Mechanism(std::move(m)), 11).findings;
  EXPECT_NE(std::find(found.begin(), found.end(),
                      "no chain of joints leads from \"cart\", \"wheel\" to the ground: such a body flies freely"),
            found.end());
  for (const std::string& finding : analyse_kinematics(shaft(0.0), 11).findings)
    EXPECT_EQ(finding.find("no chain of joints"), std::string::npos) << finding;
}

TEST(KinematicReport, NamesBearingsThatDoNotQuiteShareAnAxis) {
  EXPECT_TRUE(analyse_kinematics(shaft(0.0), 11).feasible);
  const KinematicReport off = analyse_kinematics(shaft(1e-5), 11);
  EXPECT_FALSE(off.feasible);
  ASSERT_FALSE(off.findings.empty());
  EXPECT_NE(off.findings[0].find("\"lower\" and \"upper\""), std::string::npos) << off.findings[0];
  EXPECT_NE(off.findings[0].find("1e-05 m"), std::string::npos) << off.findings[0];
}

TEST(KinematicReport, SaysThatNothingCanMove) {
  const auto locked = [](double aslant) {
    MechanismDescription m = scenes::four_bar({{0, 0, 0}, {0, 0, 1}, {2, 0, 1.5}, {2.5, 0, 0}}, true, "t");
    m.joints[2].axis = Vec3(aslant, 1.0, 0.0).normalized();
    m.joints[0].driven = false;
    m.motion.drives.clear();
    const std::vector<std::string> found = analyse_kinematics(Mechanism(std::move(m)), 11).findings;
    return std::any_of(found.begin(), found.end(),
                       [](const std::string& s) { return s.find("nothing can move") != std::string::npos; });
  };
  EXPECT_TRUE(locked(0.02));
  EXPECT_FALSE(locked(0.0));
}

}  // namespace kinematic_report_test
}  // namespace boresight
