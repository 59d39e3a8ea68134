// Play in planar joints with a rectangular pad: against closed forms, and the rungs against each other as it turns with its joint.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/play/flat_face_stiffness.hpp"
#include "scenes.hpp"
#include "stepper.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace rectangular_pad_test {

constexpr double kGap = 0.1e-3, kGravity = 9.81, kWidth = 50e-3, kLength = 80e-3, kMass = 2.0;
const Vec3 kInertia(2.5e-3, 1.8e-3, 4e-3);

ClearanceDescription play(JournalAxes axes, double friction = 0.0) {
  ClearanceDescription c;
  c.journal = 0;
  c.axes = axes;
  c.pad = PadShape::rectangular;
  c.contact_law = "hertz";
  c.friction_law = friction > 0.0 ? "modified-coulomb" : "none";
  c.parameters.axial = kGap;
  c.parameters.width = kWidth;
  c.parameters.length = kLength;
  c.parameters.contact.young = {207e9, 207e9};
  c.parameters.contact.poisson = {0.3, 0.3};
  c.parameters.friction = {.coefficient = friction, .static_speed = 1e-9, .dynamic_speed = 1e-6};
  return c;
}

// A pad that nothing drives, in a slot whose normal is `normal`.
MechanismDescription pad(JournalAxes axes, const Vec3& normal = Vec3::UnitZ(), double friction = 0.0) {
  MechanismDescription m;
  m.name = "rectangular pad in its slot";
  m.gravity = Vec3(0.0, 0.0, -kGravity);
  BodyDescription b;
  b.name = "stage";
  b.mass = kMass;
  b.inertia = kInertia.asDiagonal();
  b.boresight = Vec3::UnitZ();
  m.bodies.push_back(b);
  JointDescription j;
  j.name = "table";
  j.type = JointType::planar;
  j.first = kGround;
  j.second = 0;
  j.axis = normal;
  m.joints.push_back(j);
  m.motion.duration = 0.05;
  ClearanceDescription c = play(axes, friction);
  c.width_direction = normal.cross(Vec3(0.3, 1.0, 0.1)).normalized();
  m.clearances.push_back(c);
  return m;
}

double stiffness(const MechanismDescription& m) {
  return flat_face_stiffness(m.clearances[0].parameters.contact, kWidth, kLength);
}

// A thousand times as soft: depths far above what rounding leaves.
constexpr double kSoft = 1e-3;
MechanismDescription soft(MechanismDescription m) {
  m.clearances[0].parameters.contact.stiffness_scale = kSoft;
  return m;
}

// A turntable: a rotor that is driven about the vertical carries the stage round by a light sleeve that slides along it and a joint that leaves
// it free to tilt; the stage's weight lies on its pad, `aside` from the axis. carried: the pad is the stage's and turns with it; else it
// stands on the ground under the stage, which turns on it.
MechanismDescription turntable(const std::string& law, const Vec3& aside, bool carried, double friction = 0.0) {
  MechanismDescription m;
  m.name = "turntable on a pad";
  m.gravity = Vec3(0.0, 0.0, -kGravity);
  const auto add = [&](const char* name, double mass, const Vec3& centre, const Vec3& inertia) {
    BodyDescription b;
    b.name = name;
    b.mass = mass;
    b.center_of_mass = centre;
    b.inertia = inertia.asDiagonal();
    m.bodies.push_back(b);
  };
  const Vec3 top(0.0, 0.0, 0.1);
  add("stage", kMass, aside, kInertia);
  m.bodies[0].boresight = Vec3::UnitZ();
  add("sleeve", 1e-3, top, Vec3::Constant(1e-7));
  add("rotor", 1.0, top, Vec3::Constant(1e-3));
  const auto joint = [&](const char* name, JointType type, int first, int second,
                         const Vec3& point) -> JointDescription& {
    JointDescription j;
    j.name = name;
    j.type = type;
    j.first = first;
    j.second = second;
    j.point = point;
    m.joints.push_back(j);
    return m.joints.back();
  };
  joint("table", JointType::planar, kGround, 0, Vec3::Zero());
  joint("spindle", JointType::revolute, kGround, 2, top).driven = true;
  joint("guide", JointType::prismatic, 2, 1, top);
  joint("cross", JointType::universal, 1, 0, top).axis = Vec3::UnitX();
  m.joints.back().second_axis = Vec3::UnitY();
  m.motion.drives[1] = parse_expression(law);
  m.motion.duration = 0.3;
  ClearanceDescription c = play(JournalAxes::free, friction);
  c.journal = carried ? 0 : kGround;
  c.width_direction = Vec3::UnitX();
  m.clearances.push_back(c);
  return m;
}

RunResult followed(const char* rung, const MechanismDescription& m, const char* formulation = "tree",
                   const char* integrator = "dopri5") {
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 1e-4;
  const bool dynamic = std::string(rung) == "multibody" || std::string(rung) == "perturbation";
  if (std::string(rung) == "multibody") options.formulation = formulation;
  if (dynamic) options.integrator = integrator;
  options.tolerance = dynamic && options.integrator != "" ? 1e-9 : 0.0;
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

// Landed after sqrt(2 c / g), with sqrt(2 g c), on all four corners of a face.
TEST(RectangularPadInItsSlot, DropsFreelyThroughItsGap) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    MechanismDescription m = pad(axes);
    m.journals = JournalStart::centred;
    m.motion.duration = 0.006;
    for (const auto& [rung, formulation] :
         {std::pair{"multibody", "tree"}, std::pair{"multibody", "paper"}, std::pair{"perturbation", ""}}) {
      const RunResult run = followed(rung, m, formulation);
      ASSERT_GE(run.events.size(), 4u) << rung << formulation;
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(to_string(run.events[k].place)[5], '-');
        EXPECT_NEAR(run.events[k].start / std::sqrt(2.0 * kGap / kGravity), 1.0, 1e-6) << rung << formulation;
        EXPECT_NEAR(run.events[k].start_speed / std::sqrt(2.0 * kGap * kGravity), 1.0, 1e-6) << rung << formulation;
      }
    }
  }
}

TEST(RectangularPadInItsSlot, LeavesWithTheRestitutionOfItsLaw) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free})
    for (const char* rung : {"multibody", "perturbation"}) {
      MechanismDescription m = pad(axes);
      m.journals = JournalStart::centred;
      m.clearances[0].contact_law = "exact";
      m.clearances[0].parameters.contact.restitution = 0.6;
      m.motion.duration = 0.006;
      const RunResult run = followed(rung, m);
      ASSERT_FALSE(run.events.empty()) << rung;
      // Gravity takes part while it touches: g t / v is 1 % of the speed.
      EXPECT_NEAR(run.events.front().end_speed / run.events.front().start_speed, 0.6, 0.01) << rung;
    }
}

// Its weight aside of the middle: within the core all four corners bear, and it tilts by m g a / (K w^2) about its length.
TEST(RectangularPadInItsSlot, TiltsUnderAnEccentricLoadByHookesLaw) {
  const double x = 0.2 * kWidth, y = 0.15 * kLength;
  for (const bool carried : {true, false}) {
    MechanismDescription m = soft(turntable("0*t", Vec3(x, y, 0.0), carried));
    m.motion.duration = 0.02;
    const double K = stiffness(m), weight = kMass * kGravity;
    const double about_length = weight * x / (0.25 * K * kWidth * kWidth),
                 about_width = weight * y / (0.25 * K * kLength * kLength);
    for (const char* rung : {"multibody", "perturbation", "quasistatic"}) {
      const RunResult run = followed(rung, m);
      // The sleeve's weight, a two-thousandth, lies on the axis.
      EXPECT_NEAR(run.index.boresight_error.max / std::hypot(about_length, about_width), 1.0, 1e-3)
          << rung << ' ' << carried;
    }
  }
}

// Resting on four corners it rocks about either of its middles with the frequency of K w^2.
TEST(RectangularPadInItsSlot, RocksOnItsCorners) {
  for (const bool about_width : {false, true})
    for (const bool paper : {false, true}) {
      MechanismDescription described = pad(JournalAxes::free);
      described.clearances[0].width_direction = Vec3::UnitX();
      const Mechanism mechanism(described);
      const double K = stiffness(described), half = 0.5 * (about_width ? kLength : kWidth);
      const double expected = std::sqrt(K * half * half / (about_width ? kInertia.x() : kInertia.y()));
      const auto formulation = scenes::formulate(paper, mechanism);
      IdealState start = scenes::at_home(mechanism);
      const double depth = kMass * kGravity / K;
      start.bodies[0].p = -(kGap + depth) * Vec3::UnitZ();
      start.bodies[0].R =
          Eigen::AngleAxisd(0.3 * depth / half, about_width ? Vec3::UnitX() : Vec3::UnitY()).toRotationMatrix();
      scenes::Stepper stepper(*formulation, start);
      const double h = 2.0 * std::numbers::pi / expected / 400.0;
      double passage[2] = {0.0, 0.0};
      const auto tilt = [&] {
        const Mat3& R = formulation->bodies(stepper.t, stepper.y)[0].R;
        return about_width ? R(2, 1) : R(2, 0);
      };
      double before = tilt();
      for (int passages = 0; passages < 2 && stepper.t < 2000.0 * h;) {
        stepper.step(h);
        const double now = tilt();
        if (before * now < 0.0) passage[passages++] = stepper.t - h * now / (now - before);
        before = now;
      }
      EXPECT_NEAR(std::numbers::pi / (passage[1] - passage[0]) / expected, 1.0, 1e-4) << paper << about_width;
    }
}

// Thrown about in its slot, spinning, from face to face and corner to corner, without anything that dissipates. Each corner begins to push with
// its full stiffness, so that what a step adds to the energy falls with its square alone.
TEST(RectangularPadInItsSlot, KeepsItsEnergyWhereNothingDissipates) {
  for (const bool paper : {false, true}) {
    const Mechanism mechanism(soft(pad(JournalAxes::free, Vec3(0.3, -0.2, 0.9).normalized())));
    const auto formulation = scenes::formulate(paper, mechanism);
    const auto drift = [&](double h) {
      IdealState start = scenes::at_home(mechanism);
      start.bodies[0].v = Vec3(0.02, -0.01, 0.04);
      start.bodies[0].w = Vec3(1.0, 0.7, 30.0);  // a turn and more about its normal
      scenes::Stepper stepper(*formulation, start);
      const double before = formulation->energy(0.0, stepper.y);
      double largest = 0.0;
      while (stepper.t < 0.02) {
        stepper.step(h);
        largest = std::max(largest, std::abs(formulation->energy(stepper.t, stepper.y) - before));
      }
      EXPECT_GT(stepper.contacts, 4);
      return largest / (0.5 * kMass * start.bodies[0].v.squaredNorm());
    };
    const double coarse = drift(4e-6), fine = drift(2.5e-7);
    EXPECT_LT(fine, 1e-5) << paper;
    EXPECT_GT(coarse / fine, 100.0) << paper;
  }
}

// Spinning on its face it is slowed by its corners' friction, mu m g hypot(w, l): closed form, for a pad that keeps parallel.
TEST(RectangularPadInItsSlot, SpinsDownByItsCornersFriction) {
  const double mu = 0.2, spin = 4.0;
  const Mechanism mechanism(pad(JournalAxes::parallel, Vec3::UnitZ(), mu));
  const auto formulation = scenes::formulate(false, mechanism);
  IdealState start = scenes::at_home(mechanism);
  start.bodies[0].p = -(kGap + kMass * kGravity / stiffness(mechanism.description())) * Vec3::UnitZ();
  start.bodies[0].w = spin * Vec3::UnitZ();
  scenes::Stepper stepper(*formulation, start);
  while (stepper.t < 0.02) stepper.step(2e-6);
  const double slowed = spin - formulation->bodies(stepper.t, stepper.y)[0].w.z();
  EXPECT_NEAR(slowed / (mu * kMass * kGravity * 0.5 * std::hypot(kWidth, kLength) / kInertia.z() * stepper.t), 1.0,
              1e-3);
}

// Turned through more than a turn under a weight that lies beyond the pad's edges in turn, the stage tips from corner to corner.
TEST(RectangularPadInItsSlot, IsFollowedAlikeByAllRungsAsItTurns) {
  for (const bool carried : {true, false}) {
    MechanismDescription m = turntable("24*t+0.3*sin(15*t)", Vec3(0.35 * kLength, 0.1 * kLength, 0.02), carried, 0.1);
    m.clearances[0].contact_law = "flores";
    m.clearances[0].parameters.contact.restitution = 0.5;
    m.clearances[0].parameters.friction = {.coefficient = 0.1, .static_speed = 1e-4, .dynamic_speed = 1e-3};
    const auto mechanism = scenes::build(m);
    const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
    RunOptions options;
    options.formulation = "paper";
    const RunResult paper = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
    const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
    const RunResult still = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
    const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), {});
    const double reference = exact.index.boresight_error.rms;
    ASSERT_GT(reference, 1e-4);
    EXPECT_NEAR(paper.index.boresight_error.rms / reference, 1.0, 0.01) << carried;
    EXPECT_NEAR(linear.index.boresight_error.rms / reference, 1.0, 0.01) << carried;
    EXPECT_NEAR(still.index.boresight_error.rms / reference, 1.0, 0.1) << carried;
    EXPECT_GT(bound.index.boresight_error.max, still.index.boresight_error.max * (1.0 - 1e-9)) << carried;
    // A pad that is carried turns with its load.
    if (!carried) {
      EXPECT_GT(exact.index.boresight_error.max, 1.01 * exact.index.boresight_error.mean);
    }
  }
}

// A stage that hangs from its rotor by a ball is turned by nothing but its corners: where the rung is off, it says so.
TEST(RectangularPadInItsSlot, ThatNothingTurnsIsNotStatedToBeNearerThanItIs) {
  MechanismDescription m = turntable("0*t", Vec3(0.03, 0.01, 0.01), true);
  m.joints.back().type = JointType::spherical;
  m.joints.back().point = Vec3(0.1, 0.0, 0.0);
  m.clearances[0].contact_law = "flores";
  const auto mechanism = scenes::build(m);
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
  for (const PointingQuantity quantity : {PointingQuantity::position_error, PointingQuantity::boresight_error}) {
    const double off = std::abs(linear.index.of(quantity).max - exact.index.of(quantity).max);
    EXPECT_LE(off, linear.error.model_of(quantity) * linear.index.of(quantity).max) << static_cast<int>(quantity);
  }
}

// How such a stage turns is decided, to first order, by which of its corners carry it and by how these turn with it: both rungs have it stand
// alike, and turn alike as its rotor carries it round.
TEST(RectangularPadInItsSlot, ThatNothingTurnsStandsOnTheCornersThatCarryIt) {
  for (const PadShape shape : {PadShape::rectangular, PadShape::round})
    for (const char* law : {"0*t", "12*t"}) {
      MechanismDescription m = turntable(law, Vec3(0.03, 0.01, 0.01), true);
      m.joints.back().type = JointType::spherical;
      m.joints.back().point = Vec3(0.1, 0.0, 0.0);
      m.clearances[0].contact_law = "flores";
      m.clearances[0].pad = shape;
      if (shape == PadShape::round) {
        m.clearances[0].parameters.width = m.clearances[0].parameters.length = 0.0;
        m.clearances[0].parameters.pad_radius = 0.5 * kWidth;
      }
      const auto mechanism = scenes::build(m);
      const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
      const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
      EXPECT_NEAR(linear.index.position_error.max, exact.index.position_error.max,
                  0.01 * exact.index.position_error.max)
          << static_cast<int>(shape) << " " << law;
    }
}

// Nothing to cross leaves the ideal joint's motion, up to what its contact gives way by; little leaves little.
TEST(RectangularPadInItsSlot, WithoutAGapIsAnIdealJoint) {
  const auto error = [](double gap) {
    MechanismDescription m = turntable("12*t", Vec3(0.1 * kLength, 0.0, 0.0), true);
    m.clearances[0].parameters.axial = gap;
    m.clearances[0].contact_law = "flores";
    m.motion.duration = 0.05;
    return followed("perturbation", m, "", "rosenbrock").index.boresight_error.max;
  };
  EXPECT_LT(error(0.0), 1e-6);
  // Slowly: at 12 rad/s centrifugal forces hold it down.
  MechanismDescription tipped = turntable("2*t", Vec3(0.6 * kLength, 0.0, 0.0), true);
  tipped.clearances[0].contact_law = "flores";
  tipped.motion.duration = 0.05;
  for (const double gap : {1e-6, 1e-7}) {
    tipped.clearances[0].parameters.axial = gap;
    const double tilt = followed("perturbation", tipped, "", "rosenbrock").index.boresight_error.max;
    EXPECT_GT(tilt, gap / (0.5 * kWidth)) << gap;
    EXPECT_LT(tilt, 3.0 * gap / (0.5 * kWidth)) << gap;
  }
}

// The bound is reached with the pad's shorter side across the tilt, whatever the twist: c / w.
TEST(RectangularPadInItsSlot, IsBoundByItsShorterSide) {
  for (const char* law : {"0*t", "10*t"}) {
    MechanismDescription m = turntable(law, Vec3::Zero(), true);
    m.clearances[0].contact_law = "hertz";
    m.gravity.setZero();
    const RunResult bound = followed("envelope", m, "tree", "");
    EXPECT_NEAR(bound.index.orientation_error.max / (kGap / (0.5 * kWidth)), 1.0, 1e-3) << law;
  }
}

}  // namespace rectangular_pad_test
}  // namespace boresight
