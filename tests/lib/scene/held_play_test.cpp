// Joints that hold the same parts: play in one of two bearings of a shaft cannot move, in both it moves together.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "bearing_pair_scenes.hpp"
#include "boresight/contact_events/contact_report.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "boresight/mechanism/play_mobility.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/scene/deviation_coordinates.hpp"

namespace boresight {
namespace held_play_test {

const JournalAxes kBoth[] = {JournalAxes::parallel, JournalAxes::free};

PlayMobility play_of(const Mechanism& mechanism) {
  const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
  IdealState state;
  ideal.state(0.37 * ideal.duration(), state);
  return analyse_play(mechanism, state.bodies);
}

TEST(PlayMobility, NamesTheBearingThatHoldsAnother) {
  for (const JournalAxes axes : kBoth)
    for (const bool inner : {true, false}) {
      const auto mechanism = scenes::build(scenes::gimbal({"E2"}, axes, inner));
      const PlayMobility play = play_of(*mechanism);
      EXPECT_EQ(play.joint[0].offsets, axes == JournalAxes::free ? 5 : 3);
      EXPECT_EQ(play.joint[0].movable, 0);
      ASSERT_EQ(play.joint[0].held_by, std::vector<int>{2});
      const std::vector<std::string> sentences = held_plays(*mechanism, play);
      ASSERT_EQ(sentences.size(), 1u);
      EXPECT_NE(sentences[0].find("\"E2\" cannot move: \"E1\" holds"), std::string::npos) << sentences[0];
    }
}

TEST(PlayMobility, SaysWhichPlaysMoveTogether) {
  const auto mechanism = scenes::build(scenes::gimbal({"A1", "E1", "E2"}, JournalAxes::free));
  const PlayMobility play = play_of(*mechanism);
  EXPECT_EQ(play.joint[0].movable, 0);
  EXPECT_EQ(play.joint[1].movable, 5);
  EXPECT_EQ(play.joint[2].movable, 5);
  ASSERT_EQ(play.together.size(), 1u);
  EXPECT_EQ(play.together[0], (std::vector<int>{1, 2}));
  EXPECT_EQ(play.independent[0], 5);
}

TEST(PlayMobility, OfAPlayHeldInPartSaysHowFarItMoves) {
  MechanismDescription m = scenes::gimbal({"E2"}, JournalAxes::parallel);
  m.joints[2].driven = false;
  m.motion.drives.erase(2);
  m.joints[2].type = JointType::cylindrical;  // lets the shaft slide
  m.joints[3].driven = true;
  m.motion.drives[3] = scenes::sine(0.5, 8.0);
  const auto mechanism = scenes::build(std::move(m));
  const PlayMobility play = play_of(*mechanism);
  EXPECT_EQ(play.joint[0].movable, 1);
  EXPECT_TRUE(held_plays(*mechanism, play).empty());
  const std::vector<std::string> sentences = bound_plays(*mechanism, play);
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_NE(sentences[0].find("1 of 3 ways"), std::string::npos) << sentences[0];
}

TEST(PlayMobility, IsTheSameOfADrawingMovedTurnedAndScaled) {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  for (const double scale : {1e-3, 1.0, 1e2})
    for (const Vec3& move : {Vec3(0.0, 0.0, 0.0), Vec3(1.0, -0.4, 0.3)})
      for (const JournalAxes axes : kBoth) {
        const auto mechanism =
            scenes::build(scenes::drawn_elsewhere(scenes::gimbal({"A2", "E1", "E2"}, axes), turn, move, scale));
        const KinematicReport report = analyse_kinematics(*mechanism, 11);
        EXPECT_TRUE(report.feasible) << scale;
        EXPECT_TRUE(report.lost.empty()) << scale;
        EXPECT_EQ(report.mobility, 2) << scale;
        EXPECT_EQ(report.redundant_rows, 10) << scale;
        const PlayMobility play = play_of(*mechanism);
        const int offsets = axes == JournalAxes::free ? 5 : 3;
        EXPECT_EQ(play.joint[0].movable, 0) << scale;
        EXPECT_EQ(play.joint[1].movable, offsets) << scale;
        EXPECT_EQ(play.joint[2].movable, offsets) << scale;
        ASSERT_EQ(play.independent.size(), 1u) << scale;
        EXPECT_EQ(play.independent[0], offsets) << scale;
      }
}

TEST(HeldPlay, LeavesEveryRungAtTheIdealMotion) {
  for (const char* name : {"E2", "A1"})
    for (const JournalAxes axes : kBoth)
      for (const bool inner : {true, false}) {
        const auto mechanism = scenes::build(scenes::gimbal({name}, axes, inner));
        for (const std::string& rung : rung_names()) {
          std::vector<std::string> integrators = integrator_names(rung);
          if (integrators.empty()) integrators = {""};
          for (const std::string& integrator : integrators)
            for (const char* formulation : {"tree", "paper"}) {
              if (rung != "multibody" && std::string(formulation) == "paper") continue;
              if (integrator == "generalized-alpha" && std::string(formulation) == "paper") continue;
              RunOptions options;
              options.integrator = integrator;
              options.formulation = formulation;
              if (integrator == "generalized-alpha") options.step = 1e-4;
              const RunResult result = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
              const std::string where = rung + " " + integrator + " " + formulation;
              // Steps under error control err by their tolerance, which is a share of the clearance; a turn by that over 0.1 m.
              const bool controlled = !integrator.empty() && integrator != "rk4";
              const double most =
                  controlled ? tolerance_of(options, rung) * mechanism->parameters().clearance[0].radial : 1e-9;
              EXPECT_LT(result.index.position_error.max, most) << where;
              EXPECT_LT(result.index.orientation_error.max, 10.0 * most) << where;
              EXPECT_NEAR(result.end_time, mechanism->duration(), 1e-9) << where;
              ASSERT_FALSE(result.warnings.empty()) << where;
              EXPECT_NE(result.warnings[0].find("cannot move"), std::string::npos) << result.warnings[0];
              ASSERT_EQ(result.contact.size(), 1u) << where;
              EXPECT_EQ(result.contact[0].impacts, 0) << where;
              EXPECT_EQ(result.clearances[0].size(), result.time.size()) << where;
            }
        }
      }
}

TEST(HeldPlay, CarriesNoLoadAndHasNoFrequency) {
  for (const JournalAxes axes : kBoth) {
    const auto mechanism = scenes::build(scenes::gimbal({"A2", "E1", "E2"}, axes));
    for (const ContactFrequency& f : analyse_contacts(*mechanism, mechanism->parameters())) {
      const bool held = f.joint == "A2";
      EXPECT_TRUE(std::isfinite(f.typical_load)) << f.joint;
      EXPECT_EQ(f.angular_frequency == 0.0, held) << f.joint;
      EXPECT_EQ(f.largest_load == 0.0, held) << f.joint;
      EXPECT_LT(f.largest_load, 1e3) << f.joint;  // the weights are 40 N and 30 N
      EXPECT_EQ(f.largest_stable_step == 0.0, held) << f.joint;
    }
  }
}

// A play that nothing lets move takes no part: the others move as if it were not there.
TEST(HeldPlay, LeavesOtherPlaysAsTheyAre) {
  RunOptions options;
  options.step = 2e-5;
  for (const JournalAxes axes : kBoth) {
    const auto with = scenes::build(scenes::gimbal({"A2", "E1", "E2"}, axes));
    const auto without = scenes::build(scenes::gimbal({"E1", "E2"}, axes));
    const RunResult a = make_rung("perturbation", with)->run(with->parameters(), options);
    const RunResult b = make_rung("perturbation", without)->run(without->parameters(), options);
    EXPECT_NEAR(a.index.position_error.rms / b.index.position_error.rms, 1.0, 0.01);
    EXPECT_GT(b.index.position_error.rms, 1e-5);
  }
}

TEST(BearingPair, MovesOnPerturbationAsOnMultibody) {
  RunOptions options;
  options.step = 2e-5;
  for (const JournalAxes axes : kBoth) {
    const auto mechanism = scenes::build(scenes::gimbal({"E1", "E2"}, axes));
    const RunResult a = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
    const RunResult b = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
    ASSERT_GT(b.index.position_error.rms, 1e-5);
    EXPECT_NEAR(a.index.position_error.rms / b.index.position_error.rms, 1.0, 0.01);
    EXPECT_NEAR(a.index.position_error.max / b.index.position_error.max, 1.0, 0.03);
  }
}

// Coordinates are the offsets of one bearing: a choice that holds in every pose, not only in the one looked at.
TEST(BearingPair, GivesTheOffsetsOfOneBearingAsCoordinates) {
  const auto mechanism = scenes::build(scenes::gimbal({"E1", "E2"}, JournalAxes::free));
  const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
  DeviationCoordinates coordinates(*mechanism, ideal);
  EXPECT_EQ(coordinates.count(), 5);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(coordinates.source()[k], k);
  for (int k = 5; k < 10; ++k) EXPECT_EQ(coordinates.source()[k], DeviationCoordinates::kDependent);
  MatX T;
  for (int i = 0; i <= 10; ++i) EXPECT_NO_THROW(coordinates.gain(0.1 * i * ideal.duration(), T));
}

// Statics: a mast in two bearings a span apart carries its jib's moment as a pair of forces, moment over span, and one of them the weight too.
TEST(BearingPair, CarriesAnOverhungLoadAsStaticsSays) {
  constexpr double kMass = 18e3, kOverhang = 4.0, kSpan = 3.0, kGravity = 9.81;
  const std::string file = testing::TempDir() + "boresight_mast.toml";
  std::ofstream(file) << R"(
format = 1
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "jib"
mass = "18000 kg"
center_of_mass = ["4 m", "0 m", "0 m"]
inertia = ["2e4 kg m^2", "2e5 kg m^2", "2e5 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "slew"
type = "revolute"
connects = ["ground", "jib"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 0, 1]
driven = true
[motion]
duration = "1 s"
drives = { slew = "0" }
[[clearance]]
joint = "slew"
bearing = "pair"
span = "3 m"
journal = "jib"
radial = "0.1 mm"
axial = "0.1 mm"
cap_radius = "200 mm"
journal_radius = "150 mm"
sleeve_length = "200 mm"
)";
  const Mechanism mechanism(read_mechanism(file));
  const double weight = kMass * kGravity, pair = weight * kOverhang / kSpan;
  const std::vector<ContactFrequency> found = analyse_contacts(mechanism, mechanism.parameters());
  ASSERT_EQ(found.size(), 2u);
  for (const ContactFrequency& f : found) {
    const double least = f.joint == "slew" ? std::hypot(pair, weight) : pair;
    // A journal's own couple counts as the force at its ends that it is: a few percent.
    EXPECT_NEAR(f.largest_load / least, 1.0, 0.1) << f.joint;
  }
}

}  // namespace held_play_test
}  // namespace boresight
