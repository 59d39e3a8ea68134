// Every integrator on the rungs that follow the motion: same indices, contacts latched where they are,
// statistics that do not depend on how long the steps are.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/perturbation/perturbation_system.hpp"
#include "boresight/perturbation/predictability.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace integrators_test {

std::shared_ptr<const Mechanism> scene(const std::vector<Setting>& more = {},
                                       JournalAxes axes = JournalAxes::parallel) {
  std::vector<Setting> settings = {{"motion.duration", "0.1 s"}};
  settings.insert(settings.end(), more.begin(), more.end());
  MechanismDescription d = scenes::rrcpr(settings);
  d.clearances[0].axes = axes;
  return scenes::build(std::move(d));
}

RunResult run(const char* rung, const std::shared_ptr<const Mechanism>& mechanism, const std::string& integrator,
              double tolerance = 0.0, double step = 0.0) {
  RunOptions options;
  options.integrator = integrator;
  options.tolerance = tolerance;
  options.step = step;
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

void expect_same_index(const RunResult& a, const RunResult& b, double most) {
  EXPECT_NEAR(a.index.position_error.max / b.index.position_error.max, 1.0, most) << a.integrator;
  EXPECT_NEAR(a.index.position_error.rms / b.index.position_error.rms, 1.0, most) << a.integrator;
}

TEST(Integrators, AgreeOnThePerturbationRung) {
  const auto mechanism = scene();
  const RunResult reference = run("perturbation", mechanism, "rk4", 0.0, 5e-6);
  for (const char* name : {"dopri5", "rosenbrock"}) {
    const RunResult result = run("perturbation", mechanism, name, 1e-5);
    expect_same_index(result, reference, 2e-3);
    EXPECT_GT(result.cost.steps, 0);
    EXPECT_GT(result.cost.evaluations, 5 * result.cost.steps);
    EXPECT_EQ(result.time.size(), reference.time.size());
    for (std::size_t k = 0; k < result.time.size(); ++k)
      EXPECT_NEAR(result.time[k], 1e-3 * static_cast<double>(k), 1e-9);
    // The first impact, before anything could have parted.
    ASSERT_FALSE(result.events.empty());
    EXPECT_NEAR(result.events[0].start, reference.events[0].start, 1e-8);
    EXPECT_NEAR(result.events[0].start_speed / reference.events[0].start_speed, 1.0, 1e-5);
    EXPECT_NEAR(result.events[0].max_force / reference.events[0].max_force, 1.0, 0.02);
    EXPECT_NEAR(result.contact[0].contact_fraction, reference.contact[0].contact_fraction, 0.01);
  }
}

// Finer than any grid of a rung's own: neither the ends of adaptive steps nor a longer step come in place of what was asked for.
TEST(Integrators, LeaveSamplesWhereTheyWereAskedFor) {
  const auto mechanism = scene({{"motion.duration", "10 ms"}});
  for (const char* rung : {"perturbation", "multibody"})
    for (const char* name : {"rk4", "dopri5", "rosenbrock", "generalized-alpha"}) {
      if (rung == std::string("perturbation") && name == std::string("generalized-alpha")) continue;
      for (const double spacing : {3e-6, 3.5e-5, 4e-4}) {
        RunOptions options;
        options.integrator = name;
        options.sample_spacing = spacing;
        const RunResult result = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
        ASSERT_GE(result.time.size(), static_cast<std::size_t>(0.01 / spacing)) << rung << name << spacing;
        for (std::size_t k = 0; k + 1 < result.time.size(); ++k)
          ASSERT_NEAR(result.time[k], spacing * static_cast<double>(k), 1e-6 * spacing) << rung << name;
      }
    }
}

TEST(Integrators, AgreeOnTheMultibodyRung) {
  const auto mechanism = scene();
  const RunResult reference = run("multibody", mechanism, "rk4", 0.0, 1e-5);
  for (const char* name : {"dopri5", "rosenbrock", "generalized-alpha"}) {
    const RunResult result = run("multibody", mechanism, name, 1e-4);
    expect_same_index(result, reference, 5e-3);
    EXPECT_LT(result.constraint_drift, 1e-7) << name;
    EXPECT_NEAR(result.events[0].start_speed / reference.events[0].start_speed, 1.0, 1e-3) << name;
  }
}

// A loose step that spans a whole contact may pass its error test by luck; the part of it up to the contact's
// end is a step of its own, which once threw the journal 0.8 m through its sleeve.
TEST(Integrators, PutTheStepUpToAnEventToTheErrorTestToo) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const double deepest = run("multibody", mechanism, "rk4", 0.0, 1e-4).contact[0].max_penetration;
  for (const double tolerance : {0.97e-2, 0.985e-2, 1e-2}) {
    RunOptions options;
    options.integrator = "dopri5";
    options.tolerance = tolerance;
    int looks = 0;
    options.progress = [&](const RunProgress&) { return ++looks < 320; };  // every 64 steps
    const RunResult loose = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
    EXPECT_FALSE(loose.interrupted) << tolerance;
    EXPECT_LT(loose.contact[0].max_penetration, 1.2 * deepest) << tolerance;
  }
}

TEST(Integrators, CutTheirStepsDownToTheShareThatIsAsked) {
  const auto mechanism = scene({{"motion.duration", "10 ms"}});
  for (const char* rung : {"perturbation", "multibody"}) {
    const auto steps = [&](double share) {
      RunOptions options;
      options.integrator = "dopri5";
      options.tolerance = 5e-2;
      options.share_of_longest_step = share;
      return make_rung(rung, mechanism)->run(mechanism->parameters(), options).cost.steps;
    };
    EXPECT_GT(steps(0.1), 2 * steps(1.0)) << rung;
  }
}

TEST(Integrators, FollowJournalsThatTilt) {
  const auto mechanism =
      scene({{"clearance.F1.sleeve_length", "120 mm"}, {"motion.duration", "0.03 s"}}, JournalAxes::free);
  const RunResult reference = run("perturbation", mechanism, "rk4", 0.0, 2e-6);
  expect_same_index(run("perturbation", mechanism, "rosenbrock", 1e-5), reference, 5e-3);
  expect_same_index(run("perturbation", mechanism, "dopri5", 1e-5), reference, 5e-3);
}

// At half a ton the friction of the resting journal is stiff: the explicit pair is held by stability, the
// implicit method is not.
TEST(Integrators, StepOverStickingContactWhereTheyAreImplicit) {
  const auto mechanism = scene({{"payload.mass", "500 kg"}});
  const RunResult pair = run("perturbation", mechanism, "dopri5", 1e-4),
                  implicit = run("perturbation", mechanism, "rosenbrock", 1e-4);
  EXPECT_LT(10 * implicit.cost.evaluations, pair.cost.evaluations);
  expect_same_index(implicit, pair, 5e-3);
}

TEST(Integrators, TakeFixedStepsFromEventToEventWhereAStepIsGiven) {
  const auto mechanism = scene();
  const RunResult result = run("perturbation", mechanism, "dopri5", 0.0, 5e-5);
  EXPECT_EQ(result.cost.rejected_steps, 0);
  EXPECT_GE(result.cost.steps, 2000);
  EXPECT_NE(result.integrator.find("h = 5e-05"), std::string::npos) << result.integrator;
  expect_same_index(result, run("perturbation", mechanism, "rk4", 0.0, 5e-6), 0.01);
}

TEST(Integrators, RefuseWhatMakesNoSense) {
  const auto mechanism = scene();
  EXPECT_THROW(run("perturbation", mechanism, "generalized-alpha"), std::invalid_argument);
  EXPECT_THROW(run("multibody", mechanism, "euler"), std::invalid_argument);
  EXPECT_THROW(run("perturbation", mechanism, "rk4", 1e-3), std::invalid_argument);
  EXPECT_THROW(run("perturbation", mechanism, "dopri5", 1e-3, 1e-4), std::invalid_argument);
  EXPECT_TRUE(integrator_names("envelope").empty());
}

void expect_exact_jacobian(JournalAxes axes, const VecX& y) {
  const auto mechanism = scene({{"clearance.F1.sleeve_length", "120 mm"}}, axes);
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, mechanism->parameters()), mechanism->parameters());
  PerturbationSystem system(*mechanism, mechanism->parameters(), prepared.tables(mechanism->parameters()), false);
  const double t = 0.037;
  ASSERT_EQ(system.size(), y.size());
  system.start_located(t, y);
  const Eigen::Index size = y.size();
  MatX J(size, size);
  system.jacobian(t, y, J);
  VecX plus(size), minus(size), shifted = y;
  for (Eigen::Index k = 0; k < size; ++k) {
    const double h = 1e-4 * std::abs(y[k]);
    shifted[k] = y[k] + h;
    system.derivative(t, shifted, plus);
    shifted[k] = y[k] - h;
    system.derivative(t, shifted, minus);
    shifted[k] = y[k];
    const VecX difference = (plus - minus) / (2.0 * h);
    EXPECT_LT((J.col(k) - difference).norm(), 1e-4 * difference.norm()) << k;
  }
}

TEST(PerturbationJacobian, IsThatOfTheRightHandSideInContact) {
  VecX parallel(6), tilted(10);
  parallel << 1.05e-4, -1.003e-4, 3e-5, 0.01, 0.02, -0.03;
  tilted << 2e-5, -0.9e-4, 1e-5, 1.6e-3, 0.4e-3, 0.01, 0.02, -0.03, 0.2, -0.1;
  expect_exact_jacobian(JournalAxes::parallel, parallel);
  expect_exact_jacobian(JournalAxes::free, tilted);
}

// Every kind of play, of tie and of element that the gauntlet's archetypes have, pressed and rubbing: of a state beside rest, as far as two
// differences agree with each other (next to a kink they do not).
TEST(PerturbationJacobian, IsThatOfTheRightHandSideOfEveryArchetype) {
  int scenes = 0, touching = 0, columns = 0, kinks = 0;
  for (const auto& file : std::filesystem::directory_iterator(BORESIGHT_CORPUS)) {
    if (file.path().extension() != ".toml") continue;
    const auto mechanism =
        std::make_shared<const Mechanism>(read_mechanism(file.path(), {{"motion.duration", "0.05 s"}}));
    if (mechanism->clearances() == 0) continue;
    const std::string name = file.path().filename();
    const Parameters& parameters = mechanism->parameters();
    const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
    PerturbationSystem system(*mechanism, parameters, prepared.tables(parameters), false);
    std::string warning;
    const VecX start = system.start_state(*mechanism, 0.0, warning);
    double widest = 0.0;
    for (const JointPlay& joint : system.joints()) widest = std::max(widest, joint.widest());
    const int n = system.layout().n;
    const Eigen::Index size = start.size();
    const double t = 0.037;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    ++scenes;
    bool pressed = false;
    // Where journals hardly slide, friction grows with the speed.
    for (const auto& [far, rate] : {std::pair{0.02, 0.02}, {0.7, 0.02}, {1.1, 0.02}, {1.1, 5e-5}}) {
      VecX y = start;
      for (int i = 0; i < n; ++i) {
        y[i] += far * widest * share(random);
        y[n + i] += rate * share(random);
      }
      system.start_located(t, y);
      MatX J(size, size);
      system.jacobian(t, y, J);
      const auto difference = [&](Eigen::Index k, double h) {
        VecX plus(size), minus(size), shifted = y;
        shifted[k] = y[k] + h;
        system.derivative(t, shifted, plus);
        shifted[k] = y[k] - h;
        system.derivative(t, shifted, minus);
        return VecX((plus - minus) / (2.0 * h));
      };
      pressed = pressed || system.touching();
      for (Eigen::Index k = 0; k < 2 * n; ++k) {
        const double h = k < n ? 1e-4 * widest : 1e-4 * rate;
        const VecX coarse = difference(k, h), fine = difference(k, 0.25 * h);
        const double size_of_it = fine.norm() + 1e-7 * J.norm() + 1e-5;  // in flight, rounding
        ++columns;
        if ((coarse - fine).norm() > 1e-3 * size_of_it)
          ++kinks;
        else
          EXPECT_LT((J.col(k) - fine).norm(), 3e-3 * size_of_it)
              << name << ", column " << k << " of " << n << ", " << far;
      }
    }
    touching += pressed;
  }
  std::printf("%d scenes, %d of them pressed; %d columns, %d of them next to a kink\n", scenes, touching, columns,
              kinks);
  EXPECT_GT(touching, 25);
  EXPECT_LT(kinks, columns / 10);
}

TEST(Predictability, IsTheTimeUpToWhichTwinsStayTogether) {
  const auto mechanism = scene();
  const Predictability found = measure_predictability(mechanism, mechanism->parameters());
  ASSERT_TRUE(found.measured) << found.refusal;
  // Twins part at a finite rate: what of them differs after a tenth of a second is far below the clearance.
  EXPECT_FALSE(found.parted);
  EXPECT_NEAR(found.horizon, 0.1, 1e-12);
  EXPECT_GT(found.growth, 0.0);
  EXPECT_LT(found.rms_difference, 1e-6);
}

TEST(Perturbation, TakesTheStepThatItIsGiven) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.05 s"}}));
  const auto rung = make_rung("perturbation", mechanism);
  RunOptions options;
  options.integrator = "rk4";
  for (const double step : {1e-4, 4e-5}) {
    options.step = step;
    EXPECT_EQ(rung->run(mechanism->parameters(), options).cost.steps, std::lround(0.05 / step)) << step;
  }
}

// A wheel balanced about the middle of its bearing, but for its principal axes, which stand ten microradians off: in flight within the
// play nothing but its tilt moves, which error control has to hold to the tolerance by itself, at the sleeve's ends.
TEST(Perturbation, HoldsTiltsToTheToleranceWhereNothingElseMoves) {
  MechanismDescription m;
  m.gravity = Vec3::Zero();
  const int wheel = scenes::add_body(m, "wheel", 2.0, Vec3::Zero(), Vec3(1e-5, 0.0, 0.0));
  m.bodies[wheel].inertia = Vec3(0.004, 0.004, 0.007).asDiagonal();
  m.bodies[wheel].boresight = Vec3::UnitZ();
  const auto spin = std::make_shared<scenes::FunctionOfTime>([](double t) { return TimeValue{600.0 * t, 600.0, 0.0}; });
  scenes::add_clearance(m, scenes::add_joint(m, JointType::revolute, kGround, wheel, Vec3::Zero(), Vec3::UnitZ(), spin),
                        true, JournalAxes::free);
  m.motion.duration = 0.1;
  m.journals = JournalStart::centred;
  const auto mechanism = scenes::build(std::move(m));
  const auto rung = make_rung("perturbation", mechanism);
  const double length = mechanism->parameters().clearance[0].radial,
               half = 0.5 * mechanism->parameters().clearance[0].sleeve_length;
  RunOptions options;
  options.integrator = "dopri5";
  const auto tilted = [&](double tolerance) {
    options.tolerance = tolerance;
    const RunResult result = rung->run(mechanism->parameters(), options);
    EXPECT_EQ(result.contact[0].impacts, 0);
    return std::pair{result.cost.steps, result.index.boresight_error.max};
  };
  const auto exact = tilted(1e-12);
  EXPECT_GT(exact.second, 1e-4);
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const auto [steps, tilt] = tilted(tolerance);
    // Nothing but the tilt asks for finer steps.
    if (tolerance > 1e-5) {
      EXPECT_GT(exact.first, 2 * steps);
    }
    // Of every step, and they add up.
    EXPECT_LT(std::abs(tilt - exact.second) * half, tolerance * length * static_cast<double>(steps)) << tolerance;
  }
}

}  // namespace integrators_test
}  // namespace boresight
