// What the perturbation rung's forces miss, as a load on its motion: that it acts where and when it should.
#include "boresight/perturbation/pushed_motions.hpp"

#include <gtest/gtest.h>

#include "bearing_pair_scenes.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/scene/resting_start.hpp"
#include "boresight/scene/scene_rung.hpp"

namespace boresight {
namespace pushed_motions_test {

// Begins at rest with its full angular acceleration.
constexpr const char* kTurnedAtOnce = R"scene(format = 1
name = "turned at once"
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "head"
mass = "2.25 kg"
center_of_mass = ["28 mm", "3 mm", "0 mm"]
inertia = ["4500 kg mm^2", "10000 kg mm^2", "11000 kg mm^2"]
boresight = [0.1, 0.2, 1]
[[joint]]
name = "axis"
type = "revolute"
connects = ["ground", "head"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
driven = true
[motion]
duration = "0.3 s"
drives = { axis = "-0.096*(1-cos(13.5*t))" }
[[clearance]]
joint = "axis"
journal = "ground"
radial = "0.3 mm"
axial = "0.3 mm"
cap_radius = "35 mm"
journal_radius = "22 mm"
sleeve_length = "120 mm"
axes = "parallel"
  [clearance.contact]
  law = "flores"
  restitution = 0.68
  young = ["110 GPa", "72 GPa"]
  poisson = [0.34, 0.33]
  density = "2700 kg/m^3"
  [clearance.friction]
  law = "modified-coulomb"
  coefficient = 0.08
)scene";

// Two instants, a straight line between them, and what is there at either goes on beyond.
TEST(PushedMotions, AreLoadedByStraightLinesBetweenTheInstantsBesideTheLoadsThatTheyHad) {
  const auto mechanism = scenes::build(scenes::gimbal({"A1", "A2", "E1", "E2"}, JournalAxes::free));
  const Parameters& parameters = mechanism->parameters();
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const SceneTables tables = *prepared.tables(parameters);
  const SceneLayout& at = tables.layout;
  int dependent = 0;
  for (const SceneLayout::Joint& joint : at.joints)
    for (int k = 0; k < joint.offsets; ++k) dependent += joint.source[k] == DeviationCoordinates::kDependent;
  ASSERT_GT(dependent, 0);
  const double T = mechanism->duration(), first = 0.25 * T, second = 0.75 * T;
  const VecX a = VecX::LinSpaced(at.n, 1.0, 2.0), b = VecX::LinSpaced(at.n, -3.0, 1.0);
  const VecX c = VecX::LinSpaced(dependent, 1e-6, 2e-6), d = VecX::LinSpaced(dependent, -1e-6, 5e-6);
  const MatX e = MatX::Identity(at.n, at.n), f = MatX::Constant(at.n, at.n, 0.5);
  const std::vector<Missed> missed = {{first, a, e, c}, {second, b, f, d}};

  const std::size_t width = static_cast<std::size_t>(tables.dynamics.width());
  std::vector<double> plain(width), row(width), twice(width);
  const VecX beside = VecX::LinSpaced(2 * at.n, -1e-6, 1e-6);
  const SecondOrder beyond = {.missed = missed, .start = beside};
  const auto once = pushed_by(beyond, 1.0, T, tables);
  const auto more = pushed_by(beyond, -3.0, T, *once);
  for (const double share : {0.0, 0.1, 0.4, 0.5, 0.6, 0.9}) {
    const double t = share * T, along = std::clamp((t - first) / (second - first), 0.0, 1.0);
    tables.at(t, plain.data());
    once->at(t, row.data());
    more->at(t, twice.data());
    for (int i = 0; i < at.n; ++i) {
      const double load = (1.0 - along) * a[i] + along * b[i];
      EXPECT_NEAR(row[at.Ar + i] - plain[at.Ar + i], load, 1e-9 * (1.0 + std::abs(plain[at.Ar + i]))) << share;
      EXPECT_NEAR(twice[at.Ar + i] - plain[at.Ar + i], -2.0 * load, 1e-9 * (1.0 + std::abs(plain[at.Ar + i]))) << share;
    }
    for (int i = 0; i < at.n; ++i)
      for (int j = i; j < at.n; ++j) {
        const int k = at.inverse_mass(i, j);
        const double more_so = (1.0 - along) * e(i, j) + along * f(i, j);
        EXPECT_NEAR(row[k] - plain[k], more_so, 1e-9 * (1.0 + std::abs(plain[k]))) << share;
        EXPECT_NEAR(twice[k] - plain[k], -2.0 * more_so, 1e-9 * (1.0 + std::abs(plain[k]))) << share;
      }
    int next = 0;
    for (const SceneLayout::Joint& joint : at.joints)
      for (int k = 0; k < joint.offsets; ++k) {
        if (joint.source[k] != DeviationCoordinates::kDependent) continue;
        const double shift = (1.0 - along) * c[next] + along * d[next];
        const double rate = along > 0.0 && along < 1.0 ? (d[next] - c[next]) / (second - first) : 0.0;
        EXPECT_NEAR(row[joint.shift + k] - plain[joint.shift + k], shift, 1e-15) << share;
        if (share > 0.0) {
          EXPECT_NEAR(row[joint.shift + joint.offsets + k] - plain[joint.shift + joint.offsets + k], rate, 1e-12);
        }
        ++next;
      }
  }
  // Where journals rest as motions start is no matter of these: that is known exactly.
  EXPECT_EQ(once->start.row, tables.start.row);
  EXPECT_EQ(once->start.beside, beside);
  EXPECT_LT((more->start.beside + 2.0 * beside).norm(), 1e-15);
  std::string warning;
  const std::vector<JointPlay> joints = joint_plays(mechanism->description(), parameters);
  const VecX start = start_coordinates(*mechanism, at, tables.start, joints, warning);
  EXPECT_EQ(start_coordinates(*mechanism, at, once->start, joints, warning), start + beside);
  EXPECT_EQ(warning, "");
}

// One axis turns a body within play across it: but for where offsets are counted from, that motion is linear, and what turning offsets takes is
// all that the rung misses. With it as a load, from where journals rest exactly, it is the exact motion.
TEST(PushedMotions, AreTheExactOnesWhereAllThatIsMissedTurnsWithTheBody) {
  const auto mechanism = scenes::build(read_mechanism_text(kTurnedAtOnce, "turned.toml"));
  RunOptions options;
  options.step = 2e-5;
  options.model_look = ModelLook::motions;
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
  options.model_look = ModelLook::none;
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const auto apart = [&](auto statistic) {
    return std::abs(linear.index.position_error.*statistic / exact.index.position_error.*statistic - 1.0);
  };
  const double most = std::max({apart(&Statistics::max), apart(&Statistics::rms), apart(&Statistics::mean)});
  const double stated = linear.error.model[int(PointingQuantity::position_error)];
  EXPECT_GT(most, 1e-4);
  EXPECT_NEAR(stated, 2.0 * most, 0.05 * most);
}

// Two bearings share a load along their shaft in many ways, and which of them takes it decides how it turns the shaft as that tilts: the one
// with the smaller gap does. Shared as evenly as can be it would turn it a quarter as much.
TEST(PushedMotions, KnowWhichOfTwoBearingsTakesTheThrust) {
  MechanismDescription m = scenes::gimbal({"E1", "E2"}, JournalAxes::free);
  m.gravity = Vec3(0.0, -5.0, -8.0);
  m.clearances[1].parameters.axial *= 2.0;
  const auto mechanism = scenes::build(std::move(m));
  RunOptions options;
  options.step = 2e-5;
  options.model_look = ModelLook::motions;
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
  options.model_look = ModelLook::none;
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  for (const PointingQuantity quantity : {PointingQuantity::orientation_error, PointingQuantity::boresight_error}) {
    const auto apart = [&](auto statistic) {
      return std::abs(linear.index.of(quantity).*statistic / exact.index.of(quantity).*statistic - 1.0);
    };
    const double most = std::max({apart(&Statistics::max), apart(&Statistics::rms), apart(&Statistics::mean)});
    const double stated = linear.error.model[int(quantity)];
    EXPECT_GT(most, 1e-4);
    EXPECT_NEAR(stated, 2.0 * most, 0.5 * most);
  }
}

// A pendulum on a journal with play: nothing drives its turn, and no load on the journal pushes it. What the journal misses is looked at all the
// same, and the smaller the play the less that is.
TEST(PushedMotions, AreFollowedBesideAFreedomThatNothingDrives) {
  double before = 1.0;
  for (const double play : {1e-4, 1e-5}) {
    MechanismDescription m;
    m.gravity = Vec3(0.0, 0.0, -9.81);
    const int body = scenes::add_body(m, "pendulum", 2.0, {0.2, 0.0, 0.0}, Vec3::Zero());
    m.bodies[body].boresight = Vec3::UnitX();
    const int joint = scenes::add_joint(m, JointType::revolute, kGround, body, Vec3::Zero(), Vec3::UnitY());
    scenes::add_clearance(m, joint, false, JournalAxes::parallel);
    m.clearances[0].parameters.radial = m.clearances[0].parameters.axial = play;
    m.journals = JournalStart::rest;
    m.motion.duration = 0.1;
    const auto mechanism = scenes::build(std::move(m));
    RunOptions options;
    options.step = 1e-5;
    options.model_look = ModelLook::motions;
    const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
    options.model_look = ModelLook::none;
    const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
    const auto apart = [&](auto statistic) {
      return std::abs(linear.index.position_error.*statistic / exact.index.position_error.*statistic - 1.0);
    };
    const double most = std::max({apart(&Statistics::max), apart(&Statistics::rms), apart(&Statistics::mean)});
    const double stated = linear.error.model[int(PointingQuantity::position_error)];
    EXPECT_GT(stated, most) << play;
    EXPECT_LT(stated, 0.01) << play;
    EXPECT_LT(stated, 0.5 * before) << play;
    before = stated;
  }
}

// What is missed as large as the inverse mass itself is no small push; and a pushed motion that goes on and on is another one. Neither is
// followed to its end, and what was stated stays.
TEST(PushedMotions, AreGivenUpWhereTheyShowNothing) {
  const auto mechanism = scenes::build(scenes::gimbal({"A1", "A2", "E1", "E2"}, JournalAxes::free));
  const Parameters& parameters = mechanism->parameters();
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const auto tables = prepared.tables(parameters);
  const int n = tables->layout.n;
  std::vector<double> row(static_cast<std::size_t>(tables->dynamics.width()));
  MatX A;
  tables->at(0.0, row.data());
  tables->layout.inverse_mass(row.data(), A);
  int dependent = 0;
  for (const SceneLayout::Joint& joint : tables->layout.joints)
    for (int k = 0; k < joint.offsets; ++k) dependent += joint.source[k] == DeviationCoordinates::kDependent;
  int followed = 0, looks = 0;
  const FollowOn endless = [&](const std::shared_ptr<const SceneTables>&, const RunOptions& options) {
    ++followed;
    RunResult result;
    while (looks < 1000 && options.progress({})) ++looks;
    result.interrupted = looks < 1000;
    return result;
  };
  for (const double share : {2.0, 0.01}) {
    SecondOrder beyond;
    beyond.whole.fill(0.25);
    beyond.missed = {{0.0, VecX::Zero(n), share * A, VecX::Zero(dependent)}};
    RunResult result;
    result.error.model = beyond.whole;
    state_what_pushes_move(beyond, *mechanism, tables, {}, 1e-3, endless, result);
    EXPECT_EQ(result.error.model, beyond.whole) << share;
    EXPECT_EQ(followed, share > 1.0 ? 0 : 1);
  }
  EXPECT_LT(looks, 10);
}

// A study's samples do not look for it, and are followed by the same motion.
TEST(PushedMotions, AreAskedForAndLeaveTheMotionAsItIs) {
  const auto mechanism = scenes::build(scenes::gimbal({"A1", "A2", "E1", "E2"}, JournalAxes::free));
  const auto rung = make_rung("perturbation", mechanism);
  RunOptions options;
  options.sample_spacing = 0.0;
  const RunResult asked = rung->run(mechanism->parameters(), options);
  options.model_look = ModelLook::shares;
  const RunResult plain = rung->run(mechanism->parameters(), options);
  EXPECT_EQ(asked.index.position_error.max, plain.index.position_error.max);
  EXPECT_EQ(asked.index.boresight_error.rms, plain.index.boresight_error.rms);
  EXPECT_NE(asked.error.model, plain.error.model);
  EXPECT_NE(asked.error.basis, plain.error.basis);

  options.model_look = ModelLook::none;
  const RunResult bare = rung->run(mechanism->parameters(), options);
  EXPECT_EQ(bare.index.position_error.max, plain.index.position_error.max);
  EXPECT_EQ(bare.error.largest_model(), 0.0);
  EXPECT_EQ(bare.error.basis, "not looked at");
}

}  // namespace pushed_motions_test
}  // namespace boresight
