// The cases in which methods and models fail, each shown to happen and to be borne as the program promises.
// Rows that other rooms' tests hold: tests/lib/rungs (steps, singular starts, redundancy, clearance),
// tests/lib/contact (restitution, friction), tests/analyses/study (large clearance).
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/io/expression.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "boresight_analyses/stability/stability.hpp"
#include "scenes.hpp"

namespace boresight {
namespace cases_test {

TEST(SingularPose, OfAFourBarAtItsChangePointIsNamedWithItsTime) {
  // A parallelogram, crank up at first, turned into one line with the other bars at t = 0.25 s.
  const std::vector<Vec3> parallelogram = {{0, 0, 0}, {0, 0, 1}, {2, 0, 1}, {2, 0, 0}};
  const auto mechanism = scenes::build(scenes::four_bar(parallelogram, false, "2*pi*t"));
  const KinematicReport report = analyse_kinematics(*mechanism);
  ASSERT_FALSE(report.lost.empty());
  EXPECT_NEAR(report.lost.front().t, 0.25, 0.005);
  EXPECT_NE(report.lost.front().description.find("bar1"), std::string::npos) << report.lost.front().description;
  EXPECT_NE(report.lost.front().description.find("while every drive stands still"), std::string::npos);
}

TEST(RedundantRows, ThatContradictEachOtherAreRefused) {
  // Bars of 1, 0.6 and 1 m cannot close over a ground of 2 m with the crank turned away from it by more than
  // some 50 degrees.
  MechanismDescription m = scenes::four_bar({{0, 0, 0}, {0, 0, 1}, {2, 0, 1.5}, {2.5, 0, 0}}, true, "0.4*sin(3*t)");
  // Both bars on the ground driven, by laws that do not go together.
  m.joints[3].driven = true;
  m.motion.drives[3] = parse_expression("t");
  const auto mechanism = scenes::build(m);
  const KinematicReport report = analyse_kinematics(*mechanism, 21);
  EXPECT_FALSE(report.feasible);
  EXPECT_FALSE(report.findings.empty());
  EXPECT_THROW(ideal_motion(*mechanism, mechanism->parameters()), ComputationError);
}

TEST(RedundantRows, ThatAgreeAreBorneAndCounted) {
  const auto mechanism =
      scenes::build(scenes::four_bar({{0, 0, 0}, {0, 0, 1}, {2, 0, 1.5}, {2.5, 0, 0}}, true, "0.4*sin(3*t)"));
  Scene scene;
  scene.mechanism = mechanism;
  const FollowedMotion followed = follow(mechanism);
  scene.followed = &followed;
  const FailureCase c = case_of_redundant_rows(scene);
  EXPECT_EQ(c.standing, FailureCase::Standing::behaves);
  EXPECT_NE(c.measured.find("3 of"), std::string::npos) << c.measured;
}

// A constant error in a constraint's acceleration (of what solves the equations, of a law) gives Phi'' =
// const: the velocity drifts with t, the position with its square. Baumgarte's gains hold it at error /
// beta^2.
TEST(NoStabilisation, LetsTheDriftGrowAsTheSquareOfTime) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
  IdealState start;
  ideal.state(0.0, start);
  const std::vector<ContactMemory> memory(1);
  const double error = 1.0, h = 1e-5;  // [m/s^2], of the velocity of one body along x
  const auto drift_at = [&](int steps, double gain) {
    const auto formulation = make_paper_formulation(*mechanism, mechanism->parameters(), &ideal,
                                                    {true, Stabilisation::baumgarte, gain, gain});
    VecX y;
    formulation->start(start, y);
    ExplicitRungeKutta method(classical_rk4(), y.size());
    const auto derivative = [&](double t, const VecX& s, VecX& ds) {
      formulation->derivative(t, s, memory, ds);
      ds[7] += error;
    };
    for (int n = 0; n < steps; ++n) {
      derivative(n * h, y, method.first_slope());
      method.step(n * h, h, y, derivative);
      formulation->stabilise((n + 1) * h, y);
    }
    derivative(steps * h, y, method.first_slope());
    return formulation->violation();
  };
  const double one = drift_at(50, 0.0), two = drift_at(100, 0.0), four = drift_at(200, 0.0);
  EXPECT_NEAR(std::log2(two / one), 2.0, 0.02);
  EXPECT_NEAR(std::log2(four / two), 2.0, 0.02);
  // The row that is violated most gives how much of the error is its own: four = own t^2 / 2.
  const double own = 2.0 * four / (200 * h * 200 * h), gain = 1e4;
  EXPECT_NEAR(drift_at(200, gain) * gain * gain / own, 1.0, 0.02);
}

TEST(Chatter, EndsInLastingContactAndTheStepRecovers) {
  SettlingContact contact;
  contact.mass = 1.0;
  contact.load = 9.81;
  contact.law = {1e10, normal_law("flores").damping_factor(0.5)};
  const double omega = contact.angular_frequency(), height = 1e-4, duration = 0.2;
  const Settling pair = stabilise(contact, height, duration, 1e-5, true),
                 l_stable = stabilise(contact, height, duration, 1e-5, false);
  for (const Settling& s : {pair, l_stable}) {
    EXPECT_TRUE(s.completed) << s.why_not;
    EXPECT_GE(s.contacts, 3) << s.method;
    EXPECT_GT(s.settled_at, 0.0) << s.method;
    EXPECT_LT(s.settled_at, 0.1) << s.method;
    EXPECT_NEAR(s.end_depth / contact.rest_depth(), 1.0, 1e-3) << s.method;
  }
  // The pair keeps to its stability limit, between those of the two axes; the other steps over the vibration.
  EXPECT_GT(pair.mean_step_settled, 0.5);
  EXPECT_LT(pair.mean_step_settled, 3.4);
  EXPECT_GT(l_stable.largest_step_settled, 30.0);
  EXPECT_LT(l_stable.evaluations, pair.evaluations);
  EXPECT_NEAR(omega, std::sqrt(1.5 * 9.81 / contact.rest_depth()), 1e-6 * omega);  // sqrt(1.5 g / d_s)
}

TEST(Impacts, PartNeighbouringTrajectoriesAndKeepTheirStatistics) {
  // Nothing is lost at an impact, and the gap is wide: the crank pin of the slider rattles, falling from its middle.
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism(
      std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml",
      {{"clearance.A.radial", "0.5 mm"}, {"clearance.A.contact.restitution", "1"}, {"initial.journals", "centred"}}));
  const FollowedMotion followed = follow(mechanism);
  std::vector<double> starts = {1e-12, 1e-9, 1e-6};
  for (double share : {2e-12, 5e-12, 1e-11, 1e-10, 2e-10, 2e-9, 1e-8, 1e-7, 2e-7, 5e-7}) starts.push_back(share);
  const std::vector<Separation> apart = separations(*mechanism, followed, starts);
  // Two such motions are two draws: one pair may be an eighth apart. All of them together tell how much their statistics scatter.
  double squares = 0.0;
  for (const Separation& s : apart) {
    EXPECT_GT(s.horizon, 0.0) << s.start;
    squares += s.rms_difference * s.rms_difference;
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(apart.size())), 0.1);
  // The better the start is known, the farther ahead the motion can be foretold: by a little, for errors grow
  // by powers.
  EXPECT_GT(apart[0].horizon, apart[1].horizon);
  EXPECT_GT(apart[1].horizon, apart[2].horizon);
}

class StabilityOfTheDefaultScene : public testing::Test {
 protected:
  std::shared_ptr<const Mechanism> mechanism_ = scenes::build(scenes::rrcpr({{"motion.duration", "0.05 s"}}));
};

TEST_F(StabilityOfTheDefaultScene, CoversEveryCaseAndFindsNoneThatFailsUnannounced) {
  StabilityOptions options;
  options.cells = 8;
  double share = 0.0;
  options.progress = [&](double now, const std::string&) {
    EXPECT_GE(now, share);
    share = now;
    return true;
  };
  const StabilityResult result = find_stability(mechanism_, options);
  EXPECT_FALSE(result.interrupted);
  EXPECT_EQ(result.cases.size(), 11u);
  for (const FailureCase& c : result.cases) {
    EXPECT_NE(c.standing, FailureCase::Standing::differs) << c.name << ": " << c.measured;
    EXPECT_FALSE(c.measured.empty()) << c.name;
  }
  EXPECT_LT(result.largest_difference(), 0.02);
  EXPECT_EQ(result.limits.size(), 6u);
  ASSERT_EQ(result.baumgarte.limits.size(), 14u);
  for (std::size_t k = 1; k < result.baumgarte.limits.size(); ++k)
    EXPECT_GT(result.baumgarte.limits[k].zeta, result.baumgarte.limits[k - 1].zeta) << "a damping ratio twice";
  EXPECT_LT(result.baumgarte.largest_difference, 1e-3);
  // Stiff columns stop at smaller steps, never within half of the limit foreseen.
  ASSERT_EQ(result.steps.frequency.size(), static_cast<std::size_t>(kStepMapColumns));
  for (std::size_t k = 0; k < result.steps.frequency.size(); ++k) {
    if (result.steps.refused_above[k] > 0.0) {
      EXPECT_GT(result.steps.refused_above[k] * result.steps.frequency[k], 1.4);
    }
  }
  const auto softest = std::find_if(result.steps.refused_above.begin(), result.steps.refused_above.end(),
                                    [](double h) { return h > 0.0; });
  ASSERT_NE(softest, result.steps.refused_above.end());
  EXPECT_GT(*softest, 2.0 * result.steps.refused_above.back());
  EXPECT_NE(result.steps.first_stop.find("largest stable step"), std::string::npos);
}

TEST_F(StabilityOfTheDefaultScene, StopsWhereItIsToldAndKeepsWhatItHas) {
  StabilityOptions options;
  options.progress = [](double share, const std::string&) { return share < 0.2; };
  const StabilityResult result = find_stability(mechanism_, options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_FALSE(result.limits.empty());
  EXPECT_TRUE(result.cases.empty());
}

TEST(Stability, OfAMechanismWithoutClearanceSaysSoAndKeepsTheRest) {
  MechanismDescription description = scenes::rrcpr({{"motion.duration", "0.05 s"}});
  description.clearances.clear();
  const StabilityResult result = find_stability(scenes::build(description), {.index = {}, .cells = 8});
  EXPECT_EQ(result.cases.size(), 11u);
  EXPECT_EQ(result.limits.size(), 6u);
  EXPECT_FALSE(result.baumgarte.limits.empty());
  for (const FailureCase& c : result.cases)
    EXPECT_NE(c.standing, FailureCase::Standing::differs) << c.name << ": " << c.measured;
}

TEST(RedundantRows, WhereThereAreNoneAreSaidToBeIndependent) {
  Scene scene;
  scene.mechanism =
      scenes::build(scenes::four_bar({{0, 0, 0}, {0, 0, 1}, {2, 0, 1.5}, {2.5, 0, 0}}, false, "0.4*sin(3*t)"));
  const FailureCase c = case_of_redundant_rows(scene);
  // Two revolutes, a spherical and a cylindrical joint: 5 + 5 + 3 + 4.
  EXPECT_EQ(c.measured, "17 rows, all independent");
}

// A micrometre deep: K d^(3/2) is 100 N at 1e11 N/m^(3/2), and Flores' damping grows as 8 (1 - e) / (5 e): at 0.1 m/s, of 1e-3 m/s at the
// start of the contact, 100 N (1 + 1.6e8).
TEST(VanishingRestitution, IsSaidWithTheForcesOfTheDepthItNames) {
  Scene scene;
  scene.contacts.push_back({.joint = "A", .hertz_stiffness = 1e11});
  const FailureCase c = case_of_vanishing_restitution(scene);
  EXPECT_NE(c.measured.find("at e = 1e-6 and 0.1 m/s a depth of 1 um gives 1.6e+10 N (elastic 100 N), finite"),
            std::string::npos)
      << c.measured;
}

TEST(VanishingRestitution, IsLookedAtWhereAContactIsHertzsAndNowhereElse) {
  Scene scene;
  scene.contacts.push_back({.joint = "pad"});
  EXPECT_EQ(case_of_vanishing_restitution(scene).standing, FailureCase::Standing::not_here);
  scene.contacts.push_back({.joint = "A", .hertz_stiffness = 1e11});
  std::string asked;
  scene.reread = [&](const Setting& setting) {
    asked = setting.path;
    throw InputError({"f.toml", 1}, setting.path, "0", "more");
  };
  EXPECT_EQ(case_of_vanishing_restitution(scene).standing, FailureCase::Standing::behaves);
  EXPECT_EQ(asked, "clearance.A.contact.restitution");
}

// A swinging linkage whose play rubs: without play nothing rubs, and the motion is the ideal one.
TEST(VanishingClearance, TendsToTheIdealMotionWhereNothingIsDrivenAndPlayRubs) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml",
                                          {{"motion.duration", "0.1 s"}, {"clearance.D.friction.coefficient", "0.2"}});
  for (JointDescription& joint : m.joints) joint.driven = false;
  m.motion.drives.clear();
  m.initial_rates = {{0, InitialRateDescription::Freedom::angle, 6.0, {}}};
  Scene scene;
  scene.mechanism = scenes::build(std::move(m));
  scene.contacts = analyse_contacts(*scene.mechanism, scene.mechanism->parameters());
  const FollowedMotion followed = follow(scene.mechanism);
  scene.followed = &followed;
  const FailureCase c = case_of_vanishing_clearance(scene);
  EXPECT_EQ(c.standing, FailureCase::Standing::behaves) << c.measured;
}

}  // namespace cases_test
}  // namespace boresight
