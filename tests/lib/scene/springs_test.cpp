// Springs and dampers beside a clearance, on the perturbation rung.
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/scene/deviation_coordinates.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/scene/spring_gains.hpp"
#include "scenes.hpp"

namespace boresight {
namespace springs_test {

// The default scene with a spring across F1, off its axis on both sides: its length changes with the ideal
// motion.
MechanismDescription with_spring(double stiffness, double damping, double free_length, const char* duration) {
  MechanismDescription d = scenes::rrcpr({{"motion.duration", duration}});
  SpringDescription s;
  for (const JointDescription& j : d.joints)
    if (j.name == "F1") s.first_point = j.point;
  for (int b = 0; b < static_cast<int>(d.bodies.size()); ++b) {
    if (d.bodies[b].name == "rod1") s.first = b;
    if (d.bodies[b].name == "platform") s.second = b;
  }
  s.second_point = s.first_point + Vec3(0.01, 0.02, 0.05);
  s.first_point -= Vec3(0.02, 0.0, 0.03);
  s.parameters = {stiffness, damping, free_length};
  d.springs.push_back(s);
  return d;
}

Vec3 end_of(const MechanismDescription& m, int body, const Vec3& point, const BodyMotion& b) {
  return b.p + b.R * (m.bodies[body].axes.transpose() * (point - m.bodies[body].center_of_mass));
}

// What is tabled for a scene is taken again for parameters that make the same one, and for no others.
TEST(SceneRung, IsAnewWithAnyOneNumberOfASpring) {
  Parameters p;
  p.spring = {{1e5, 10.0, 0.05}, {2e5, 20.0, 0.07}};
  EXPECT_TRUE(same_scene(p, p));
  for (double SpringParameters::*number :
       {&SpringParameters::stiffness, &SpringParameters::damping, &SpringParameters::free_length})
    for (std::size_t s = 0; s < 2; ++s) {
      Parameters other = p;
      other.spring[s].*number *= 1.5;
      EXPECT_FALSE(same_scene(p, other)) << s;
    }
}

TEST(SceneRung, GivesAStifferSpringItsOwnMotion) {
  const auto mechanism = scenes::build(with_spring(1e5, 0.0, 0.05, "5 ms"));
  RunOptions options;
  options.step = 1e-5;
  const auto rung = make_rung("perturbation", mechanism);
  Parameters stiffer = mechanism->parameters();
  stiffer.spring[0].stiffness *= 3.0;
  const double first = rung->run(mechanism->parameters(), options).index.position_error.max;
  const double second = rung->run(stiffer, options).index.position_error.max;
  EXPECT_NE(second, first);
  EXPECT_EQ(second, make_rung("perturbation", mechanism)->run(stiffer, options).index.position_error.max);
}

TEST(SpringGain, IsTheDerivativeOfTheSpringsLength) {
  const auto mechanism = scenes::build(with_spring(1e5, 0.0, 0.05, "1 s"));
  const MechanismDescription& m = mechanism->description();
  const SpringDescription& s = m.springs[0];
  const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
  DeviationCoordinates coordinates(*mechanism, ideal);
  const double t = 0.37, h = 1e-5;
  const auto gain_at = [&](double at) {
    MatX before, after, T;
    coordinates.gain(at - h, before);
    coordinates.gain(at + h, after);
    coordinates.gain(at, T);
    IdealState state;
    ideal.state(at, state);
    return spring_gain(m, s, state, T, (after - before) / (2.0 * h));
  };
  IdealState state;
  ideal.state(t, state);
  MatX T;
  coordinates.gain(t, T);
  const auto length = [&](const VecX& z) {
    BodyMotion first = state.bodies[s.first], second = state.bodies[s.second];
    displace(first, T.middleRows<6>(6 * s.first) * z);
    displace(second, T.middleRows<6>(6 * s.second) * z);
    return (end_of(m, s.second, s.second_point, second) - end_of(m, s.first, s.first_point, first)).norm();
  };
  const SpringGain gain = gain_at(t);
  const int n = coordinates.count();
  EXPECT_NEAR(gain.length, length(VecX::Zero(n)), 1e-14);
  const double step = 1e-4;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto at = [&](int a, int b) {
        VecX z = VecX::Zero(n);
        z[i] += a * step;
        z[j] += b * step;
        return length(z);
      };
      EXPECT_NEAR(gain.W(i, j), (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4.0 * step * step),
                  1e-3 * gain.W.norm());
    }
  for (int i = 0; i < n; ++i) {
    const VecX z = step * VecX::Unit(n, i);
    EXPECT_NEAR(gain.g[i], (length(z) - length(-z)) / (2.0 * step), 1e-5);
  }
  const VecX rate = (gain_at(t + 1e-4).g - gain_at(t - 1e-4).g) / 2e-4;
  EXPECT_LT((gain.g_rate - rate).norm(), 1e-5 * rate.norm());
  EXPECT_NEAR(gain.speed, (gain_at(t + 1e-4).length - gain_at(t - 1e-4).length) / 2e-4, 1e-8);
}

TEST(Perturbation, FollowsMultibodyWithSpringsAndDampersBesideAClearance) {
  struct Case {
    const char* what;
    double stiffness, damping, free_length;
  };
  for (const Case& c :
       {Case{"damper", 0.0, 4e4, 0.05}, Case{"spring", 1e5, 0.0, 0.09}, Case{"both, pulling", 1e5, 300.0, 0.08}}) {
    const auto mechanism = scenes::build(with_spring(c.stiffness, c.damping, c.free_length, "0.1 s"));
    RunOptions options;
    options.sample_spacing = 0.0;
    options.step = 1e-5;
    const Statistics exact =
        make_rung("multibody", mechanism)->run(mechanism->parameters(), options).index.position_error;
    const Statistics cheap =
        make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).index.position_error;
    EXPECT_NEAR(cheap.max / exact.max, 1.0, 0.01) << c.what;
    EXPECT_NEAR(cheap.rms / exact.rms, 1.0, 0.005) << c.what;
  }
}

TEST(Perturbation, TakesStepsThatItsDampersBear) {
  const auto mechanism = scenes::build(with_spring(0.0, 4e5, 0.05, "0.02 s"));
  EXPECT_NO_THROW(make_rung("perturbation", mechanism)->run(mechanism->parameters(), {}));
}

TEST(Perturbation, AStiffnessOfASampleIsThatOfASceneBuiltWithIt) {
  const auto one = scenes::build(with_spring(1e6, 100.0, 0.05, "0.05 s")),
             other = scenes::build(with_spring(2e6, 300.0, 0.05, "0.05 s"));
  RunOptions options;
  options.step = 1e-5;
  const auto rung = make_rung("perturbation", one);
  rung->run(one->parameters(), options);
  EXPECT_EQ(rung->run(other->parameters(), options).index.position_error.rms,
            make_rung("perturbation", other)->run(other->parameters(), options).index.position_error.rms);
}

}  // namespace springs_test
}  // namespace boresight
