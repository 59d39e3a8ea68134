// A step that is far beyond its accuracy is refused in words; a contact that is open keeps no speed of the one before.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "boresight/contact_events/contact_tracker.hpp"
#include "boresight/contact_events/damped_contact.hpp"
#include "boresight/formulations/force_elements.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/stepping/own_step.hpp"
#include "error_scenes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace misleading_steps_test {

std::string refusal(const char* rung, const std::string& integrator, double step) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"}}));
  RunOptions options;
  options.integrator = integrator;
  options.step = step;
  try {
    make_rung(rung, mechanism)->run(mechanism->parameters(), options);
  } catch (const ComputationError& failure) {
    return failure.what();
  }
  return "none";
}

TEST(FixedSteps, AreRefusedWhereOneOfThemErrsByAShareOfTheClearance) {
  for (const char* integrator : {"dopri5", "rosenbrock"})
    for (const char* rung : {"perturbation", "multibody"}) {
      const std::string text = refusal(rung, integrator, 1e-3);
      EXPECT_NE(text.find("times the smallest clearance"), std::string::npos)
          << rung << ' ' << integrator << ": " << text;
      EXPECT_NE(text.find("take a smaller step, or none"), std::string::npos) << text;
    }
  EXPECT_EQ(refusal("perturbation", "rosenbrock", 2e-5), "none");
  EXPECT_EQ(refusal("perturbation", "dopri5", 2e-5), "none");
}

// A drive that moves by 0.05 rad in some ten microseconds, and stands before and after: steps of what contacts ask for pass over it.
TEST(OwnStep, FollowsAMotionThatIsFastForAMoment) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"},
                                                      {"motion.angles.psi", "1"},
                                                      {"motion.angles.theta", "0.5"},
                                                      {"motion.angles.phi", "-psi"}}));
  const double slow = own_step(*mechanism, mechanism->parameters(), IdealMotion::kinematic(*mechanism));
  const auto jumping = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"},
                                                    {"motion.angles.psi", "1 + 0.05*tanh(1e5*(t - 0.0312345))"},
                                                    {"motion.angles.theta", "0.5"},
                                                    {"motion.angles.phi", "-psi"}}));
  const double fast = own_step(*jumping, jumping->parameters(), IdealMotion::kinematic(*jumping));
  EXPECT_GT(slow, 2e-5);
  EXPECT_LT(fast, 1e-5);  // over which the drive moves
}

// A ripple that goes on once, or ten times, in each of the looks is no constant.
TEST(LoadTime, IsThatOfARippleAtTheLooksOwnPeriod) {
  const auto mechanism = [](const char* law) {
    MechanismDescription m = scenes::rrcpr({{"motion.duration", "1 s"}});
    m.errors.push_back(scenes::drive_error(m, "P1", law));
    LoadDescription& load = m.loads.emplace_back();
    load.body = 0;
    for (TimeFunctionPtr& force : load.force) force = parse_expression(law);
    return scenes::build(m);
  };
  for (const double hertz : {2e4, 2e5}) {
    const auto rippling = mechanism(hertz == 2e4 ? "100*cos(2*pi*2e4*t)" : "100*cos(2*pi*2e5*t)");
    const double time = 2.0 / (2.0 * std::numbers::pi * hertz);
    EXPECT_NEAR(load_time(*rippling), time, 0.01 * time) << hertz;
    const auto times = error_times(*rippling, IdealMotion::kinematic(*rippling), {true});
    EXPECT_NEAR(times[0], time, 0.01 * time) << hertz;
  }
}

// A drive's ripple goes on once, or twice, in half the step that the contacts ask for: RK4 would meet it at one phase of it always.
TEST(OwnStep, FollowsARippleOfADrive) {
  const auto run = [](const char* rung, const char* law, double value, double step) {
    MechanismDescription m = scenes::rrcpr({{"motion.duration", "5 ms"}, {"initial.journals", "rest"}});
    m.errors.push_back(scenes::drive_error(m, "P1", law));
    m.errors.back().value = value;
    const auto mechanism = scenes::build(m);
    RunOptions options;
    options.sample_spacing = 0.0;
    options.step = step;
    options.model_look = ModelLook::none;
    return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
  };
  const auto says = [](const RunResult& result) {
    return std::any_of(result.warnings.begin(), result.warnings.end(), [](const std::string& warning) {
      return warning.find("its law changes by all") != std::string::npos;
    });
  };
  constexpr double kTiny = 1e-13;  // [m]: no contact is disturbed
  const char* law = "cos(2*pi*4e4*t)";
  for (const char* rung : {"perturbation", "multibody"}) {
    const RunResult still = run(rung, law, 0.0, 0.0), rippling = run(rung, law, kTiny, 0.0);
    EXPECT_NEAR(5e-3 / still.cost.steps, 50e-6, 1e-6) << rung;
    EXPECT_LT(5e-3 / rippling.cost.steps, 8e-6) << rung;  // in which the law changes by all that it does
    EXPECT_FALSE(says(still)) << rung;
    EXPECT_FALSE(says(rippling)) << rung;
    EXPECT_TRUE(says(run(rung, law, kTiny, 50e-6))) << rung;
  }
  // Nor do balances at instants.
  EXPECT_LT(2.0 * run("quasistatic", law, 0.0, 0.0).cost.steps, run("quasistatic", law, kTiny, 0.0).cost.steps);
}

// A journal that rests under its load without having struck: D = chi F / v grows without bound as the least impact speed falls.
TEST(FixedSteps, SayWhereAContactIsDampedFasterThanTheyFollow) {
  const auto warned = [](const char* rung, const std::string& integrator, const char* least_speed) {
    const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "20 ms"},
                                                        {"initial.journals", "rest"},
                                                        {"clearance.F1.contact.minimum_impact_speed", least_speed}}));
    RunOptions options;
    options.integrator = integrator;
    for (const std::string& warning : make_rung(rung, mechanism)->run(mechanism->parameters(), options).warnings)
      if (warning.find("F1: damping or friction") == 0) return true;
    return false;
  };
  for (const char* rung : {"perturbation", "multibody"}) {
    EXPECT_TRUE(warned(rung, "rk4", "1e-6 m/s")) << rung;
    EXPECT_FALSE(warned(rung, "rk4", "1e-2 m/s")) << rung;
    EXPECT_FALSE(warned(rung, "rosenbrock", "1e-6 m/s")) << rung;
  }
}

// The rate that a tilting journal's damping has in the contacts' own forces, by differences.
TEST(MostDampedContact, IsTheSlopeOfTheForcesOverTheMass) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"clearance.F1.axes", "free"}}));
  const OffsetLayout layout(*mechanism);
  const std::vector<JointPlay> joints = joint_plays(mechanism->description(), mechanism->parameters());
  PlayMotion<double> motion{Vec3(joints[0].narrowest() + 2e-6, 0.0, 0.0), Vec3::Zero(), Vec3::Zero()};
  motion.slope = Eigen::Vector2d(1e-6, 0.0);
  motion.slope_rate.setZero();
  ContactTracker tracker(0, "F1", joints[0], false);
  std::array<ContactState<double>, kContactPlaces> contact{};
  joints[0].penetrations(motion, contact);
  tracker.accept(0.0, contact);
  // Only the offset across, of 3 kg: its own damping is the rate.
  MatX compliance = MatX::Zero(5, 5);
  compliance(0, 0) = 1.0 / 3.0;
  const auto force = [&](double rate) {
    PlayMotion<double> moving = motion;
    moving.e_dot.x() = rate;
    PlayWrench<double> wrench;
    joints[0].wrench(moving, tracker.memory().impact_speed, wrench);
    return wrench.force.x();
  };
  constexpr double kRate = 1e-7;
  const double damping = -(force(kRate) - force(-kRate)) / (2.0 * kRate);
  ASSERT_GT(damping, 1.0);
  const DampedContact found = most_damped_contact(layout, joints, {motion}, {tracker}, compliance);
  EXPECT_NEAR(found.rate, damping / 3.0, 1e-6 * damping);
  EXPECT_EQ(found.clearance, 0);
}

TEST(OpenContact, TakesTheSpeedAtWhichItWouldBeginNowUnderLocatedEvents) {
  JointPlay law;
  std::get<JournalInSleeve>(law.kind).tilts = true;
  law.minimum_impact_speed = 1e-3;
  ContactTracker tracker(0, "F1", law, false);
  constexpr int minus = static_cast<int>(ContactPlace::radial_minus),
                plus = static_cast<int>(ContactPlace::radial_plus);
  // The minus end hits at 0.5 m/s, rests, and leaves; the plus end lies on throughout.
  tracker.begin(ContactPlace::radial_plus, 0.0, 0.02);
  tracker.begin(ContactPlace::radial_minus, 0.0, 0.5);
  EXPECT_EQ(tracker.memory().impact_speed[minus], 0.5);
  tracker.end(ContactPlace::radial_minus, 0.01, 0.3);
  std::array<ContactState<double>, kContactPlaces> contact{};
  contact[minus].penetration = -1e-5;
  contact[minus].rate = 0.004;
  contact[plus].penetration = 1e-6;
  contact[plus].rate = 0.0;
  tracker.observe(0.011, contact);
  EXPECT_EQ(tracker.memory().impact_speed[minus], 0.004);
  EXPECT_EQ(tracker.memory().impact_speed[plus], 0.02) << "a contact that is closed keeps its own";
  contact[minus].rate = -0.1;
  tracker.observe(0.012, contact);
  EXPECT_EQ(tracker.memory().impact_speed[minus], 1e-3) << "never below the least";
}

}  // namespace misleading_steps_test
}  // namespace boresight
