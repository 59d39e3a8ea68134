// A rotor that nothing drives, in a tilting journal whose ends are pressed different ways: couples that hold its tilt do not turn it.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace unbalanced_rotor_test {

// Its centre of mass lies off its shaft and off the middle of its sleeve, and products of inertia rock it as it swings: 3 mrad of tilt.
std::shared_ptr<const Mechanism> rotor() {
  MechanismDescription m;
  m.name = "unbalanced rotor";
  m.gravity = Vec3(0.0, 0.0, -9.81);
  BodyDescription b;
  b.name = "rotor";
  b.mass = 5.0;
  b.center_of_mass = Vec3(0.02, 0.05, 0.0);
  b.inertia << 3e-2, 4e-3, 6e-3, 4e-3, 2.5e-2, -3e-3, 6e-3, -3e-3, 4e-2;
  b.boresight = Vec3::UnitX();
  m.bodies.push_back(b);
  JointDescription j;
  j.name = "shaft";
  j.type = JointType::revolute;
  j.first = kGround;
  j.second = 0;
  j.axis = Vec3::UnitY();
  m.joints.push_back(j);
  ClearanceDescription c;
  c.journal = 0;
  c.axes = JournalAxes::free;
  c.contact_law = "flores";
  c.friction_law = "none";
  c.parameters.radial = 0.1e-3;
  c.parameters.axial = 0.05e-3;
  c.parameters.journal_radius = 10e-3;
  c.parameters.cap_radius = 15e-3;
  c.parameters.sleeve_length = 60e-3;
  c.parameters.contact.young = {72e9, 72e9};
  c.parameters.contact.poisson = {0.33, 0.33};
  m.clearances.push_back(c);
  m.motion.duration = 0.5;
  return scenes::build(m);
}

TEST(UnbalancedRotor, IsNotTurnedByTheCouplesThatHoldItsTilt) {
  const auto mechanism = rotor();
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
  const RunResult linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
  ASSERT_EQ(exact.time, linear.time);
  double most = 0.0, off = 0.0;  // of the turn about the shaft, against the ideal motion
  for (std::size_t k = 0; k < exact.time.size(); ++k) {
    const double turn = exact.boresight.samples[k].error.rotation.y();
    most = std::max(most, std::abs(turn));
    off = std::max(off, std::abs(linear.boresight.samples[k].error.rotation.y() - turn));
  }
  EXPECT_GT(most, 1e-4);
  // The tilt of 3 mrad squared, over the motion; it was twice the turn itself.
  EXPECT_LT(off, 0.1 * most);
}

}  // namespace unbalanced_rotor_test
}  // namespace boresight
