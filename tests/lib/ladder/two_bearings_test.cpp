// Bearing pairs and universal joints with play: the shorthand against the scene written out, the rungs against each other, and the ideal
// joint as play goes.
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "scenes.hpp"
#include "two_bearing_scenes.hpp"

namespace boresight {
namespace two_bearings_test {

RunResult run(const MechanismDescription& m, const std::string& rung) {
  const auto mechanism = scenes::build(m);
  return make_rung(rung, mechanism)->run(mechanism->parameters(), {});
}

void expect_the_same(const MechanismDescription& shorthand, const MechanismDescription& written_out) {
  for (const char* rung : {"perturbation", "multibody"}) {
    const RunResult a = run(shorthand, rung), b = run(written_out, rung);
    ASSERT_GT(a.index.position_error.rms, 1e-6);
    EXPECT_EQ(a.index.position_error.rms, b.index.position_error.rms) << rung;
    EXPECT_EQ(a.index.position_error.max, b.index.position_error.max) << rung;
    EXPECT_EQ(a.index.orientation_error.rms, b.index.orientation_error.rms) << rung;
    EXPECT_EQ(a.index.boresight_error.max, b.index.boresight_error.max) << rung;
    ASSERT_EQ(a.contact.size(), b.contact.size());
    for (std::size_t c = 0; c < a.contact.size(); ++c) {
      EXPECT_EQ(a.contact[c].contact_fraction, b.contact[c].contact_fraction) << rung << ", " << a.contact[c].joint;
      EXPECT_EQ(a.contact[c].max_force, b.contact[c].max_force) << rung << ", " << a.contact[c].joint;
    }
  }
}

TEST(BearingPair, GivesTheResultsOfTheSceneWrittenOutToTheLastBit) {
  expect_the_same(scenes::gimbal_by_shorthand(), scenes::gimbal_written_out());
}

TEST(UniversalJoint, WithPlayGivesTheResultsOfItsCrossDrawnToTheLastBit) {
  expect_the_same(scenes::from_corpus("universal-joints-with-play", {{"motion.duration", "20 ms"}}), [] {
    MechanismDescription m = scenes::shaft_written_out();
    m.motion.duration = 0.02;
    return m;
  }());
}

void expect_linear_as_exact(const MechanismDescription& m, double turns) {
  const RunResult linear = run(m, "perturbation"), exact = run(m, "multibody");
  const double position = exact.index.position_error.rms, turn = exact.index.orientation_error.rms;
  ASSERT_GT(position, 1e-6);
  EXPECT_NEAR(linear.index.position_error.rms / position, 1.0, 0.01);
  ASSERT_GT(turn, turns);
  if (turns > 0.0) {
    EXPECT_NEAR(linear.index.orientation_error.rms / turn, 1.0, 0.01);
  }
}

TEST(BearingPair, IsFollowedAlikeByPerturbationAndMultibody) {
  expect_linear_as_exact(scenes::gimbal_by_shorthand(), 1e-6);
}

TEST(UniversalJoint, WithPlayIsFollowedAlikeByPerturbationAndMultibody) {
  MechanismDescription m = scenes::from_corpus(
      "universal-joints-with-play",
      {{"clearance.*.contact.restitution", "0.2"}, {"motion.drives.motor", "2*pi*t"}, {"motion.duration", "60 ms"}});
  for (ClearanceDescription& c : m.clearances) c.axes = JournalAxes::free;
  expect_linear_as_exact(m, 1e-6);
}

// Every body moves as it did, and its cross is where the joint is.
TEST(UniversalJoint, WhoseCrossIsABodyMovesAsTheIdealJoint) {
  MechanismDescription with = scenes::from_corpus("universal-joints-with-play");
  with.clearances.clear();
  MechanismDescription without = scenes::from_corpus("universal-joint-shaft");
  without.clearances.clear();
  const auto crossed = scenes::build(with), plain = scenes::build(without);
  const IdealMotion a = ideal_motion(*crossed, crossed->parameters()), b = ideal_motion(*plain, plain->parameters());
  for (int k = 0; k <= 12; ++k) {
    const double t = 0.01 * k;
    for (int body = 0; body < plain->bodies(); ++body) {
      EXPECT_LT((a.body(t, body).p - b.body(t, body).p).norm(), 1e-12) << t;
      EXPECT_LT((a.body(t, body).R - b.body(t, body).R).norm(), 1e-11) << t;
    }
    EXPECT_LT((a.body(t, 3).p - Vec3(0.08, 0.0, 0.0)).norm(), 1e-12) << t;
  }
}

// A shaft whose spring presses it against its axis, with 50 N; a load pulls along it.
std::string preloaded_shaft(const std::string& load) {
  return R"toml(format = 1
name = "pair"
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "shaft"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "0 mm"]
inertia = ["0.001 kg m^2", "0.001 kg m^2", "0.001 kg m^2"]
boresight = [0, 0, 1]
[[joint]]
name = "J"
type = "revolute"
connects = ["ground", "shaft"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
driven = true
[motion]
duration = "50 ms"
drives = { J = "t" }
[[clearance]]
joint = "J"
bearing = "pair"
span = "60 mm"
preload = "50 N"
journal = "shaft"
radial = "0.01 mm"
axial = "0.02 mm"
journal_radius = "6 mm"
cap_radius = "8 mm"
sleeve_length = "10 mm"
[[load]]
body = "shaft"
point = ["0 mm", "0 mm", "0 mm"]
force = ["0", "0", ")toml" +
         load + "\"]\n";
}

// Up to its preload it stays where that presses it; beyond, it rests at the other end of its play.
TEST(BearingPair, StaysAtItsEndFaceUntilTheLoadExceedsItsPreload) {
  for (const char* rung : {"quasistatic", "perturbation", "multibody"})
    for (const char* load : {"0", "40", "49", "51", "60"}) {
      const RunResult result = run(read_mechanism_text(preloaded_shaft(load), "shaft.toml"), rung);
      const double rest = result.clearances[0].back().offset.y(), side = std::stod(load) < 50.0 ? -1.0 : 1.0;
      EXPECT_GT(side * rest, 0.02e-3) << rung << ", " << load;
      EXPECT_LT(side * rest, 0.021e-3) << rung << ", " << load;
    }
}

// What is left as the clearance goes is the Hertzian deflection, some tenths of a micrometre.
TEST(TwoBearings, ApproachTheIdealJointAsTheirPlayGoes) {
  for (const bool universal : {true, false}) {
    double before = 0.0;
    for (const char* radial : {"10 um", "1 um", "0.1 um"}) {
      MechanismDescription m =
          universal ? scenes::from_corpus(
                          "universal-joints-with-play",
                          {{"clearance.*.radial", radial}, {"clearance.*.axial", radial}, {"motion.duration", "20 ms"}})
                    : scenes::gimbal_by_shorthand();
      if (!universal) {
        m.motion.duration = 0.02;
        for (ClearanceDescription& c : m.clearances) {
          c.parameters.axial = c.parameters.axial > 0.0 ? 1e-6 * std::stod(radial) : 0.0;
          c.parameters.radial = 1e-6 * std::stod(radial);
        }
      }
      const double error = run(m, "perturbation").index.position_error.max;
      if (before > 0.0) {
        EXPECT_LT(error, before);
      }
      before = error;
    }
    EXPECT_LT(before, 2e-6);
  }
}

}  // namespace two_bearings_test
}  // namespace boresight
