// Play in prismatic joints: a slider on its round guide, keyed against turning, against closed forms, and the rungs against each other.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace guide_test {

constexpr double kClearance = 0.2e-3, kGravity = 9.81;

// A slider of 2 kg on a guide along `axis`, driven by `law` along it or free.
MechanismDescription slider(const Vec3& axis, JournalAxes axes, const char* law, double friction = 0.0) {
  MechanismDescription m;
  m.name = "slider on its guide";
  m.gravity = Vec3(0.0, 0.0, -kGravity);
  BodyDescription b;
  b.name = "slider";
  b.mass = 2.0;
  b.inertia = Vec3(2e-3, 3e-3, 4e-3).asDiagonal();
  b.boresight = Vec3::UnitZ();
  m.bodies.push_back(b);
  JointDescription j;
  j.name = "guide";
  j.type = JointType::prismatic;
  j.first = kGround;
  j.second = 0;
  j.axis = axis;
  j.driven = law != nullptr;
  m.joints.push_back(j);
  if (law) m.motion.drives[0] = parse_expression(law);
  m.motion.duration = 0.05;
  ClearanceDescription c;
  c.journal = kGround;
  c.axes = axes;
  c.contact_law = "hertz";
  c.friction_law = friction > 0.0 ? "modified-coulomb" : "none";
  c.parameters.radial = kClearance;
  c.parameters.journal_radius = 8e-3;
  c.parameters.sleeve_length = 60e-3;
  c.parameters.contact.young = {207e9, 207e9};
  c.parameters.contact.poisson = {0.3, 0.3};
  c.parameters.friction = {.coefficient = friction, .static_speed = 1e-9, .dynamic_speed = 1e-6};
  m.clearances.push_back(c);
  return m;
}

RunResult followed(const char* rung, const MechanismDescription& m, const char* formulation = "tree") {
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.step = 2e-6;
  options.sample_spacing = 1e-4;
  if (std::string(rung) == "multibody") options.formulation = formulation;
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

// From the middle of its guide it falls freely through the clearance, whatever drives it along.
TEST(SliderOnItsGuide, DropsFreelyThroughItsPlay) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    MechanismDescription m = slider(Vec3::UnitX(), axes, "0.02*sin(20*t)");
    m.journals = JournalStart::centred;
    m.motion.duration = 0.02;
    for (const char* formulation : {"tree", "paper"}) {
      const RunResult run = followed("multibody", m, formulation);
      ASSERT_FALSE(run.events.empty()) << formulation;
      EXPECT_NEAR(run.events.front().start, std::sqrt(2.0 * kClearance / kGravity), 2e-6) << formulation;
    }
    const RunResult linear = followed("perturbation", m);
    ASSERT_FALSE(linear.events.empty());
    EXPECT_NEAR(linear.events.front().start, std::sqrt(2.0 * kClearance / kGravity), 2e-6);
  }
}

// Resting on an inclined guide that nothing drives it slides down with g (sin a - mu cos a), and so falls behind the ideal motion, which
// knows no friction, by mu cos a g t^2 / 2.
TEST(SliderOnItsGuide, SlidesDownAnInclineWithCoulombsFriction) {
  const double slope = 0.5, mu = 0.2;
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    const MechanismDescription m = slider(Vec3(std::cos(slope), 0.0, -std::sin(slope)), axes, nullptr, mu);
    const auto mechanism = scenes::build(m);
    RunOptions options;
    options.sample_spacing = 1e-3;
    options.step = 2e-6;
    const RunResult run = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
    const double t = m.motion.duration;
    const double expected = 0.5 * kGravity * mu * std::cos(slope) * t * t;
    EXPECT_NEAR(run.index.position_error.max, std::hypot(expected, kClearance), 0.01 * expected);
  }
}

// A spring across the play carries the slider before the guide does: w = m g / k, and not the whole play.
TEST(SliderOnItsGuide, HangsInASpringWhereTheSpringHoldsItWithinItsPlay) {
  constexpr double kStiffness = 0.4e6;
  MechanismDescription m = slider(Vec3::UnitX(), JournalAxes::parallel, "0*t");
  SpringDescription spring;
  spring.first = kGround;
  spring.second = 0;
  spring.first_point = Vec3(0.0, 0.0, 0.1);
  spring.second_point = Vec3::Zero();
  spring.parameters = {.stiffness = kStiffness, .free_length = 0.1};
  m.springs.push_back(spring);
  m.journals = JournalStart::rest;
  for (const char* rung : {"quasistatic", "perturbation", "multibody"})
    EXPECT_NEAR(followed(rung, m).index.position_error.max / (2.0 * kGravity / kStiffness), 1.0, 1e-3) << rung;
}

// Its ends are where it has slid to: at rest on them nothing is pressed in by more than it carries.
TEST(SliderOnItsGuide, IsDrawnByTheBoundWithItsEndsWhereItHasSlidTo) {
  MechanismDescription m = slider(Vec3::UnitX(), JournalAxes::free, "0.02*sin(20*t)");
  m.journals = JournalStart::rest;
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 1e-3;
  const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), options);
  ASSERT_FALSE(bound.clearances.empty());
  double farthest = 0.0, deepest = 0.0;
  for (const ClearanceSample& sample : bound.clearances[0]) {
    farthest = std::max(farthest, std::abs(sample.offset.y()));
    deepest = std::max(deepest, sample.penetration);
  }
  EXPECT_NEAR(farthest, 0.02 * std::sin(1.0), 1e-4);
  EXPECT_LT(deepest, 0.05 * kClearance);
}

// A load off the guide's middle tips the slider across the guide. What keeps it from turning about the guide is a key, and where that lies is the
// drawing's choice: turned about the guide with all that pushes it, the slider tips as it did and turns about nothing else.
TEST(SliderOnItsGuide, TipsAlikeHoweverItIsTurnedAboutItsAxis) {
  const auto tipped = [](double by) {
    MechanismDescription m = slider(Vec3::UnitX(), JournalAxes::free, "0");
    const Mat3 turn = Eigen::AngleAxisd(by, Vec3::UnitX()).toRotationMatrix();
    m.bodies[0].center_of_mass = Vec3(0.1, 0.0, 0.0);
    m.bodies[0].axes = turn;
    m.bodies[0].inertia = Vec3(2e-3, 4e-3, 4e-3).asDiagonal();
    m.bodies[0].boresight = turn * Vec3::UnitY();  // what it tips about
    m.gravity = turn * m.gravity;
    m.journals = JournalStart::rest;
    m.clearances[0].parameters.sleeve_length = 20e-3;
    m.motion.duration = 0.005;
    return followed("multibody", m).index;
  };
  const PointingIndices straight = tipped(0.0);
  EXPECT_GT(straight.orientation_error.max, 0.01);
  for (const double by : {0.3, 0.785, 1.2, 2.5}) {
    const PointingIndices turned = tipped(by);
    EXPECT_NEAR(turned.orientation_error.max, straight.orientation_error.max, 1e-9) << by;
    EXPECT_LT(turned.boresight_error.max, 1e-9) << by;
  }
}

}  // namespace guide_test
}  // namespace boresight
