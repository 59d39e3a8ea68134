// Where journals rest: the balance of forces by the contact laws that the rungs with dynamics use.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boresight/play/joint_play.hpp"
#include "scenes.hpp"

namespace boresight {
namespace quasistatic_offset_test {

using Offsets = Eigen::Matrix<double, 5, 1>;

JournalInSleeve journal(bool tilts, double friction) {
  MechanismDescription d = scenes::rrcpr();
  ClearanceDescription& c = d.clearances[0];
  c.axes = tilts ? JournalAxes::free : JournalAxes::parallel;
  c.parameters.friction.coefficient = friction;
  return JournalInSleeve(c, JointType::revolute, c.parameters);
}

// What the contacts do to the five offsets of a journal at rest there.
Offsets contact_forces(const JournalInSleeve& joint, const PlayMotion<double>& motion) {
  std::array<double, kContactPlaces> impact_speed;
  impact_speed.fill(1e-3);
  PlayWrench<double> wrench;
  joint.wrench(motion, impact_speed, wrench);
  const Vec3 moment = wrench.moment - motion.e.cross(wrench.force);
  // moment = a' x (g_x, -g . sigma, g_z), a' = (sigma_x, 1, sigma_z): see tilted_journal.hpp.
  const double sx = motion.slope[0], sz = motion.slope[1];
  const double work = (sz * moment.x() - sx * moment.z()) / (1.0 + sx * sx + sz * sz);
  Offsets of;
  of << wrench.force, -moment.z() - sx * work, moment.x() - sz * work;
  return of;
}

Offsets load(double x, double y, double z, double gx, double gz) {
  Offsets l;
  l << x, y, z, gx, gz;
  return l;
}

// A journal has no roll.
PlayOffsets of_play(const Offsets& load) {
  PlayOffsets all;
  all << load, 0.0;
  return all;
}

TEST(RestingPlay, BalancesItsLoadByTheContactLaw) {
  const JournalInSleeve joint = journal(true, 0.0);
  const Offsets loads[] = {load(100, 0, 50, 0, 0),      load(100, 30, 0, 0.4, -0.2), load(3, -200, 1, 0.5, 0.1),
                           load(0, 150, 0, 1.2, 0),     load(0, 150, 0, 4.0, -3.0),  load(-40, 1, 20, -6, 9),
                           load(1e-3, 1e3, 0, 0, 1e-3), load(500, -500, 500, 5, 5),  load(0, 0, 0, 2.0, 1.0)};
  RestingPlay rest;
  for (const Offsets& l : loads) {
    rest = joint.rest_under(of_play(l), {}, rest);
    const Offsets left = l + contact_forces(joint, rest.motion);
    EXPECT_LT(left.head<3>().norm(), 1e-6 * (l.head<3>().norm() + l.tail<2>().norm() / joint.half_length))
        << l.transpose();
    EXPECT_LT(left.tail<2>().norm(), 1e-6 * (l.tail<2>().norm() + l.head<3>().norm() * joint.half_length))
        << l.transpose();
  }
}

// Closed form: K_c rho^2 / 2 resists the tilt of a face in full contact, which it stays in while the couple
// is below half of what the load at the ring's edge holds.
TEST(RestingPlay, StandsEvenlyOnItsFaceUntilTheCoupleLiftsAnEdge) {
  const JournalInSleeve joint = journal(true, 0.03);
  const double weight = 200.0, ring = joint.tilted.ring_radius, lifts = 0.5 * weight * ring;
  for (double share : {0.1, 0.5, 0.99}) {
    const RestingPlay rest = joint.rest_under(of_play(load(0.0, -weight, 0.0, share * lifts, 0.0)), {}, {});
    EXPECT_NEAR(rest.motion.slope[0], 2.0 * share * lifts / (joint.face_stiffness * ring * ring),
                1e-6 * rest.motion.slope[0]);
    EXPECT_NEAR(rest.motion.e.y(), -(joint.axial_clearance + weight / joint.face_stiffness), 1e-12);
    EXPECT_EQ(rest.contact[static_cast<int>(ContactPlace::radial_minus)].normal_force, 0.0);
  }
  // Beyond what the ring's edge carries it falls against the ends of the bore.
  const RestingPlay fallen = joint.rest_under(of_play(load(0.0, -weight, 0.0, 2.5 * lifts, 0.0)), {}, {});
  EXPECT_GT(fallen.motion.slope.norm(), 0.99 * joint.radial_clearance / joint.half_length);
}

TEST(RestingPlay, StaysWhereItWasWhereNoForceMovesIt) {
  const JournalInSleeve joint = journal(true, 0.03);
  RestingPlay before;
  before.motion.e << 3e-5, 0.0, -2e-5;
  const RestingPlay rest = joint.rest_under(of_play(load(0.0, -200.0, 0.0, 0.0, 0.0)), {}, before);
  EXPECT_NEAR(rest.motion.e.x(), 3e-5, 1e-9);
  EXPECT_NEAR(rest.motion.e.z(), -2e-5, 1e-9);
  EXPECT_LT(rest.motion.e.y(), -joint.axial_clearance);
}

// Closed form: each end of a tilting journal lies in the direction of what it carries. Under next to no load the force that a last digit of
// the place makes is no small part of it, and the way round the sleeve from where the journal was is thousands of steps long.
TEST(RestingPlay, ArrivesWhereItsLoadPointsFromWhereverItWas) {
  const JournalInSleeve joint = journal(true, 0.0);
  for (const double size : {2e-5, 1e-2, 10.0})
    for (const double share : {0.0, 0.3, 1.5}) {
      const double couple = share * size * joint.half_length;
      const PlayOffsets pushes = of_play(load(0.8 * size, 0.0, -0.6 * size, -0.6 * couple, -0.8 * couple));
      for (int turn = 0; turn < 12; ++turn) {
        RestingPlay before;
        const double angle = 0.1 + turn * std::numbers::pi / 6.0;
        before.motion.e << joint.radial_clearance * std::cos(angle), 0.0, joint.radial_clearance * std::sin(angle);
        const RestingPlay rest = joint.rest_under(pushes, {}, before);
        for (const int side : {-1, 1}) {
          const Vec2T<double> force = 0.5 * (Vec2T<double>(pushes[0], pushes[2]) +
                                             side / joint.half_length * Vec2T<double>(pushes[3], pushes[4]));
          const Vec2T<double> expected =
              (joint.radial_clearance + joint.tilted.end_law.depth_under(force.norm())) * force.normalized();
          const Vec2T<double> end(rest.motion.e.x() + side * joint.half_length * rest.motion.slope[0],
                                  rest.motion.e.z() + side * joint.half_length * rest.motion.slope[1]);
          EXPECT_LT((end - expected).norm(), 1e-8 * joint.radial_clearance) << size << " N, from " << angle;
        }
      }
    }
}

}  // namespace quasistatic_offset_test
}  // namespace boresight
