// Ideal motions of mechanisms that nothing drives: as exact as they say, however stiff their springs and dampers are.
#include "boresight/formulations/ideal_simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "bearing_pair_scenes.hpp"
#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/own_modes.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/stepping/own_step.hpp"
#include "boresight/stepping/unstable_step.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace ideal_simulation_test {

// RK4 with steps so small that the dampers are resolved: the answer by another way.
IdealState resolved(const Mechanism& mechanism, const IdealState& start, long steps) {
  const auto formulation = make_tree_formulation(mechanism, mechanism.parameters(), nullptr, {.with_clearance = false});
  VecX y;
  formulation->start(start, y);
  VecX k1(y.size()), k2 = k1, k3 = k1, k4 = k1;
  const double h = mechanism.duration() / static_cast<double>(steps);
  for (long i = 0; i < steps; ++i) {
    const double t = h * static_cast<double>(i);
    formulation->derivative(t, y, {}, k1);
    formulation->derivative(t + 0.5 * h, y + 0.5 * h * k1, {}, k2);
    formulation->derivative(t + 0.5 * h, y + 0.5 * h * k2, {}, k3);
    formulation->derivative(t + h, y + h * k3, {}, k4);
    y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    formulation->stabilise(t + h, y);
  }
  return {mechanism.duration(), formulation->bodies(mechanism.duration(), y), {}};
}

TEST(IdealSimulation, FollowsSpringsAndDampersHoweverStiff) {
  for (const auto& [stiffness, damping, steps] :
       {std::tuple{2e3, 40.0, 20000L}, std::tuple{8e5, 4e4, 40000L}, std::tuple{8e5, 0.0, 40000L}}) {
    MechanismDescription d = scenes::flyball_governor(stiffness, damping);
    d.motion.duration = 0.2;
    const auto mechanism = scenes::build(std::move(d));
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    EXPECT_LE(ideal.error(), IdealMotion::kAccuracy) << damping;
    IdealState start;
    ideal.state(0.0, start);
    const IdealState end = resolved(*mechanism, start, steps);
    for (int b = 0; b < mechanism->bodies(); ++b) {
      const BodyMotion found = ideal.body(mechanism->duration(), b);
      EXPECT_LT((found.p - end.bodies[b].p).norm(), 2e-8) << damping << " body " << b;
      EXPECT_LT((found.R - end.bodies[b].R).norm(), 2e-8) << damping << " body " << b;
      EXPECT_LT((found.v - end.bodies[b].v).norm(), 1e-5) << damping << " body " << b;
    }
  }
}

// Explicit steps short enough for these dampers would be millions. In so short a time a damper gives way by what pushes it over its
// damping: ten times the damping, a tenth of the way.
TEST(IdealSimulation, FollowsDampersThatOnlyAnImplicitMethodCan) {
  const auto end = [](double damping) {
    MechanismDescription d = scenes::flyball_governor(8e5, damping);
    d.motion.duration = 0.02;
    const auto mechanism = scenes::build(std::move(d));
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    EXPECT_LE(ideal.error(), IdealMotion::kAccuracy) << damping;
    std::vector<Vec3> places;
    for (int b = 0; b < mechanism->bodies(); ++b) places.push_back(ideal.body(mechanism->duration(), b).p);
    return places;
  };
  const std::vector<Vec3> soft = end(4e7), ten_times = end(4e8), rigid = end(4e10);
  double gave_way = 0.0, a_tenth = 0.0;
  for (std::size_t b = 0; b < rigid.size(); ++b) {
    gave_way += (soft[b] - rigid[b]).norm();
    a_tenth += (ten_times[b] - rigid[b]).norm();
  }
  EXPECT_GT(a_tenth, 1e-9);
  EXPECT_NEAR(gave_way / a_tenth, 10.0, 0.3);
}

// Without dampers kinetic, gravitational and elastic energy together stay what they were.
TEST(IdealSimulation, KeepsTheEnergyOfStiffSprings) {
  const auto mechanism = scenes::build(scenes::flyball_governor(8e5, 0.0));
  const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
  const auto formulation =
      make_tree_formulation(*mechanism, mechanism->parameters(), nullptr, {.with_clearance = false});
  const auto energy = [&](double t) {
    IdealState state;
    ideal.state(t, state);
    VecX y;
    formulation->start(state, y);
    return formulation->energy(t, y);
  };
  const double first = energy(0.0);
  for (int i = 1; i <= 50; ++i) EXPECT_NEAR(energy(0.01 * i) / first, 1.0, 1e-6) << i;
}

// Where memory holds no finer run, a looser one tells what the one that came to its end is wrong by.
TEST(IdealSimulation, SaysWhatAMotionIsWrongByThatNoFinerRunConfirms) {
  MechanismDescription d = scenes::flyball_governor(8e5, 4e7);
  d.motion.duration = 0.02;
  const auto mechanism = scenes::build(std::move(d));
  const auto within = [&](long steps) {
    return simulated_motion(*mechanism, mechanism->parameters(), {.explicit_steps = 1000, .implicit_steps = steps});
  };
  const IdealMotion best = within(200'000);
  ASSERT_LE(best.error(), IdealMotion::kAccuracy);
  // Ever fewer steps: the finest run that they allow is the last one.
  long steps = best.knots() - 2;
  for (int k = 0; k < 5; ++k) {
    std::optional<IdealMotion> found;
    try {
      found.emplace(within(steps));
    } catch (const ComputationError&) {  // one run at most, and nothing to compare it with
      EXPECT_GT(k, 0);
      return;
    }
    ASSERT_TRUE(std::isfinite(found->error())) << steps;
    for (int b = 0; b < mechanism->bodies(); ++b)
      EXPECT_LE((found->body(mechanism->duration(), b).p - best.body(mechanism->duration(), b).p).norm(),
                (found->error() + best.error()) * mechanism->characteristic_length())
          << steps << ' ' << found->error();
    EXPECT_EQ(doubt_of(*found).empty(), found->error() <= IdealMotion::kAccuracy);
    steps = found->knots() - 2;
  }
  FAIL() << "however few steps there are, the motion comes to its end";
}

// A swinging loop loses nothing and gains nothing: what grows are steps longer than a swing.
TEST(IdealSimulation, CallsTooLongWhatOnlyItsStepsMakeGrow) {
  for (const double duration : {1e5, 1e6, 1e8}) {
    MechanismDescription d = scenes::planar_four_bar();
    d.motion.duration = duration;
    const auto mechanism = scenes::build(std::move(d));
    try {
      simulated_motion(*mechanism, mechanism->parameters(), {.explicit_steps = 1 << 13, .implicit_steps = 200});
      FAIL() << "was followed for " << duration;
    } catch (const ComputationError& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("too long to follow"), std::string::npos) << refusal.what();
    }
  }
}

// A double pendulum whose motion soon hangs on the last digit, beside a damper that asks for an implicit method.
TEST(IdealSimulationLong, TellsARunsReaderThatItIsNotKnownAsWellAsItWasSought) {
  MechanismDescription m;
  m.name = "double pendulum and damped slug";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  const int arm = scenes::add_body(m, "arm", 1.0, {0.1, 0.0, 0.0}, Vec3::Zero());
  const int tip = scenes::add_body(m, "tip", 1.0, {0.2, 0.0, 0.0}, Vec3::Zero());
  const int slug = scenes::add_body(m, "slug", 1.0, {0.5, 0.0, 0.0}, Vec3::Zero());
  for (const int body : {arm, tip}) m.bodies[body].inertia = 1e-6 * Mat3::Identity();
  for (const int body : {tip, slug}) m.bodies[body].boresight.reset();
  scenes::add_joint(m, JointType::revolute, kGround, arm, Vec3::Zero(), Vec3::UnitY());
  scenes::add_joint(m, JointType::revolute, arm, tip, {0.1, 0.0, 0.0}, Vec3::UnitY());
  scenes::add_joint(m, JointType::prismatic, kGround, slug, {0.5, 0.0, 0.0}, Vec3::UnitZ());
  SpringDescription damper;
  damper.first = kGround;
  damper.second = slug;
  damper.first_point = {0.5, 0.0, 0.2};
  damper.second_point = {0.5, 0.0, 0.0};
  damper.parameters = {1e5, 2e4, 0.2};
  m.springs.push_back(damper);
  m.motion.duration = 5.0;
  const auto mechanism = scenes::build(std::move(m));
  RunOptions options;
  options.sample_spacing = 0.0;
  const RunResult run = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  ASSERT_FALSE(run.warnings.empty());
  EXPECT_NE(run.warnings.front().find("of the mechanism's size, not to 1e-09 as it was sought"), std::string::npos)
      << run.warnings.front();
}

TEST(OwnStep, SeesSpringsAndDampersBesideTheContacts) {
  const auto step_of = [](double stiffness, double damping) {
    MechanismDescription d = scenes::flyball_governor(stiffness, damping);
    d.motion.duration = 0.05;
    scenes::add_clearance(d, 1, true);
    const auto mechanism = scenes::build(std::move(d));
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    return own_step(*mechanism, mechanism->parameters(), ideal);
  };
  const double soft = step_of(2e3, 4.0), stiff = step_of(8e5, 4e4), stiffer = step_of(8e5, 4e5);
  EXPECT_LT(stiff, 0.9 * soft);
  EXPECT_NEAR(stiffer / stiff, 0.1, 0.02);
}

TEST(OwnStep, HoldsBesideStiffDampersAndATooLargeOneIsSaidToBe) {
  MechanismDescription d = scenes::flyball_governor(8e5, 4e4);
  d.motion.duration = 0.05;
  scenes::add_clearance(d, 1, true);
  const auto mechanism = scenes::build(std::move(d));
  const auto rung = make_rung("multibody", mechanism);
  for (const char* formulation : {"tree", "paper"}) {
    RunOptions options;
    options.formulation = formulation;
    const RunResult own = rung->run(mechanism->parameters(), options);
    EXPECT_GT(own.index.position_error.rms, 1e-6);
    EXPECT_LT(own.index.position_error.max, 1e-2);
    options.step = 1e-3;
    EXPECT_THROW(rung->run(mechanism->parameters(), options), UnstableStep) << formulation;
  }
}

// Platform on legs whose A axes stand at 45 degrees, journals free to tilt, heavy: impacts are far stiffer than the load at rest.
TEST(OwnStepLong, IsShortenedWhereAMotionBlowsUpAndNoPoseIsCalledSingular) {
  constexpr double kEta = 0.78539816339744831;
  for (const double eta : {-kEta, kEta})
    for (const char* formulation : {"tree", "paper"}) {
      MechanismDescription d = scenes::rrcpr_with_legs(eta, 0.1, 0.3);
      d.clearances[0].axes = JournalAxes::free;
      d.clearances[0].parameters.radial = 2.5e-4;
      d.clearances[0].parameters.sleeve_length = 0.1;
      if (eta < 0.0) d.clearances[0].parameters.axial = 2.5e-4;
      d.payload->mass = 30.0;
      const auto mechanism = scenes::build(std::move(d));
      RunOptions options;
      options.formulation = formulation;
      options.sample_spacing = 0.0;
      const RunResult result = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
      EXPECT_GT(result.index.position_error.max, 1e-3);
      EXPECT_LT(result.index.position_error.max, 2e-2);
    }
}

TEST(WithStableStep, BelievesASingularPoseThatShorterStepsMeetToo) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  ConstraintSystem rows(*mechanism, {});
  rows.evaluate(std::vector<BodyMotion>(mechanism->bodies()), std::vector<TimeValue>(mechanism->joints()));
  int tried = 0;
  const auto stays = [&](double) -> RunResult {
    ++tried;
    throw SingularPose(*mechanism, rows, 0.5);
  };
  EXPECT_THROW(with_stable_step(0.0, 1e-4, 0.0, stays), SingularPose);
  EXPECT_EQ(tried, 3);
  const auto comes_of_the_step = [&](double step) -> RunResult {
    if (step > 1e-5) throw SingularPose(*mechanism, rows, 1e3 * step);
    return {};
  };
  const RunResult result = with_stable_step(0.0, 1e-4, 0.0, comes_of_the_step);
  EXPECT_EQ(result.warnings.size(), 1u);
}

}  // namespace ideal_simulation_test
}  // namespace boresight
