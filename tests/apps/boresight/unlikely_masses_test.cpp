// What check says of moments of inertia in another unit than was meant.
#include "check/unlikely_masses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace boresight {
namespace unlikely_masses_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// An arm of 12 kg, hinged half a metre from its centre of mass.
std::vector<std::string> of_an_arm(double inertia) {
  MechanismDescription m;
  m.name = "arm";
  BodyDescription arm;
  arm.name = "arm";
  arm.mass = 12.0;
  arm.center_of_mass = Vec3(0.5, 0.0, 0.0);
  arm.inertia = Vec3(inertia, inertia, 0.5 * inertia).asDiagonal();
  arm.boresight = Vec3::UnitX();
  m.bodies.push_back(arm);
  JointDescription hinge;
  hinge.name = "hinge";
  hinge.first = kGround;
  hinge.second = 0;
  hinge.axis = Vec3::UnitZ();
  m.joints.push_back(hinge);
  return app::unlikely_inertias(Mechanism(std::move(m)));
}

TEST(UnlikelyInertias, AreThoseOfAnotherUnit) {
  EXPECT_THAT(of_an_arm(0.3), IsEmpty());
  EXPECT_THAT(of_an_arm(0.3e6),
              ElementsAre(AllOf(HasSubstr("inertia of \"arm\""), HasSubstr("gyration of 158"), HasSubstr("unit"))));
  EXPECT_THAT(of_an_arm(0.3e-6), ElementsAre(AllOf(HasSubstr("inertia of \"arm\""), HasSubstr("centre of mass"))));
}

TEST(UnlikelyInertias, AreNoneOfABobOnAnArmNorOfAPointMass) {
  EXPECT_THAT(of_an_arm(12.0 * 0.4 * 0.01 * 0.01), IsEmpty());
  EXPECT_THAT(of_an_arm(1e-12), IsEmpty());
}

}  // namespace unlikely_masses_test
}  // namespace boresight
