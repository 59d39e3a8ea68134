// What the perturbation rung's forces miss, as a load on its motion: that it acts where and when it should.
#include "boresight/perturbation/pushed_motions.hpp"

#include <gtest/gtest.h>

#include "bearing_pair_scenes.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/scene/scene_rung.hpp"

namespace boresight {
namespace pushed_motions_test {

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
  const auto once = pushed_by(missed, 1.0, T, tables);
  const auto more = pushed_by(missed, -3.0, T, *once);
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
  for (int i = 0; i < at.n; ++i) {
    EXPECT_NEAR(once->start.row[at.Ar + i] - tables.start.row[at.Ar + i], a[i], 1e-12);
    EXPECT_NEAR(once->start.row[at.inverse_mass(i, i)] - tables.start.row[at.inverse_mass(i, i)], 1.0,
                1e-9 * (1.0 + tables.start.row[at.inverse_mass(i, i)]));
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
