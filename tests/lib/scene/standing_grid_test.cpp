// The table of what standing errors do: where no grid holds it, the refusal names the error that asks for more, and when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "boresight/mechanism/motion_density.hpp"
#include "boresight/scene/standing_errors.hpp"
#include "error_scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace standing_grid_test {

using testing::AllOf;
using testing::HasSubstr;

// A table that turns by 0.8 sin(6 t) and errs by `law`, beside so many errors of one radian.
Mechanism turntable(const std::string& law, int others) {
  MechanismDescription m;
  m.name = "turntable";
  const int table = scenes::add_body(m, "table", 4.0, {0.1, 0.0, 0.2}, Vec3::Zero());
  const int head = scenes::add_body(m, "head", 1.0, {0.2, 0.1, 0.4}, Vec3::Zero());
  m.bodies[table].boresight.reset();
  m.bodies[head].boresight = Vec3::UnitX();
  m.joints[scenes::add_joint(m, JointType::revolute, kGround, table, Vec3::Zero(), Vec3::UnitZ(),
                             scenes::sine(0.8, 6.0))]
      .name = "A";
  m.joints[scenes::add_joint(m, JointType::revolute, table, head, {0.0, 0.0, 0.3}, Vec3::UnitY(),
                             scenes::sine(0.5, 8.0))]
      .name = "E";
  m.motion.duration = 0.2;
  for (int i = 0; i < others; ++i) m.errors.push_back(scenes::drive_error(m, "E", "1"));
  m.errors.push_back(scenes::drive_error(m, "A", law));
  m.errors.back().name = "encoder";
  return Mechanism(std::move(m));
}

std::string refusal_of(const Mechanism& mechanism) {
  const IdealMotion ideal = IdealMotion::kinematic(mechanism);
  try {
    StandingErrors::of_all(mechanism, ideal);
  } catch (const MotionTooDense& refusal) {
    return std::string("the motion is blamed: ") + refusal.what();
  } catch (const ComputationError& refusal) {
    return refusal.what();
  }
  return "no refusal";
}

TEST(StandingGrid, NamesTheErrorWhoseLawNoGridFollowsAndWhen) {
  // Through 0.4 rad at t = asin(0.5) / 6.
  EXPECT_THAT(refusal_of(turntable("tanh((q - 0.4)/1e-9)", 1)),
              AllOf(HasSubstr("what error.encoder does to the pose changes within "), HasSubstr(" s at t = 0.0872"),
                    HasSubstr("as its law does there")));
}

TEST(StandingGrid, NamesTheErrorThatChangesTooFastForATableOfSoManyErrors) {
  EXPECT_THAT(refusal_of(turntable("sin(q/1e-6)", 200)),
              AllOf(HasSubstr("error.encoder changes within "), HasSubstr("the multibody rung needs no table")));
}

TEST(StandingGrid, HoldsARippleOfAHundredPeriods) {
  EXPECT_EQ(refusal_of(turntable("sin(2*pi*q/1e-2)", 1)), "no refusal");
}

}  // namespace standing_grid_test
}  // namespace boresight
