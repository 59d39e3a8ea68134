// What is said of joints that do not close: which ones, wherever the error is.
#include "boresight/mechanism/strained_joints.hpp"

#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_influence.hpp"
#include "error_scenes.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace strained_joints_test {

using Kind = ErrorDescription::Kind;

// Four hinges with axes that are parallel as drawn, without play, beside a pendulum that nothing strains.
MechanismDescription four_bar() {
  MechanismDescription m = read_mechanism(BORESIGHT_EXAMPLES "/four-bar/planar.toml", {});
  m.clearances.clear();
  const int arm = scenes::add_body(m, "arm", 1.0, {0.5, 0.0, 0.0}, Vec3::Zero());
  m.bodies[arm].boresight.reset();
  const int hinge =
      scenes::add_joint(m, JointType::revolute, kGround, arm, {0.4, 0.0, 0.0}, Vec3::UnitY(), scenes::sine(0.1, 3.0));
  m.joints[hinge].name = "beside";
  return m;
}

void expect_whole_loop(const std::string& refusal, const std::string& what) {
  EXPECT_NE(refusal.find("joints \"A\", \"B\", \"C\" and \"D\" do not close"), std::string::npos) << what << refusal;
}

TEST(StrainedJoints, AreAllOfTheLoopWhicheverOfThemIsAskew) {
  for (const auto& [joint, body] :
       {std::pair{"A", "crank"}, std::pair{"B", "crank"}, std::pair{"C", "coupler"}, std::pair{"D", "rocker"}})
    for (const auto& [kind, way] :
         {std::pair{Kind::rotation, Vec3(Vec3::UnitX())}, std::pair{Kind::rotation, Vec3(Vec3::UnitZ())},
          std::pair{Kind::translation, Vec3(Vec3::UnitY())}}) {
      MechanismDescription m = four_bar();
      m.errors.push_back(scenes::frame_error(m, kind, joint, body, way));
      m.errors.back().value = 2e-3;
      const auto mechanism = scenes::build(m);
      const auto commanded = std::make_shared<const IdealMotion>(ideal_motion(*mechanism, mechanism->parameters()));
      const std::string what = std::string(joint) + ": ";
      try {
        built_motion(mechanism, commanded, mechanism->parameters());
        ADD_FAILURE() << what << "closes";
      } catch (const ComputationError& refused) {
        expect_whole_loop(refused.what(), what);
      }
      try {
        MatX G;
        ErrorInfluence(*mechanism, *commanded).at(0.1, {}, G);
        ADD_FAILURE() << what << "closes to first order";
      } catch (const ComputationError& refused) {
        expect_whole_loop(refused.what(), what);
        EXPECT_NE(std::string(refused.what()).find("error." + m.errors.back().name), std::string::npos);
      }
    }
}

TEST(StrainedJoints, AreNamedByThoseWithAShareInIt) {
  const auto few = scenes::build(four_bar());
  EXPECT_EQ(strained_joints(*few, {0.0, 1e-3, 1e-9, 0.0, 0.0}), "joint \"B\" does");
  EXPECT_EQ(strained_joints(*few, {1e-3, 2e-5, 0.0, 0.0, 1e-9}), "joints \"A\" and \"B\" do");
  const auto many = scenes::build(read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/twelve-joints.toml", {}));
  const std::string named = strained_joints(*many, std::vector<double>(static_cast<std::size_t>(many->joints()), 1.0));
  EXPECT_TRUE(named.ends_with(" and " + std::to_string(many->joints() - 7) + " more do")) << named;
}

}  // namespace strained_joints_test
}  // namespace boresight
