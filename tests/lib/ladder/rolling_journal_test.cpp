// A journal that lies in its bearing swings like a pendulum as long as the clearance: sliding where nothing
// holds its surface, slower where friction makes it roll.
#include <gtest/gtest.h>

#include "scenes.hpp"
#include "stepper.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace rolling_journal_test {

// A solid steel cylinder of 1 kg in a bearing of 10 mm, axis level.
MechanismDescription journal(double clearance, double friction) {
  MechanismDescription m;
  m.name = "journal in its bearing";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  BodyDescription b;
  b.name = "journal";
  b.mass = 1.0;
  const double radius = 10e-3 - clearance;
  b.inertia = Vec3(0.5, 0.5 * radius * radius, 0.5).asDiagonal();
  b.boresight = Vec3::UnitZ();
  m.bodies.push_back(b);
  JointDescription j;
  j.name = "bearing";
  j.type = JointType::cylindrical;
  j.first = kGround;
  j.second = 0;
  j.axis = Vec3::UnitY();
  m.joints.push_back(j);
  ClearanceDescription c;
  c.journal = 0;
  c.contact_law = "hertz";
  c.friction_law = friction > 0.0 ? "modified-coulomb" : "none";
  c.parameters.radial = c.parameters.axial = clearance;
  c.parameters.journal_radius = radius;
  c.parameters.cap_radius = 16e-3;
  c.parameters.sleeve_length = 30e-3;
  c.parameters.contact.young = {207e9, 207e9};
  c.parameters.contact.poisson = {0.3, 0.3};
  // So low that creep is a ten-thousandth of the speed of the swing.
  c.parameters.friction = {.coefficient = friction, .static_speed = 1e-12, .dynamic_speed = 1e-5};
  m.clearances.push_back(c);
  return m;
}

// Depth under its own weight [m]: 207 GPa, 0.3.
double depth_at_rest(double clearance) {
  const double stiffness = 4.0 / 3.0 * 207e9 / (2.0 * 0.91) * std::sqrt(10e-3 * (10e-3 - clearance) / clearance);
  return std::pow(9.81 / stiffness, 2.0 / 3.0);
}

// Circular frequency between its first two passages of the lowest point [rad/s], released at rest from a
// small angle.
constexpr double kAngle = 0.02;
double frequency(bool paper, double clearance, double friction) {
  const Mechanism mechanism(journal(clearance, friction));
  const auto formulation = scenes::formulate(paper, mechanism);
  IdealState start = scenes::at_home(mechanism);
  const double radius = clearance + depth_at_rest(clearance) * std::cbrt(std::pow(std::cos(kAngle), 2.0));
  start.bodies[0].p = radius * Vec3(std::sin(kAngle), 0.0, -std::cos(kAngle));
  scenes::Stepper stepper(*formulation, start);
  double passage[2] = {0.0, 0.0}, before = radius * std::sin(kAngle);
  const double h = 2e-6;
  for (int passages = 0; passages < 2 && stepper.t < 0.1;) {
    stepper.step(h);
    const double now = formulation->bodies(stepper.t, stepper.y)[0].p.x();
    if (before * now < 0.0) passage[passages++] = stepper.t - h * now / (now - before);
    before = now;
  }
  return std::numbers::pi / (passage[1] - passage[0]);
}

// Of a swing of that angle over an infinitely small one.
const double kAmplitude = 1.0 - kAngle * kAngle / 16.0;

TEST(JournalInItsBearing, SlidesLikeAPendulumOfTheClearancesLength) {
  for (const auto& [clearance, rigid] : {std::pair{0.5e-3, 140.07}, std::pair{0.1e-3, 313.21}})
    for (const bool paper : {false, true}) {
      const double length = clearance + depth_at_rest(clearance), w = frequency(paper, clearance, 0.0);
      EXPECT_NEAR(w / (std::sqrt(9.81 / length) * kAmplitude), 1.0, 1e-5);
      // The figures for rigid bodies, sqrt(g / c), are above it by half the depth over the clearance.
      EXPECT_NEAR(w / rigid, 1.0 - 0.5 * (length / clearance - 1.0), 5e-5);
    }
}

TEST(JournalInItsBearing, RollsAsSlowlyAsItsInertiaSays) {
  for (const auto& [clearance, rigid] : {std::pair{0.5e-3, 114.368}, std::pair{0.1e-3, 255.734}})
    for (const bool paper : {false, true}) {
      const double radius = 10e-3 - clearance, depth = depth_at_rest(clearance);
      const double length = clearance + depth, w = frequency(paper, clearance, 0.3);
      // It turns about the point where it touches, depth nearer to its centre than its surface: sqrt(2 g / (3
      // c)) when rigid.
      const double turning = 0.5 * std::pow(radius / (radius - depth), 2.0);
      EXPECT_NEAR(w / (std::sqrt(9.81 / (length * (1.0 + turning))) * kAmplitude), 1.0, 1e-5);
      EXPECT_NEAR(w / rigid, 1.0 - 0.5 * (length / clearance - 1.0), 5e-5);
    }
}

}  // namespace rolling_journal_test
}  // namespace boresight
