// Friction laws within the rungs: a journal that lies in an inclined sleeve along which it may slide.
#include <gtest/gtest.h>

#include <algorithm>

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace friction_test {

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
  // v_s + (v_d - v_s) tan(20 degrees) / mu.
  EXPECT_NEAR(slide("multibody", "modified-coulomb", 0.5, 0.4).speed, 1e-4 + 0.9e-3 * std::tan(kSlope) / 0.5, 1e-6);
}

TEST(LuGre, SticksOnAnInclineWhereModifiedCoulombCreeps) {
  const Slid early = slide("multibody", "lugre", 0.5, 0.3), late = slide("multibody", "lugre", 0.5, 0.5);
  EXPECT_NEAR(late.speed, 0.0, 2e-5);
  EXPECT_NEAR(late.way, early.way, 2e-6);  // modified Coulomb goes 1.5e-4 m in these 0.2 s
}

TEST(LuGre, SlidesDownAnInclineAsCoulombsFrictionDoes) {
  // g (sin - mu cos) once the block lies still in the bore.
  const double gained = slide("multibody", "lugre", 0.1, 0.4).speed - slide("multibody", "lugre", 0.1, 0.25).speed;
  EXPECT_NEAR(gained / 0.15, 9.81 * (std::sin(kSlope) - 0.1 * std::cos(kSlope)), 1e-3);
}

TEST(LuGre, MovesTheSameInPerturbationAndMultibody) {
  const Slid exact = slide("multibody", "lugre", 0.5, 0.3), linear = slide("perturbation", "lugre", 0.5, 0.3);
  EXPECT_NEAR(linear.way, exact.way, 1e-6);
}

RunResult default_scene(const char* rung, const std::vector<Setting>& settings) {
  const auto mechanism = scenes::build(scenes::rrcpr(settings));
  RunOptions options;
  options.integrator = "rk4";  // for both, whatever it follows
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

// Perturbation and multibody share the law and nothing of the equations of motion: through the first impacts they move the same, up to
// what perturbation leaves out (0.2 % of the maximum where the offset is a tenth of a millimetre) and the contacts' steps.
void expect_same_through_impacts(const RunResult& perturbation, const RunResult& multibody, const char* law) {
  EXPECT_GE(multibody.contact[0].impacts, 3) << law << ": the scene must impact";
  EXPECT_NEAR(perturbation.index.position_error.max / multibody.index.position_error.max, 1.0, 1e-3) << law;
  EXPECT_NEAR(perturbation.index.position_error.rms / multibody.index.position_error.rms, 1.0, 5e-3) << law;
  EXPECT_NEAR(perturbation.contact[0].max_force / multibody.contact[0].max_force, 1.0, 3e-3) << law;
}

TEST(FrictionLaws, OfEveryKindMoveTheDefaultSceneTheSameInPerturbationAndMultibody) {
  double without = 0.0;
  std::vector<double> rubbing;
  for (const FrictionLawEntry& law : friction_laws()) {
    const std::vector<Setting> settings = {{"motion.duration", "40 ms"}, {"clearance.F1.friction.law", law.name}};
    const RunResult multibody = default_scene("multibody", settings);
    expect_same_through_impacts(default_scene("perturbation", settings), multibody, law.name);
    const double max = multibody.index.position_error.max;
    if (law.kind == FrictionKind::none) {
      without = max;
    } else {
      rubbing.push_back(max);
    }
  }
  // All laws which rub agree a hundred times better among themselves than with none: they act, and with the coefficient that they were given;
  // at these speeds they differ in nothing else.
  const auto [least, most] = std::minmax_element(rubbing.begin(), rubbing.end());
  EXPECT_LT(*most / *least - 1.0, 1e-4);
  EXPECT_GT(std::abs(*least / without - 1.0), 100.0 * (*most / *least - 1.0));
  EXPECT_GT(std::abs(*least / without - 1.0), 5e-3);
}

TEST(ContactLaws, OfEveryKindMoveTheDefaultSceneTheSameInPerturbationAndMultibody) {
  double first_lever = 0.0;
  for (const NormalLawEntry& law : normal_laws()) {
    std::vector<Setting> settings = {{"motion.duration", "40 ms"}, {"clearance.F1.contact.law", law.name}};
    if (law.geometry == ContactGeometry::linear) {
      settings.push_back({"clearance.F1.contact.stiffness", "1e8 N/m"});
      settings.push_back({"clearance.F1.contact.damping", "1e3 N s/m"});
    }
    expect_same_through_impacts(default_scene("perturbation", settings), default_scene("multibody", settings),
                                law.name);
    // A journal at rest lies as deep as its law says under the force that the ideal motion needs, and the error is what the mechanism makes
    // of clearance and depth: one lever, whatever the law.
    const RunResult rest = default_scene("quasistatic", settings);
    const Mechanism mechanism(scenes::rrcpr(settings));
    const ClearanceParameters& clearance = mechanism.parameters().clearance[0];
    const double depth = make_normal_law(law.name, "", clearance).depth_under(rest.contact[0].max_force);
    EXPECT_NEAR(rest.contact[0].max_penetration / depth, 1.0, 1e-6) << law.name;
    const double lever = rest.index.position_error.max / (clearance.radial + depth);
    if (first_lever == 0.0) first_lever = lever;
    EXPECT_NEAR(lever / first_lever, 1.0, 1e-5) << law.name;
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
      rms.push_back(
          make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).index.position_error.rms);
    }
    EXPECT_NEAR(rms[0] / rms[1], 1.0, 1e-3) << law;
  }
}

TEST(LuGre, IsCarriedByEveryIntegratorThatKnowsItsContacts) {
  const auto mechanism =
      scenes::build(scenes::rrcpr({{"motion.duration", "60 ms"}, {"clearance.F1.friction.law", "lugre"}}));
  for (const char* rung : {"perturbation", "multibody"}) {
    const auto run = [&](const char* integrator, double step, double tolerance) {
      RunOptions options;
      options.integrator = integrator;
      options.step = step;
      options.tolerance = tolerance;
      return make_rung(rung, mechanism)->run(mechanism->parameters(), options).index.position_error;
    };
    const Statistics steps = run("rk4", 2e-6, 0.0);
    for (const char* integrator : {"dopri5", "rosenbrock"}) {
      const Statistics located = run(integrator, 0.0, 1e-4);
      EXPECT_NEAR(located.max / steps.max, 1.0, 2e-3) << rung << ", " << integrator;
      EXPECT_NEAR(located.rms / steps.rms, 1.0, 2e-3) << rung << ", " << integrator;
    }
  }
}

}  // namespace friction_test
}  // namespace boresight
