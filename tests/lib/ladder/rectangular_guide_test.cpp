// Play in prismatic joints with a rectangular guide: a slider against closed forms, and the rungs against each other.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/play/flat_face_stiffness.hpp"
#include "scenes.hpp"
#include "stepper.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace rectangular_guide_test {

constexpr double kGravity = 9.81, kMass = 2.0, kInertia = 2.5e-3;
constexpr double kWidth = 50e-3, kHeight = 30e-3, kLength = 60e-3, kWidthGap = 0.1e-3, kHeightGap = 0.06e-3;

// A slider on a guide along `axis`, its width along `width`, that `law` drives along it (null: that is free); `aside`: of its centre of mass.
MechanismDescription slider(JournalAxes axes, const char* law, const Vec3& axis = Vec3::UnitX(),
                            const Vec3& width = Vec3::UnitY(), double friction = 0.0,
                            const Vec3& aside = Vec3::Zero()) {
  MechanismDescription m;
  m.name = "slider in its guide";
  m.gravity = Vec3(0.0, 0.0, -kGravity);
  BodyDescription b;
  b.name = "slider";
  b.mass = kMass;
  b.center_of_mass = aside;
  b.inertia = Vec3(kInertia, kInertia, 4e-3).asDiagonal();
  b.boresight = axis;
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
  c.journal = 0;
  c.axes = axes;
  c.guide = GuideShape::rectangular;
  c.width_direction = width;
  c.contact_law = "hertz";
  c.friction_law = friction > 0.0 ? "modified-coulomb" : "none";
  ClearanceParameters& p = c.parameters;
  p.width = kWidth;
  p.height = kHeight;
  p.length = kLength;
  p.width_gap = kWidthGap;
  p.height_gap = kHeightGap;
  p.contact.young = {207e9, 207e9};
  p.contact.poisson = {0.3, 0.3};
  p.friction = {.coefficient = friction, .static_speed = 1e-9, .dynamic_speed = 1e-6};
  m.clearances.push_back(c);
  return m;
}

constexpr double kSoft = 1e-3;
MechanismDescription soft(MechanismDescription m) {
  m.clearances[0].parameters.contact.stiffness_scale = kSoft;
  return m;
}
// Of the face that carries the weight where the height is upright [N/m].
double stiffness(const MechanismDescription& m) {
  return flat_face_stiffness(m.clearances[0].parameters.contact, kLength, kWidth);
}

RunResult followed(const char* rung, const MechanismDescription& m, const char* formulation = "tree") {
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 1e-4;
  if (std::string(rung) == "multibody") options.formulation = formulation;
  if (std::string(rung) == "multibody" || std::string(rung) == "perturbation") {
    options.integrator = "dopri5";
    options.tolerance = 1e-9;
  }
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

// Landed after sqrt(2 c / g) with sqrt(2 g c), with c the gap of the direction that points down.
TEST(SliderInItsGuide, DropsFreelyThroughTheGapOfItsDirection) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free})
    for (const bool on_edge : {false, true}) {
      MechanismDescription m = slider(axes, "0.02*sin(20*t)", Vec3::UnitX(), on_edge ? Vec3::UnitZ() : Vec3::UnitY());
      m.journals = JournalStart::centred;
      m.motion.duration = 0.006;
      const double gap = on_edge ? kWidthGap : kHeightGap;
      for (const auto& [rung, formulation] :
           {std::pair{"multibody", "tree"}, std::pair{"multibody", "paper"}, std::pair{"perturbation", ""}}) {
        const RunResult run = followed(rung, m, formulation);
        ASSERT_FALSE(run.events.empty()) << rung << formulation;
        EXPECT_NEAR(run.events.front().start / std::sqrt(2.0 * gap / kGravity), 1.0, 1e-6) << rung << formulation;
        EXPECT_NEAR(run.events.front().start_speed / std::sqrt(2.0 * gap * kGravity), 1.0, 1e-6) << rung << formulation;
      }
    }
}

TEST(SliderInItsGuide, RestsAsDeepAsItsLoadSays) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free})
    for (const char* rung : {"multibody", "perturbation", "quasistatic", "envelope"}) {
      const MechanismDescription m = soft(slider(axes, "0*t"));
      const double depth = kMass * kGravity / stiffness(m);
      const RunResult run = followed(rung, m);
      if (rung == std::string("envelope")) {
        EXPECT_NEAR(run.contact[0].max_penetration / depth, 1.0, 1e-5);
        EXPECT_GE(run.index.position_error.max, kHeightGap + depth);
        continue;
      }
      EXPECT_NEAR(run.clearances[0].back().penetration / depth, 1.0, 1e-5) << rung;
      EXPECT_NEAR(run.index.position_error.max, kHeightGap + depth, 1e-5 * depth) << rung;
    }
}

// The weight `aside` along the axis by q L / 2 shares itself among both ends: (1 +- q) / 2 of it, each end half as stiff as the face.
// Across the axis, along the width by q W / 2, it rolls as edges do: 3 q (m g / K) / (W / 2) while the whole face touches (q <= 1/3).
TEST(SliderInItsGuide, TiltsAndRollsUnderAnEccentricLoad) {
  for (const char* rung : {"multibody", "perturbation", "quasistatic"}) {
    const double q = 0.5;
    MechanismDescription m =
        soft(slider(JournalAxes::free, "0*t", Vec3::UnitX(), Vec3::UnitY(), 0.0, Vec3(0.5 * q * kLength, 0.0, 0.0)));
    const double depth = kMass * kGravity / stiffness(m);
    EXPECT_NEAR(followed(rung, m).index.boresight_error.max / (q * depth / (0.5 * kLength)), 1.0, 1e-3) << rung;
    const double r = 0.3;
    m = soft(slider(JournalAxes::free, "0*t", Vec3::UnitX(), Vec3::UnitY(), 0.0, Vec3(0.0, 0.5 * r * kWidth, 0.0)));
    const RunResult run = followed(rung, m);
    EXPECT_NEAR(run.index.orientation_error.max / (3.0 * r * depth / (0.5 * kWidth)), 1.0, 1e-3) << rung;
    EXPECT_LT(run.index.boresight_error.max, 1e-6 * run.index.orientation_error.max) << rung;
  }
}

// Hung far ahead of its end it jams across both opposite edges: 2 c over L.
TEST(SliderInItsGuide, JamsAcrossOppositeEdges) {
  MechanismDescription m =
      slider(JournalAxes::free, "0*t", Vec3::UnitX(), Vec3::UnitY(), 0.0, Vec3(4.0 * kLength, 0.0, 0.0));
  m.clearances[0].parameters.contact.stiffness_scale = 10.0;
  m.motion.duration = 2e-3;
  for (const char* rung : {"quasistatic", "multibody", "perturbation"}) {
    const RunResult run = followed(rung, m);
    EXPECT_NEAR(run.index.boresight_error.max / (2.0 * kHeightGap / kLength), 1.0, 1e-2) << rung;
  }
  EXPECT_GE(followed("envelope", m).index.boresight_error.max, followed("quasistatic", m).index.boresight_error.max);
}

// Resting on its face it rocks with the frequency of K L^2 / 4 across its axis, and rolls with that of K W^2 / 12.
TEST(SliderInItsGuide, RocksAndRollsOnItsFace) {
  const Mechanism mechanism(slider(JournalAxes::free, nullptr));
  const double K = stiffness(mechanism.description());
  const double depth = kMass * kGravity / K;
  for (const bool paper : {false, true})
    for (const bool rolling : {false, true}) {
      const double lever = rolling ? kWidth / std::sqrt(12.0) : 0.5 * kLength;
      const double expected = std::sqrt(K * lever * lever / kInertia);
      const auto formulation = scenes::formulate(paper, mechanism);
      IdealState start = scenes::at_home(mechanism);
      start.bodies[0].p = -(kHeightGap + depth) * Vec3::UnitZ();
      const Vec3 about = rolling ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY());
      start.bodies[0].R = Eigen::AngleAxisd(0.3 * depth / (0.5 * kLength), about).toRotationMatrix();
      scenes::Stepper stepper(*formulation, start);
      const double h = 2.0 * std::numbers::pi / expected / 400.0;
      double passage[2] = {0.0, 0.0};
      const auto tilt = [&] {
        const Mat3& R = formulation->bodies(stepper.t, stepper.y)[0].R;
        return rolling ? R(2, 1) : R(2, 0);
      };
      double before = tilt();
      for (int passages = 0; passages < 2 && stepper.t < 2000.0 * h;) {
        stepper.step(h);
        const double now = tilt();
        if (before * now < 0.0) passage[passages++] = stepper.t - h * now / (now - before);
        before = now;
      }
      EXPECT_NEAR(std::numbers::pi / (passage[1] - passage[0]) / expected, 1.0, 1e-4) << paper << rolling;
    }
}

// Thrown about in its guide, from face to face and edge to edge, without anything that dissipates.
TEST(SliderInItsGuide, KeepsItsEnergyWhereNothingDissipates) {
  for (const bool paper : {false, true}) {
    const Mechanism mechanism(
        soft(slider(JournalAxes::free, nullptr, Vec3(0.9, -0.2, 0.3).normalized(), Vec3(0.2, 0.9, 0.0).normalized())));
    const auto formulation = scenes::formulate(paper, mechanism);
    const auto drift = [&](double h) {
      IdealState start = scenes::at_home(mechanism);
      start.bodies[0].v = Vec3(0.02, -0.03, 0.04);
      start.bodies[0].w = Vec3(1.0, 0.7, 0.5);
      scenes::Stepper stepper(*formulation, start);
      const double before = formulation->energy(0.0, stepper.y);
      double largest = 0.0;
      while (stepper.t < 0.03) {
        stepper.step(h);
        largest = std::max(largest, std::abs(formulation->energy(stepper.t, stepper.y) - before));
      }
      EXPECT_GT(stepper.contacts, 4);
      return largest / (0.5 * kMass * start.bodies[0].v.squaredNorm());
    };
    const double coarse = drift(2e-6), fine = drift(2.5e-7);
    EXPECT_LT(fine, 1e-8) << paper;
    EXPECT_GT(coarse / fine, 16.0) << paper;
  }
}

// Friction holds back what slides: mu g cos a t^2 / 2 behind the ideal motion, which knows none.
TEST(SliderInItsGuide, SlidesDownAnInclineWithCoulombsFriction) {
  const double slope = 0.5, mu = 0.2;
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    const MechanismDescription m =
        slider(axes, nullptr, Vec3(std::cos(slope), 0.0, -std::sin(slope)), Vec3::UnitY(), mu);
    const double t = m.motion.duration, expected = 0.5 * kGravity * mu * std::cos(slope) * t * t;
    const auto mechanism = scenes::build(m);
    for (const char* rung : {"multibody", "perturbation"}) {
      RunOptions options;
      options.step = 1e-6;
      const RunResult run = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
      EXPECT_NEAR(run.index.position_error.max, std::hypot(expected, kHeightGap), 2e-3 * expected) << rung;
    }
  }
}

// Nothing to cross leaves the ideal joint's motion, up to what its contact gives way by; little leaves little.
TEST(SliderInItsGuide, WithoutAGapIsAnIdealJoint) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    const auto error = [&](double gap) {
      MechanismDescription m = slider(axes, "0.01*sin(30*t)");
      m.clearances[0].contact_law = "flores";
      m.clearances[0].parameters.width_gap = m.clearances[0].parameters.height_gap = gap;
      const auto mechanism = scenes::build(m);
      return make_rung("perturbation", mechanism)->run(mechanism->parameters(), {}).index.position_error.max;
    };
    EXPECT_LT(error(0.0), 1e-7);
    for (const double gap : {1e-5, 1e-6}) {
      EXPECT_GT(error(gap), 0.99 * gap);
      EXPECT_LT(error(gap), 2.0 * gap);
    }
  }
}

// Shaken by its drive, with damping and friction, its weight beside its middle: perturbation against both formulations of multibody.
TEST(SliderInItsGuide, IsFollowedAlikeByAllRungs) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    MechanismDescription m = slider(axes, "0.02*sin(40*t)", Vec3::UnitX(), Vec3::UnitY(), 0.1, Vec3(5e-3, 8e-3, 20e-3));
    m.clearances[0].contact_law = "flores";
    m.clearances[0].parameters.contact.restitution = 0.5;
    m.clearances[0].parameters.friction = {.coefficient = 0.1, .static_speed = 1e-4, .dynamic_speed = 1e-3};
    m.motion.duration = 0.3;
    const auto mechanism = scenes::build(m);
    RunOptions options;
    const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
    options.formulation = "paper";
    const RunResult paper = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
    const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
    const RunResult still = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
    const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), {});
    const double reference = exact.index.position_error.rms;
    ASSERT_GT(reference, 1e-6);
    EXPECT_NEAR(paper.index.position_error.rms / reference, 1.0, 0.01);
    EXPECT_NEAR(linear.index.position_error.rms / reference, 1.0, 0.01);
    EXPECT_NEAR(still.index.position_error.rms / reference, 1.0, 0.1);
    EXPECT_GT(bound.index.position_error.max, still.index.position_error.max * (1.0 - 1e-9));
  }
}

}  // namespace rectangular_guide_test
}  // namespace boresight
