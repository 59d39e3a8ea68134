// Play in planar joints: a pad between two faces against closed forms, and the rungs against each other.
#include <gtest/gtest.h>

#include "boresight/contact/hertz.hpp"
#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"
#include "stepper.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace pad_test {

constexpr double kGap = 0.1e-3, kGravity = 9.81, kRadius = 40e-3, kMass = 2.0, kInertia = 2.5e-3;

// A pad that nothing drives, in a slot whose normal is `normal`; `aside`: of its centre of mass, along the slot.
MechanismDescription pad(JournalAxes axes, const Vec3& normal = Vec3::UnitZ(), double friction = 0.0,
                         double aside = 0.0) {
  MechanismDescription m;
  m.name = "pad in its slot";
  m.gravity = Vec3(0.0, 0.0, -kGravity);
  BodyDescription b;
  b.name = "stage";
  b.mass = kMass;
  b.center_of_mass = Vec3(0.6, 0.8, 0.0) * aside;
  b.inertia = Vec3(kInertia, kInertia, 4e-3).asDiagonal();
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
  ClearanceDescription c;
  c.journal = 0;
  c.axes = axes;
  c.contact_law = "hertz";
  c.friction_law = friction > 0.0 ? "modified-coulomb" : "none";
  c.parameters.axial = kGap;
  c.parameters.pad_radius = kRadius;
  c.parameters.contact.young = {207e9, 207e9};
  c.parameters.contact.poisson = {0.3, 0.3};
  c.parameters.friction = {.coefficient = friction, .static_speed = 1e-9, .dynamic_speed = 1e-6};
  m.clearances.push_back(c);
  return m;
}

double stiffness() { return 2.0 * kRadius * 207e9 / (2.0 * 0.91); }

// A thousand times as soft: depths far above what rounding leaves.
constexpr double kSoft = 1e-3;
MechanismDescription soft(MechanismDescription m) {
  m.clearances[0].parameters.contact.stiffness_scale = kSoft;
  return m;
}

// The x-y stage of the gauntlet, its rods held still and next to massless: statics needs a mechanism whose every freedom is driven.
MechanismDescription held_stage(double aside) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_CORPUS) + "/xy-stage.toml", {});
  const MechanismDescription own = soft(pad(JournalAxes::free, Vec3::UnitZ(), 0.0, aside));
  m.clearances = own.clearances;
  m.motion.duration = own.motion.duration;
  for (auto& [joint, law] : m.motion.drives) law = parse_expression("0*t");
  for (BodyDescription& b : m.bodies)
    if (b.name == "stage") {
      b.mass = kMass;
      b.center_of_mass = own.bodies[0].center_of_mass;
    } else {
      b.mass = 1e-9;
    }
  return m;
}

RunResult followed(const char* rung, const MechanismDescription& m, const char* formulation = "tree",
                   const char* integrator = "dopri5") {
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 1e-4;
  if (std::string(rung) == "multibody") options.formulation = formulation;
  if (std::string(rung) == "multibody" || std::string(rung) == "perturbation") options.integrator = integrator;
  options.tolerance = options.integrator.empty() ? 0.0 : 1e-9;
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

// Landed after sqrt(2 c / g), with sqrt(2 g c).
TEST(PadInItsSlot, DropsFreelyThroughItsGap) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    MechanismDescription m = pad(axes);
    m.journals = JournalStart::centred;
    m.motion.duration = 0.006;
    for (const auto& [rung, formulation] :
         {std::pair{"multibody", "tree"}, std::pair{"multibody", "paper"}, std::pair{"perturbation", ""}}) {
      const RunResult run = followed(rung, m, formulation);
      ASSERT_FALSE(run.events.empty()) << rung << formulation;
      EXPECT_EQ(run.events.front().place, ContactPlace::axial_minus);
      EXPECT_NEAR(run.events.front().start / std::sqrt(2.0 * kGap / kGravity), 1.0, 1e-6) << rung << formulation;
      EXPECT_NEAR(run.events.front().start_speed / std::sqrt(2.0 * kGap * kGravity), 1.0, 1e-6) << rung << formulation;
    }
  }
}

// It parts again with the restitution asked for, and so is up by e^2 of the gap.
TEST(PadInItsSlot, LeavesWithTheRestitutionOfItsLaw) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    MechanismDescription m = pad(axes);
    m.journals = JournalStart::centred;
    m.clearances[0].contact_law = "exact";
    m.clearances[0].parameters.contact.restitution = 0.6;
    m.motion.duration = 0.006;
    const RunResult run = followed("multibody", m);
    ASSERT_FALSE(run.events.empty());
    // Gravity takes part while it touches: g t / v is 1 % of the speed.
    EXPECT_NEAR(run.events.front().end_speed / run.events.front().start_speed, 0.6, 0.01);
  }
}

TEST(PadInItsSlot, RestsAsDeepAsItsLoadSays) {
  const double depth = kMass * kGravity / (kSoft * stiffness());
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free})
    for (const char* rung : {"multibody", "perturbation", "quasistatic", "envelope"}) {
      const bool dynamic = rung == std::string("multibody") || rung == std::string("perturbation");
      MechanismDescription m = dynamic ? soft(pad(axes)) : held_stage(0.0);
      m.clearances[0].axes = axes;
      const RunResult run = followed(rung, m);
      ASSERT_FALSE(run.clearances.empty()) << rung;
      EXPECT_NEAR(run.clearances[0].back().penetration / depth, 1.0, 1e-5) << rung;
      EXPECT_NEAR(run.clearances[0].back().offset.y(), -(kGap + depth), 1e-5 * depth) << rung;
    }
}

// With q = aside / R: the whole rim touches up to q = 1/2, the slope 2 m g q / (K R); beyond, q = (a - sin a cos a) / (2 (sin a - a cos a))
// gives the part that touches.
TEST(PadInItsSlot, TiltsUnderAnEccentricLoad) {
  const double weight = kMass * kGravity, K = kSoft * stiffness();
  for (const double q : {0.3, 0.8}) {
    double slope = 2.0 * weight * q / (K * kRadius);
    if (q > 0.5) {
      double low = 1e-6, high = std::numbers::pi;
      for (int k = 0; k < 200; ++k) {
        const double a = 0.5 * (low + high), s = std::sin(a), c = std::cos(a);
        ((a - s * c) / (2.0 * (s - a * c)) > q ? low : high) = a;
      }
      slope = std::numbers::pi * weight / (K * (std::sin(low) - low * std::cos(low))) / kRadius;
    }
    for (const char* rung : {"multibody", "perturbation"}) {
      const RunResult run = followed(rung, soft(pad(JournalAxes::free, Vec3::UnitZ(), 0.0, q * kRadius)));
      EXPECT_NEAR(run.index.boresight_error.max / slope, 1.0, 2e-4) << rung << ' ' << q;
    }
    for (const char* rung : {"multibody", "perturbation", "quasistatic"})
      EXPECT_NEAR(followed(rung, held_stage(q * kRadius)).index.boresight_error.max / slope, 1.0, 2e-4)
          << rung << ' ' << q;
  }
}

// Farther out than its rim it tips over, as far as the other face lets it: 2 c across 2 R. The faces carry the weight with F and F + m g at
// opposite ends, 2 R F = m g R / 2, and give way to it.
TEST(PadInItsSlot, JamsBetweenBothFaces) {
  double slope = 0.0;
  for (const char* rung : {"quasistatic", "multibody", "perturbation"}) {
    const RunResult run = followed(rung, held_stage(1.5 * kRadius));
    if (slope == 0.0) slope = run.index.boresight_error.max;
    EXPECT_NEAR(run.index.boresight_error.max / slope, 1.0, 1e-3) << rung;
  }
  MechanismDescription stiff = held_stage(1.5 * kRadius);
  stiff.clearances[0].parameters.contact.stiffness_scale = 10.0;
  const RunResult run = followed("quasistatic", stiff);
  EXPECT_NEAR(run.index.boresight_error.max, kGap / kRadius, 1e-2 * kGap / kRadius);
  EXPECT_NEAR(run.clearances[0].back().offset.y(), 0.0, 1e-2 * kGap);
  EXPECT_GE(followed("envelope", stiff).index.boresight_error.max, run.index.boresight_error.max * (1.0 - 1e-9));
}

// On its whole rim it rocks with the frequency of K R^2 / 2.
TEST(PadInItsSlot, RocksOnItsRim) {
  const Mechanism mechanism(pad(JournalAxes::free));
  const double expected = std::sqrt(0.5 * stiffness() * kRadius * kRadius / kInertia);
  for (const bool paper : {false, true}) {
    const auto formulation = scenes::formulate(paper, mechanism);
    IdealState start = scenes::at_home(mechanism);
    const double depth = kMass * kGravity / stiffness();
    start.bodies[0].p = -(kGap + depth) * Vec3::UnitZ();
    start.bodies[0].R = Eigen::AngleAxisd(0.5 * depth / kRadius, Vec3(3.0, 4.0, 0.0) / 5.0).toRotationMatrix();
    scenes::Stepper stepper(*formulation, start);
    const double h = 2.0 * std::numbers::pi / expected / 400.0;
    double passage[2] = {0.0, 0.0};
    const auto tilt = [&] { return formulation->bodies(stepper.t, stepper.y)[0].R(2, 1); };
    double before = tilt();
    for (int passages = 0; passages < 2 && stepper.t < 2000.0 * h;) {
      stepper.step(h);
      const double now = tilt();
      if (before * now < 0.0) passage[passages++] = stepper.t - h * now / (now - before);
      before = now;
    }
    EXPECT_NEAR(std::numbers::pi / (passage[1] - passage[0]) / expected, 1.0, 1e-4) << paper;
  }
}

// Thrown about in its slot, from face to face and rim to rim, without anything that dissipates.
TEST(PadInItsSlot, KeepsItsEnergyWhereNothingDissipates) {
  for (const bool paper : {false, true}) {
    const Mechanism mechanism(soft(pad(JournalAxes::free, Vec3(0.3, -0.2, 0.9).normalized())));
    const auto formulation = scenes::formulate(paper, mechanism);
    const auto drift = [&](double h) {
      IdealState start = scenes::at_home(mechanism);
      start.bodies[0].v = Vec3(0.02, -0.01, 0.04);
      start.bodies[0].w = Vec3(1.0, 0.7, 3.0);
      scenes::Stepper stepper(*formulation, start);
      const double before = formulation->energy(0.0, stepper.y);
      double largest = 0.0;
      while (stepper.t < 0.04) {
        stepper.step(h);
        largest = std::max(largest, std::abs(formulation->energy(stepper.t, stepper.y) - before));
      }
      EXPECT_GT(stepper.contacts, 4);
      return largest / (0.5 * kMass * start.bodies[0].v.squaredNorm());
    };
    const double coarse = drift(2e-6), fine = drift(2.5e-7);
    EXPECT_LT(fine, 1e-9) << paper;
    EXPECT_GT(coarse / fine, 16.0) << paper;
  }
}

// Friction holds back what slides: mu g cos a t^2 / 2 behind the ideal motion, which knows none.
TEST(PadInItsSlot, SlidesDownAnInclineWithCoulombsFriction) {
  const double slope = 0.5, mu = 0.2;
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    const MechanismDescription m = pad(axes, Vec3(std::sin(slope), 0.0, std::cos(slope)), mu);
    const double t = m.motion.duration, expected = 0.5 * kGravity * mu * std::cos(slope) * t * t;
    const auto mechanism = scenes::build(m);
    for (const char* rung : {"multibody", "perturbation"}) {
      RunOptions options;
      options.step = 1e-6;
      const RunResult run = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
      EXPECT_NEAR(run.index.position_error.max, std::hypot(expected, kGap), 2e-3 * expected) << rung;
    }
  }
}

// Nothing to cross leaves the ideal joint's motion, up to what its contact gives way by; little leaves little: the stage's centre of mass is
// two radii above the pad, so that tipping over by c / R moves it by 2 c.
TEST(PadInItsSlot, WithoutAGapIsAnIdealJoint) {
  const auto error = [](double gap) {
    MechanismDescription m = read_mechanism(std::string(BORESIGHT_CORPUS) + "/xy-stage.toml", {});
    m.clearances.resize(1);
    m.clearances[0].parameters.axial = gap;
    m.motion.duration = 0.05;
    return followed("perturbation", m, "", "rosenbrock").index.position_error.max;
  };
  EXPECT_LT(error(0.0), 1e-7);
  for (const double gap : {1e-6, 1e-7}) {
    EXPECT_GT(error(gap), gap);
    EXPECT_LT(error(gap), 3.0 * gap);
  }
}

// All rungs on the x-y stage of the gauntlet, its pad and the guide of a slider with play.
TEST(PadInItsSlot, IsFollowedAlikeByAllRungs) {
  const auto mechanism = scenes::build(read_mechanism(std::string(BORESIGHT_CORPUS) + "/xy-stage.toml", {}));
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
  RunOptions options;
  options.formulation = "paper";
  const RunResult paper = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
  const RunResult still = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
  const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), {});
  const double reference = exact.index.boresight_error.rms;
  ASSERT_GT(reference, 1e-6);
  EXPECT_NEAR(paper.index.boresight_error.rms / reference, 1.0, 0.01);
  EXPECT_NEAR(linear.index.boresight_error.rms / reference, 1.0, 0.01);
  EXPECT_NEAR(still.index.boresight_error.rms / reference, 1.0, 0.1);
  EXPECT_GT(bound.index.boresight_error.max, still.index.boresight_error.max);
}

// On three pads a stage has the same plane three times over: the heights and tilts of the second and the third follow from the first one's,
// and what friction does to all of them hangs on how they slide.
TEST(PadInItsSlot, StandsOnThreePads) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_CORPUS) + "/xy-stage.toml", {});
  m.clearances.resize(1);
  m.clearances[0].parameters.pad_radius = 15e-3;
  m.clearances[0].parameters.friction.coefficient = 0.2;
  const JointDescription table = m.joints[0];
  m.joints[0].point = Vec3(0.1, 0.0, 0.0);
  const ClearanceDescription first = m.clearances[0];
  for (const double y : {-0.08, 0.08}) {
    JointDescription j = table;
    j.name += y < 0.0 ? "2" : "3";
    j.point = Vec3(-0.06, y, 0.0);
    ClearanceDescription c = first;
    c.joint = static_cast<int>(m.joints.size());
    m.joints.push_back(j);
    m.clearances.push_back(c);
  }
  m.motion.duration = 0.08;
  const auto mechanism = scenes::build(m);
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
  EXPECT_NEAR(linear.index.position_error.rms / exact.index.position_error.rms, 1.0, 0.01);
  EXPECT_NEAR(linear.index.boresight_error.rms / exact.index.boresight_error.rms, 1.0, 0.01);
  for (const ContactSummary& contact : exact.contact) EXPECT_GT(contact.contact_fraction, 0.2) << contact.joint;
}

// Two pads that lie in one plane tie each other's play: what the bound takes from each is still its whole gap.
TEST(PadInItsSlot, BesideAnotherIsBoundByTheGapOfBoth) {
  MechanismDescription m = held_stage(0.0);
  m.gravity.setZero();
  JointDescription other = m.joints[0];
  other.name += "2";
  other.point += Vec3(0.1, 0.05, 0.0);
  ClearanceDescription clearance = m.clearances[0];
  m.clearances[0].axes = clearance.axes = JournalAxes::parallel;
  clearance.joint = static_cast<int>(m.joints.size());
  m.joints.push_back(other);
  m.clearances.push_back(clearance);
  const RunResult bound = followed("envelope", m, "tree", "");
  EXPECT_NEAR(bound.index.position_error.max / kGap, 1.0, 1e-3);
}

}  // namespace pad_test
}  // namespace boresight
