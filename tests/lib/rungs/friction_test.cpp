// Friction laws within the rungs: a journal that lies in an inclined sleeve along which it may slide.
#include <gtest/gtest.h>

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/rungs/rung.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace {

constexpr double kSlope = 20.0 * std::numbers::pi / 180.0;

std::shared_ptr<const Mechanism> incline(const std::string& friction, double coefficient, double duration) {
  MechanismDescription m;
  m.name = "incline";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  scenes::add_body(m, "block", 1.0, Vec3::Zero(), Vec3::Zero());
  m.bodies[0].inertia = 0.01 * Mat3::Identity();
  scenes::add_joint(m, JointType::cylindrical, kGround, 0, Vec3::Zero(),
                    Vec3(std::cos(kSlope), 0.0, -std::sin(kSlope)));
  scenes::add_clearance(m, 0, false);
  ClearanceDescription& c = m.clearances[0];
  c.friction_law = friction;
  c.parameters.contact.restitution = 0.3;
  c.parameters.friction.coefficient = coefficient;
  c.parameters.friction.bristle_damping = 30.0;
  m.motion.duration = duration;
  // It falls into the bore: one that starts at rest has no bristle bent yet, and swings on them for half a second.
  m.journals = JournalStart::centred;
  return scenes::build(std::move(m));
}

// Speed down the slope, and how far it has gone, at the end.
struct Slid {
  double speed, way;
};
Slid slide(const std::string& rung, const std::string& friction, double coefficient, double duration) {
  const auto mechanism = incline(friction, coefficient, duration);
  RunOptions options;
  options.sample_spacing = 0.05;
  const RunResult result = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
  const Vec3 along(std::cos(kSlope), 0.0, -std::sin(kSlope));
  const PoseSample& last = result.boresight.samples.back();
  return {last.v.dot(along), last.pose.p.dot(along)};
}

TEST(ModifiedCoulomb, CreepsDownAnInclineAtTheSpeedThatTheoryForesees) {
  // v_s + (v_d - v_s) tan(20 degrees) / mu = 0.1 + 0.9 * 0.727940 mm/s for mu = 0.5.
  EXPECT_NEAR(slide("multibody", "modified-coulomb", 0.5, 0.4).speed, 1e-4 + 0.727940469 * 0.9e-3, 1e-6);
}

TEST(LuGre, SticksOnAnInclineWhereModifiedCoulombCreeps) {
  const Slid early = slide("multibody", "lugre", 0.5, 0.3), late = slide("multibody", "lugre", 0.5, 0.5);
  EXPECT_NEAR(late.speed, 0.0, 2e-5);
  EXPECT_NEAR(late.way, early.way, 2e-6);  // modified Coulomb goes 1.5e-4 m in these 0.2 s
}

TEST(LuGre, SlidesDownAnInclineAsCoulombsFrictionDoes) {
  // mu = 0.1: 2.433379 m/s^2 once the block lies still in the bore.
  const double gained =
      slide("multibody", "lugre", 0.1, 0.4).speed - slide("multibody", "lugre", 0.1, 0.25).speed;
  EXPECT_NEAR(gained / 0.15, 2.433379145, 1e-3);
}

TEST(LuGre, MovesTheSameInPerturbationAndMultibody) {
  const Slid exact = slide("multibody", "lugre", 0.5, 0.3), linear = slide("perturbation", "lugre", 0.5, 0.3);
  EXPECT_NEAR(linear.way, exact.way, 1e-6);
}

TEST(FrictionLaws, OfEveryKindRunTheDefaultSceneAndStayFinite) {
  for (const FrictionLawEntry& law : friction_laws()) {
    const auto mechanism =
        scenes::build(scenes::rrcpr({{"motion.duration", "40 ms"}, {"clearance.F1.friction.law", law.name}}));
    const RunResult result = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
    EXPECT_TRUE(std::isfinite(result.index.position_error.rms)) << law.name;
    EXPECT_GT(result.index.position_error.max, 1e-5) << law.name;
    EXPECT_LT(result.index.position_error.max, 1e-3) << law.name;
  }
}

TEST(ContactLaws, OfEveryKindRunTheDefaultSceneAndStayFinite) {
  for (const NormalLawEntry& law : normal_laws()) {
    std::vector<Setting> settings = {{"motion.duration", "40 ms"}, {"clearance.F1.contact.law", law.name}};
    if (law.geometry == ContactGeometry::linear) {
      settings.push_back({"clearance.F1.contact.stiffness", "1e8 N/m"});
      settings.push_back({"clearance.F1.contact.damping", "1e3 N s/m"});
    }
    for (const char* rung : {"quasistatic", "perturbation"}) {
      const auto mechanism = scenes::build(scenes::rrcpr(settings));
      const RunResult result = make_rung(rung, mechanism)->run(mechanism->parameters(), {});
      EXPECT_GT(result.index.position_error.max, 1e-5) << law.name << " on " << rung;
      EXPECT_LT(result.index.position_error.max, 1e-3) << law.name << " on " << rung;
    }
  }
}

// Integrators that locate contacts read the same laws, their Jacobian included.
TEST(ContactLaws, OfOtherGeometriesMoveTheSameUnderExplicitAndImplicitSteps) {
  for (const char* law : {"johnson", "liu", "pereira"}) {
    const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "20 ms"},
                                                        {"clearance.F1.contact.law", law},
                                                        {"clearance.F1.friction.law", "brown-mcphee"}}));
    std::vector<double> rms;
    for (const char* integrator : {"dopri5", "rosenbrock"}) {
      RunOptions options;
      options.integrator = integrator;
      options.tolerance = 1e-5;
      rms.push_back(make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).index.position_error.rms);
    }
    EXPECT_NEAR(rms[0] / rms[1], 1.0, 1e-3) << law;
  }
}

TEST(LuGre, IsRefusedByIntegratorsThatDoNotCarryItsBristles) {
  const auto mechanism =
      scenes::build(scenes::rrcpr({{"motion.duration", "20 ms"}, {"clearance.F1.friction.law", "lugre"}}));
  RunOptions options;
  options.integrator = "dopri5";
  for (const char* rung : {"perturbation", "multibody"})
    EXPECT_THROW(make_rung(rung, mechanism)->run(mechanism->parameters(), options), std::invalid_argument) << rung;
}

}  // namespace
}  // namespace boresight
