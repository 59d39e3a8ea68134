// Play in spherical joints: a ball in its socket against closed forms, and the rungs against each other.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "scenes.hpp"
#include "stepper.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace ball_joint_test {

constexpr double kRadius = 9.5e-3, kClearance = 0.5e-3, kAngle = 0.02;

// A solid ball of 1 kg in a spherical socket.
MechanismDescription ball(double friction) {
  MechanismDescription m;
  m.name = "ball in its socket";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  BodyDescription b;
  b.name = "ball";
  b.mass = 1.0;
  b.inertia = Mat3::Identity() * 0.4 * kRadius * kRadius;
  b.boresight = Vec3::UnitZ();
  m.bodies.push_back(b);
  JointDescription j;
  j.name = "socket";
  j.type = JointType::spherical;
  j.first = kGround;
  j.second = 0;
  m.joints.push_back(j);
  ClearanceDescription c;
  c.journal = 0;
  c.contact_law = "hertz";
  c.friction_law = friction > 0.0 ? "modified-coulomb" : "none";
  c.parameters.radial = kClearance;
  c.parameters.journal_radius = kRadius;
  c.parameters.contact.young = {207e9, 207e9};
  c.parameters.contact.poisson = {0.3, 0.3};
  // So low that creep is a ten-thousandth of the speed of the swing.
  c.parameters.friction = {.coefficient = friction, .static_speed = 1e-12, .dynamic_speed = 1e-5};
  m.clearances.push_back(c);
  return m;
}

double depth_at_rest() {
  const double stiffness = 4.0 / 3.0 * 207e9 / (2.0 * 0.91) * std::sqrt(kRadius * (kRadius + kClearance) / kClearance);
  return std::pow(9.81 / stiffness, 2.0 / 3.0);
}

// Circular frequency between the first two passages of the lowest point, released at rest from a small angle in a direction that is
// no axis of anything [rad/s].
double frequency(bool paper, double friction) {
  const Mechanism mechanism(ball(friction));
  const auto formulation = scenes::formulate(paper, mechanism);
  IdealState start = scenes::at_home(mechanism);
  const double radius = kClearance + depth_at_rest() * std::cbrt(std::pow(std::cos(kAngle), 2.0));
  const Vec3 across = Vec3(3.0, 4.0, 0.0).normalized();
  start.bodies[0].p = radius * (std::sin(kAngle) * across - std::cos(kAngle) * Vec3::UnitZ());
  scenes::Stepper stepper(*formulation, start);
  double passage[2] = {0.0, 0.0}, before = radius * std::sin(kAngle);
  const double h = 2e-6;
  for (int passages = 0; passages < 2 && stepper.t < 0.2;) {
    stepper.step(h);
    const double now = formulation->bodies(stepper.t, stepper.y)[0].p.dot(across);
    if (before * now < 0.0) passage[passages++] = stepper.t - h * now / (now - before);
    before = now;
  }
  return std::numbers::pi / (passage[1] - passage[0]);
}

TEST(BallInItsSocket, SlidesLikeAPendulumOfTheClearancesLength) {
  const double length = kClearance + depth_at_rest();
  for (const bool paper : {false, true})
    EXPECT_NEAR(frequency(paper, 0.0) / (std::sqrt(9.81 / length) * (1.0 - kAngle * kAngle / 16.0)), 1.0, 1e-5);
}

// 2/5 m R^2 turns with it, about the point where it touches.
TEST(BallInItsSocket, RollsAsSlowlyAsItsInertiaSays) {
  const double length = kClearance + depth_at_rest();
  const double turning = 0.4 * std::pow(kRadius / (kRadius - depth_at_rest()), 2.0);
  for (const bool paper : {false, true})
    EXPECT_NEAR(frequency(paper, 0.3) / (std::sqrt(9.81 / (length * (1.0 + turning))) * (1.0 - kAngle * kAngle / 16.0)),
                1.0, 1e-5);
}

// The platform of examples/2-us-pointing, its rods' ends with play.
MechanismDescription platform(double clearance) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/2-us-pointing/2-us-pointing.toml", {});
  const ClearanceDescription revolute = m.clearances.front();
  m.clearances.clear();
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    if (m.joints[j].type != JointType::spherical) continue;
    ClearanceDescription c = revolute;
    c.joint = static_cast<int>(j);
    c.journal = m.joints[j].first;
    c.parameters.radial = clearance;
    c.parameters.axial = c.parameters.cap_radius = c.parameters.sleeve_length = 0.0;
    m.clearances.push_back(c);
  }
  m.motion.duration = 0.4;
  return m;
}

TEST(BallJoints, AreFollowedAlikeByAllRungs) {
  const auto mechanism = scenes::build(platform(0.05e-3));
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
  const RunResult still = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
  const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), {});
  const double reference = exact.index.orientation_error.rms;
  ASSERT_GT(reference, 1e-6);
  EXPECT_NEAR(linear.index.orientation_error.rms / reference, 1.0, 0.01);
  EXPECT_NEAR(still.index.orientation_error.rms / reference, 1.0, 0.05);
  EXPECT_GT(bound.index.orientation_error.max, still.index.orientation_error.max);
  ASSERT_EQ(exact.contact.size(), 2u);
  for (const ContactSummary& contact : exact.contact) EXPECT_GT(contact.contact_fraction, 0.5) << contact.joint;
}

TEST(BallJoints, WithoutPlayAreIdealJoints) {
  double before = 0.0;
  for (const double clearance : {0.1e-3, 0.01e-3, 0.001e-3}) {
    const auto mechanism = scenes::build(platform(clearance));
    const double error = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {}).index.position_error.max;
    // The Hertzian deflection is left as the clearance goes.
    EXPECT_LT(error, 2.0 * clearance + 2e-6);
    if (before > 0.0) {
      EXPECT_LT(error, before);
    }
    before = error;
  }
}

// A heavy crank, in whose bearing everything else is next to nothing, and a light rod with a ball at the slider. The socket's frame, of
// which a file says nothing, is drawn with its y along `socket`.
MechanismDescription light_slider_crank(const Vec3& socket) {
  MechanismDescription m;
  m.name = "light slider on a heavy crank";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  const int crank = scenes::add_body(m, "crank", 1000.0, {0.0, 0.0, 0.0}, Vec3::Zero());
  const int rod = scenes::add_body(m, "rod", 1e-4, {0.3, 0.0, 0.05}, Vec3::Zero());
  const int slider = scenes::add_body(m, "slider", 1e-3, {0.5, 0.0, 0.0}, Vec3::Zero());
  for (BodyDescription& b : m.bodies) b.boresight.reset();
  m.bodies[slider].boresight = Vec3::UnitZ();
  scenes::add_joint(m, JointType::revolute, kGround, crank, {0.0, 0.0, 0.0}, Vec3::UnitY());
  scenes::add_joint(m, JointType::universal, crank, rod, {0.1, 0.0, 0.1}, Vec3::UnitY());
  m.joints.back().second_axis = Vec3(1.0, 0.0, 4.0).normalized();
  scenes::add_joint(m, JointType::spherical, rod, slider, {0.5, 0.0, 0.0}, socket);
  scenes::add_joint(m, JointType::prismatic, slider, kGround, {0.5, 0.0, 0.0}, Vec3::UnitX());
  m.joints[0].driven = true;
  m.motion.drives[0] = scenes::sine(0.2, 6.0);
  m.motion.duration = 0.1;
  scenes::add_clearance(m, 0, false);
  scenes::add_clearance(m, 2, false);
  ClearanceParameters& ball = m.clearances.back().parameters;
  ball.axial = ball.cap_radius = ball.sleeve_length = 0.0;
  return m;
}

// Of the ball's load the part along y was taken for nothing where it is next to nothing beside the loads of other joints.
TEST(BallJoints, RestWhereverTheirSocketsFrameLies) {
  for (const char* rung : {"quasistatic", "envelope"}) {
    double first = 0.0;
    for (const Vec3& socket : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(1.0, 2.0, -0.5)}) {
      const auto mechanism = scenes::build(light_slider_crank(socket));
      const double error = make_rung(rung, mechanism)->run(mechanism->parameters(), {}).index.position_error.rms;
      ASSERT_GT(error, 1e-5);
      if (first == 0.0) first = error;
      EXPECT_NEAR(error / first, 1.0, 1e-5) << rung << ", y of the socket along " << socket.transpose();
    }
  }
}

// What holds a ball in one direction ties it in most drawings; which of its offsets that concerns is the drawing's choice.
TEST(BallJoints, RestAlikeWhereTheyAreHeldInOneDirection) {
  double first = 0.0;
  for (const Vec3& socket : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
    MechanismDescription m = scenes::planar_four_bar();
    m.joints[0].driven = true;
    m.motion.drives[0] = scenes::sine(0.3, 6.0);
    m.motion.duration = 0.1;
    m.joints[2].type = JointType::spherical;
    m.joints[2].axis = socket;
    scenes::add_clearance(m, 2, false);
    ClearanceParameters& ball = m.clearances.back().parameters;
    ball.axial = ball.cap_radius = ball.sleeve_length = 0.0;
    const auto mechanism = scenes::build(m);
    const RunResult rest = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
    const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
    const double offset = rest.clearances[0].back().offset.norm();
    ASSERT_GT(offset, 1e-5);
    if (first == 0.0) first = offset;
    EXPECT_NEAR(offset / first, 1.0, 1e-5) << socket.transpose();
    EXPECT_NEAR(linear.clearances[0].back().offset.norm() / offset, 1.0, 1e-3) << socket.transpose();
  }
}

}  // namespace ball_joint_test
}  // namespace boresight
