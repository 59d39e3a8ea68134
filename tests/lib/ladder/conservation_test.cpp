// What Newton's equations keep: energy where nothing dissipates, momentum where nothing pushes from outside,
// and the integrator's order where nothing impacts.
#include <gtest/gtest.h>

#include "boresight/multibody/multibody.hpp"
#include "scenes.hpp"
#include "stepper.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace conservation_test {

using scenes::at_home;
using scenes::formulate;
using scenes::Stepper;

// All six drives let go: the platform falls on its legs, the journal rattles elastically.
void expect_energy_kept(bool paper, JournalAxes axes) {
  MechanismDescription description =
      scenes::rrcpr({{"clearance.F1.contact.law", "hertz"}, {"clearance.F1.friction.law", "none"}});
  for (JointDescription& j : description.joints) j.driven = false;
  description.motion.pose.reset();
  description.clearances[0].axes = axes;
  const Mechanism mechanism(description);
  const auto relative_loss = [&](double h) {
    const auto formulation = formulate(paper, mechanism);
    Stepper stepper(*formulation, at_home(mechanism));
    const double before = formulation->energy(0.0, stepper.y);
    double kinetic_scale = 0.0;
    while (stepper.t < 0.1 - 0.5 * h) stepper.step(h);
    kinetic_scale = 0.5 * 15.0 * 9.81 * 9.81 * 0.01;  // the platform alone, fallen freely for 0.1 s [J]
    EXPECT_GT(stepper.contacts, 4) << "the scene must impact";
    return std::abs(formulation->energy(stepper.t, stepper.y) - before) / kinetic_scale;
  };
  // Every impact loses O(h^2.5): the loss is small, and shrinks at least fourfold with half the step, sixteenfold with a quarter.
  const double coarse = relative_loss(2e-5), fine = relative_loss(5e-6);
  EXPECT_LT(coarse, 1e-7);
  EXPECT_GT(coarse / fine, 16.0);
}

TEST(Formulations, KeepTheEnergyOfAFreeMechanismWithoutFrictionAndDamping) {
  for (bool paper : {false, true})
    for (JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) expect_energy_kept(paper, axes);
}

void expect_momenta_kept(bool paper, JournalAxes axes) {
  MechanismDescription description = scenes::rrcpr();
  // Cut loose from the ground: the legs keep all their joints but the first.
  std::erase_if(description.joints, [](const JointDescription& j) { return j.name.starts_with("A"); });
  for (JointDescription& j : description.joints) j.driven = false;
  description.motion.pose.reset();
  description.gravity.setZero();
  for (ClearanceDescription& c : description.clearances)
    for (std::size_t j = 0; j < description.joints.size(); ++j)
      if (description.joints[j].name == "F1") c.joint = static_cast<int>(j);
  description.clearances[0].axes = axes;
  const Mechanism mechanism(description);
  const auto formulation = formulate(paper, mechanism);
  IdealState start = at_home(mechanism);
  // A push that the constraints allow: the whole system translates and turns, and one leg's projection does
  // the rest.
  for (std::size_t b = 0; b < start.bodies.size(); ++b) {
    const Vec3 w(0.3, -0.2, 0.5);
    start.bodies[b].w = w;
    start.bodies[b].v = Vec3(0.1, 0.2, -0.1) + w.cross(start.bodies[b].p);
  }
  start.bodies[mechanism.boresight_body()].v += Vec3(0.3, -0.1, 0.2);
  Stepper stepper(*formulation, start);
  formulation->stabilise(0.0, stepper.y);
  const std::vector<MassProperties> mass = mechanism.mass_properties(mechanism.parameters());
  const auto momenta = [&] {
    Vec6 sum = Vec6::Zero();
    const std::vector<BodyMotion>& bodies = formulation->bodies(stepper.t, stepper.y);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vec3 p = mass[b].mass * bodies[b].v;
      sum.head<3>() += p;
      sum.tail<3>() += bodies[b].p.cross(p) + bodies[b].R * mass[b].inertia * bodies[b].R.transpose() * bodies[b].w;
    }
    return sum;
  };
  const Vec6 before = momenta();
  for (int k = 0; k < 4000; ++k) stepper.step(2e-5);
  EXPECT_GT(stepper.contacts, 2) << "the scene must impact";
  // RK4 keeps what is linear in the state to rounding, as linear momentum is in absolute coordinates; angular
  // momentum, and both in joint coordinates, to its own order: (w h)^4 a step, far below 1e-8 in all.
  EXPECT_LT((momenta() - before).head<3>().norm(), (paper ? 1e-11 : 1e-8) * before.head<3>().norm());
  EXPECT_LT((momenta() - before).tail<3>().norm(), (paper ? 1e-9 : 1e-8) * before.tail<3>().norm());
}

TEST(Formulations, KeepTheMomentaOfAFloatingSystemWithFrictionAndImpacts) {
  for (bool paper : {false, true})
    for (JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) expect_momenta_kept(paper, axes);
}

TEST(Multibody, ConvergesWithOrderFourBeforeTheFirstContact) {
  // A gap so wide that the journal flies for the whole run.
  const auto mechanism = scenes::build(
      scenes::rrcpr({{"motion.duration", "0.016 s"}, {"clearance.F1.radial", "5 mm"}, {"clearance.F1.axial", "5 mm"}}));
  const auto rung = make_multibody(mechanism);
  const auto end = [&](double h) {
    RunOptions options;
    options.step = h;
    options.sample_spacing = 0.016;
    const RunResult r = rung->run(mechanism->parameters(), options);
    EXPECT_EQ(r.contact[0].impacts, 0);
    return r.boresight.samples.back().pose.p;
  };
  const Vec3 exact = end(0.016 / 256);
  const double coarse = (end(0.016 / 8) - exact).norm(), fine = (end(0.016 / 16) - exact).norm();
  EXPECT_GT(fine, 1e-13) << "below this rounding decides";
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.35);
}

}  // namespace conservation_test
}  // namespace boresight
