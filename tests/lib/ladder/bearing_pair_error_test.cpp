// Errors of a joint in a bearing pair: those of the one joint that was drawn.
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error_influence.hpp"
#include "error_scenes.hpp"
#include "scenes.hpp"
#include "two_bearing_scenes.hpp"

namespace boresight {
namespace bearing_pair_error_test {

using Kind = ErrorDescription::Kind;

MechanismDescription gimbal_without_play() {
  using scenes::gimbal_joint;
  return read_mechanism_text(scenes::gimbal_file(gimbal_joint("yaw", "revolute", R"(["ground", "yoke"])",
                                                              R"(["0 mm", "0 mm", "10 mm"])", "[0, 0, 1]", true) +
                                                     gimbal_joint("pitch", "revolute", R"(["yoke", "tube"])",
                                                                  R"(["0 mm", "0 mm", "20 mm"])", "[0, 1, 0]", true),
                                                 ""),
                             "without_play.toml");
}

// Each joint's frame in both of its bodies, along and about all axes.
std::shared_ptr<const Mechanism> with_errors(MechanismDescription m) {
  for (const auto& [joint, bodies] :
       {std::pair{"yaw", std::array{"ground", "yoke"}}, std::pair{"pitch", std::array{"yoke", "tube"}}})
    for (const char* body : bodies)
      for (const Kind kind : {Kind::translation, Kind::rotation})
        for (int axis = 0; axis < 3; ++axis)
          m.errors.push_back(scenes::frame_error(m, kind, joint, body, Vec3::Unit(axis)));
  return scenes::build(std::move(m));
}

TEST(BearingPair, IsDisplacedAndTurnedByItsErrorsAsTheJointThatWasDrawn) {
  const auto pairs = with_errors(scenes::gimbal_by_shorthand()), single = with_errors(gimbal_without_play());
  const auto commanded = [](const Mechanism& m) {
    return std::make_shared<const IdealMotion>(ideal_motion(m, m.parameters()));
  };
  const auto of_pairs = commanded(*pairs), of_single = commanded(*single);
  ErrorInfluence columns_of_pairs(*pairs, *of_pairs), columns_of_single(*single, *of_single);
  for (const double t : {0.0, 0.02, 0.05}) {
    MatX of_two, of_one;
    columns_of_pairs.at(t, {}, of_two);
    columns_of_single.at(t, {}, of_one);
    EXPECT_LT((of_two - of_one).lpNorm<Eigen::Infinity>(), 1e-9) << t;
    EXPECT_LT(columns_of_pairs.shift().lpNorm<Eigen::Infinity>(), 1e-9) << t;  // no play is used up
  }
  // Exactly, turns of some degrees about all axes among them.
  for (std::size_t e = 0; e <= single->description().errors.size(); ++e) {
    Parameters a = pairs->parameters(), b = single->parameters();
    for (std::size_t k = 0; k < a.error.size(); ++k)
      if (e == k || e == a.error.size())
        a.error[k] = b.error[k] =
            (single->description().errors[k].kind == Kind::rotation ? 0.05 : 1e-3) * (k % 2 == 0 ? 1.0 : -0.7);
    const BuiltMotion two = built_motion(pairs, of_pairs, a), one = built_motion(single, of_single, b);
    for (const double t : {0.0, 0.05})
      for (int body = 0; body < single->bodies(); ++body) {
        const BodyMotion x = two.motion->body(t, body), y = one.motion->body(t, body);
        EXPECT_LT((x.p - y.p).norm(), 1e-11) << e << ' ' << t;
        EXPECT_LT((x.R - y.R).norm(), 1e-10) << e << ' ' << t;
      }
  }
}

// An axis out of square turns the boresight with it, whatever the play: only the seat of one bearing would have left it to the play.
TEST(BearingPair, LeansWithItsAxisOnEveryRung) {
  MechanismDescription m = scenes::gimbal_by_shorthand();
  m.errors.push_back(scenes::frame_error(m, Kind::rotation, "pitch", "yoke", Vec3::UnitZ()));
  const auto mechanism = scenes::build(std::move(m));
  Parameters leaning = mechanism->parameters();
  leaning.error[0] = 2e-3;
  for (const char* rung : {"perturbation", "multibody"}) {
    const double lean = make_rung(rung, mechanism)->run(leaning, {}).index.boresight_error.mean;
    const double play = make_rung(rung, mechanism)->run(mechanism->parameters(), {}).index.boresight_error.mean;
    EXPECT_NEAR(lean, 2e-3, play) << rung;
  }
}

// One joint on the ground is the middle of its joints, in a pair or not.
TEST(BearingPair, GrowsOnTheGroundFromTheMiddleBetweenItsBearings) {
  MechanismDescription m = scenes::gimbal_by_shorthand();
  ErrorDescription growth;
  growth.kind = Kind::expansion;
  growth.body = kGround;
  growth.coefficient = 1.0;
  const std::vector<FrameError> frames = frame_errors(m, growth);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_LT((frames[0].translation - Vec3(0.0, 0.0, -0.04)).norm(), 1e-15);
  EXPECT_LT((frames[1].translation - Vec3(0.0, 0.0, 0.04)).norm(), 1e-15);
}

}  // namespace bearing_pair_error_test
}  // namespace boresight
