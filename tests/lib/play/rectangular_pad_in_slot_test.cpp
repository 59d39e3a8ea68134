// A rectangular pad in its slot against the equations of its corners, the gradient of its energy, and its rest against closed forms.
#include "boresight/play/pad/rectangular_pad_in_slot.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "boresight/contact_events/contact_jacobian.hpp"
#include "boresight/play/flat_face_stiffness.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace rectangular_pad_in_slot_test {

constexpr double kGap = 0.05e-3, kWidth = 60e-3, kLength = 90e-3;
constexpr int kFirst = static_cast<int>(ContactPlace::axial_minus_left_rear), kCorners = 8;

ClearanceDescription description(JournalAxes axes, const char* law = "flores", double friction = 0.0) {
  ClearanceDescription d;
  d.pad = PadShape::rectangular;
  d.contact_law = law;
  d.axes = axes;
  d.parameters.axial = kGap;
  d.parameters.width = kWidth;
  d.parameters.length = kLength;
  d.parameters.contact.restitution = 0.7;
  d.parameters.friction.coefficient = friction;
  return d;
}

JointPlay pad(const ClearanceDescription& d) { return JointPlay(d, JointType::planar, d.parameters); }
JointPlay pad(JournalAxes axes, const char* law = "flores", double friction = 0.0) {
  return pad(description(axes, law, friction));
}

ImpactSpeeds<double> speeds(double v) {
  ImpactSpeeds<double> all;
  all.fill(v);
  return all;
}

Vec2T<double> turned(double angle) { return {std::cos(angle), std::sin(angle)}; }

void turn_with_spin(PlayMotion<double>& m) {
  const Vec3 a(m.slope[0], 1.0, m.slope[1]), a_dot = m.w.cross(a);
  m.slope_rate = {a_dot.x() - a_dot.y() * m.slope[0], a_dot.z() - a_dot.y() * m.slope[1]};
}

// Anywhere that it can be, however far it is twisted, at any speed.
PlayMotion<double> anywhere(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3(uniform(generator), uniform(generator), uniform(generator)); };
  PlayMotion<double> m;
  m.e = Vec3(0.2 * uniform(generator), 1.1 * kGap * uniform(generator), 0.2 * uniform(generator));
  m.e_dot = 0.02 * vector();
  m.w = 0.5 * vector();
  m.slope = 1.2 * kGap / kWidth * Vec2T<double>(uniform(generator), uniform(generator));
  m.twist = turned(std::numbers::pi * uniform(generator));
  turn_with_spin(m);
  return m;
}

double power(const PlayWrench<double>& wrench, const PlayMotion<double>& m) {
  return wrench.force.dot(m.e_dot) + (wrench.moment - m.e.cross(wrench.force)).dot(m.w);
}

PlayMotion<double> later(PlayMotion<double> m, double dt) {
  m.e += dt * m.e_dot;
  m.slope += dt * m.slope_rate;
  m.twist = turned(std::atan2(m.twist[1], m.twist[0]) + dt * m.w.dot(roll_axis(m)));
  return m;
}

double pressed(const PlayWrench<double>& wrench) {
  double sum = 0.0;
  for (int k = 0; k < kCorners; ++k) sum += wrench.contact[static_cast<std::size_t>(kFirst + k)].normal_force;
  return sum;
}

TEST(RectangularPad, IsAKindOfItsOwn) {
  const JointPlay law = pad(JournalAxes::free);
  EXPECT_TRUE(std::holds_alternative<RectangularPadInSlot>(law.kind));
  EXPECT_EQ(law.places().size(), 8u);
  for (const ContactPlace place : law.places()) EXPECT_TRUE(is_axial(place)) << to_string(place);
  ClearanceDescription round = description(JournalAxes::free);
  round.pad = PadShape::round;
  EXPECT_TRUE(std::holds_alternative<PadInSlot>(pad(round).kind));
}

// All four corners of a face at once are the whole flat punch, whatever the twist.
TEST(RectangularPad, PressedFlatIsTheWholePunch) {
  const ClearanceDescription d = description(JournalAxes::free);
  const double K = flat_face_stiffness(d.parameters.contact, kWidth, kLength), h = 8.0 * 0.3 / (5.0 * 0.7);
  const double depth = 2e-6, rate = 0.01, v0 = 0.03;
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free})
    for (const int side : {-1, 1})
      for (const double angle : {0.0, 0.7, 2.9}) {
        PlayMotion<double> m{{0.1, side * (kGap + depth), -0.2}, {0.0, side * rate, 0.0}, Vec3::Zero()};
        m.twist = turned(angle);
        PlayWrench<double> wrench;
        pad(axes).wrench(m, speeds(v0), wrench);
        const double F = K * depth * (1.0 + h * rate / v0);
        EXPECT_NEAR(wrench.force.y(), -side * F, 1e-9 * F);
        EXPECT_LT((wrench.moment - m.e.cross(wrench.force)).norm(), 1e-12 * F);
        for (int k = 0; k < kCorners; ++k)
          EXPECT_NEAR(wrench.contact[static_cast<std::size_t>(kFirst + k)].normal_force,
                      (k < 4) == (side < 0) ? 0.25 * F : 0.0, 1e-9 * F);
      }
}

// The corner whose name says where it is touches first, in the pad's own directions.
TEST(RectangularPad, TouchesWithTheCornerOfThatName) {
  const JointPlay law = pad(JournalAxes::free);
  const struct {
    ContactPlace place;
    int side, across, along;
  } corners[] = {{ContactPlace::axial_minus_left_rear, -1, -1, -1}, {ContactPlace::axial_minus_right_rear, -1, 1, -1},
                 {ContactPlace::axial_minus_left_front, -1, -1, 1}, {ContactPlace::axial_minus_right_front, -1, 1, 1},
                 {ContactPlace::axial_plus_left_rear, 1, -1, -1},   {ContactPlace::axial_plus_right_rear, 1, 1, -1},
                 {ContactPlace::axial_plus_left_front, 1, -1, 1},   {ContactPlace::axial_plus_right_front, 1, 1, 1}};
  for (const double angle : {0.0, 1.1, -2.5})
    for (const auto& c : corners) {
      const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
      const Vec3 corner = R * Vec3(0.5 * c.across * kWidth, 0.0, 0.5 * c.along * kLength);
      PlayMotion<double> m{{0.0, c.side * 0.5 * kGap, 0.0}, Vec3::Zero(), Vec3::Zero()};
      // The plane of the pad rises towards that corner: y = -sigma . (x, z).
      const double tilt = 0.6 * kGap / corner.squaredNorm();
      m.slope = -c.side * tilt * Vec2T<double>(corner.x(), corner.z());
      m.twist = turned(angle);
      ContactStates<double> contact;
      law.penetrations(m, contact);
      for (const ContactPlace place : law.places())
        EXPECT_EQ(contact[static_cast<std::size_t>(place)].penetration > 0.0, place == c.place)
            << to_string(place) << " where " << to_string(c.place) << " should, " << angle;
    }
}

TEST(RectangularPad, ElasticForcesTakeFromTheEnergyWhatTheyGive) {
  std::mt19937 generator(7);
  const JointPlay law = pad(JournalAxes::free, "hertz");
  int touching = 0, both = 0;
  for (int k = 0; k < 6000; ++k) {
    const PlayMotion<double> m = anywhere(generator);
    PlayWrench<double> wrench;
    law.wrench(m, speeds(0.01), wrench);
    const double size = pressed(wrench);
    if (size == 0.0) continue;
    ++touching;
    double minus = 0.0;
    for (int c = 0; c < 4; ++c) minus += wrench.contact[static_cast<std::size_t>(kFirst + c)].normal_force;
    both += minus > 0.0 && minus < size;
    const double dt = 2e-9;
    const double fed = (law.elastic_energy(later(m, dt)) - law.elastic_energy(later(m, -dt))) / (2.0 * dt);
    EXPECT_NEAR(power(wrench, m), -fed, 1e-6 * size * 0.05) << k;
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(both, 100);
}

// The rates that contacts are damped by are those of their depths.
TEST(RectangularPad, DepthsChangeByTheirRates) {
  std::mt19937 generator(3);
  const JointPlay law = pad(JournalAxes::free);
  for (int k = 0; k < 200; ++k) {
    const PlayMotion<double> m = anywhere(generator);
    ContactStates<double> now, before, after;
    const double dt = 1e-7;
    law.penetrations(m, now);
    law.penetrations(later(m, -dt), before);
    law.penetrations(later(m, dt), after);
    for (const ContactPlace place : law.places()) {
      const auto p = static_cast<std::size_t>(place);
      EXPECT_NEAR((after[p].penetration - before[p].penetration) / (2.0 * dt), now[p].rate, 1e-8) << k;
    }
  }
}

TEST(RectangularPad, DampingNeverGivesPower) {
  std::mt19937 generator(11);
  for (const char* name : {"flores", "exact", "kelvin-voigt"}) {
    ClearanceDescription d = description(JournalAxes::free, name);
    d.parameters.contact.linear_stiffness = 2e8;
    d.parameters.contact.linear_damping = 300.0;
    const JointPlay law = pad(d), elastic = law.elastic_only();
    int damped = 0;
    for (int k = 0; k < 1000; ++k) {
      const PlayMotion<double> m = anywhere(generator);
      PlayWrench<double> with, without;
      law.wrench(m, speeds(0.01), with);
      elastic.wrench(m, speeds(0.01), without);
      for (const ContactState<double>& c : with.contact) EXPECT_GE(c.normal_force, 0.0);
      EXPECT_LE(power(with, m), power(without, m) + 1e-9 * std::abs(power(without, m))) << name << ' ' << k;
      damped += power(with, m) < power(without, m);
    }
    EXPECT_GT(damped, 200) << name;
  }
}

// Turned by a right angle with width and length changed over, it is the same pad.
TEST(RectangularPad, TurnedByARightAngleItsSidesChangeOver) {
  std::mt19937 generator(5);
  ClearanceDescription d = description(JournalAxes::free, "flores", 0.2);
  const JointPlay one = pad(d);
  std::swap(d.parameters.width, d.parameters.length);
  const JointPlay other = pad(d);
  for (int k = 0; k < 500; ++k) {
    const PlayMotion<double> m = anywhere(generator);
    PlayMotion<double> quarter = m;
    quarter.twist = {-m.twist[1], m.twist[0]};
    PlayWrench<double> a, b;
    one.wrench(m, speeds(0.01), a);
    other.wrench(quarter, speeds(0.01), b);
    EXPECT_LT((a.force - b.force).norm(), 1e-9 * (1.0 + a.force.norm())) << k;
    EXPECT_LT((a.moment - b.moment).norm(), 1e-9 * (1.0 + a.moment.norm())) << k;
    PlayOffsets load = PlayOffsets::Zero();
    load << 0.0, 100.0, 0.0, 2.0, -1.0, 0.0;
    const PlayOffsets rest = offsets_of(one.rest_under(load, {.twist = m.twist}, {}).motion);
    EXPECT_LT((rest - offsets_of(other.rest_under(load, {.twist = quarter.twist}, {}).motion)).norm(), 1e-9 * kGap);
  }
}

// A pad that twists on a face rubs at its four corners, each at its own distance from the middle: mu F hypot(w, l).
TEST(RectangularPad, TwistingRubs) {
  const double mu = 0.2, depth = 2e-6;
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    PlayMotion<double> m{{0.1, kGap + depth, -0.2}, Vec3::Zero(), {0.0, 3.0, 0.0}};
    m.twist = turned(0.4);
    PlayWrench<double> wrench;
    pad(axes, "flores", mu).wrench(m, speeds(0.01), wrench);
    const double F = -wrench.force.y();
    EXPECT_NEAR((wrench.moment - m.e.cross(wrench.force)).y(), -mu * F * 0.5 * std::hypot(kWidth, kLength), 1e-9 * F);
    EXPECT_NEAR(std::hypot(wrench.force.x(), wrench.force.z()), 0.0, 1e-9 * F);
    // Sliding alone is Coulomb's friction of the whole.
    m.w.setZero();
    m.e_dot = {0.3, 0.0, -0.4};
    pad(axes, "flores", mu).wrench(m, speeds(0.01), wrench);
    EXPECT_NEAR(wrench.force.x(), -mu * F * 0.6, 1e-9 * F);
    EXPECT_NEAR(wrench.force.z(), mu * F * 0.8, 1e-9 * F);
  }
}

TEST(RectangularPad, WhatDoesNotTouchGivesNoForce) {
  JointPlay law = pad(JournalAxes::free);
  PlayMotion<double> m{{0.0, kGap + 1e-6, 0.0}, Vec3::Zero(), Vec3::Zero()};
  std::array<bool, kContactPlaces> touching{};
  touching[static_cast<std::size_t>(ContactPlace::axial_plus_right_front)] = true;
  law.keep_only(touching);
  PlayWrench<double> wrench;
  law.wrench(m, speeds(0.01), wrench);
  for (const ContactPlace place : law.places())
    EXPECT_EQ(wrench.contact[static_cast<std::size_t>(place)].normal_force > 0.0,
              place == ContactPlace::axial_plus_right_front);
}

// The load balances what the corners give, on four of them, on an edge, on one, or jammed between both faces.
TEST(RectangularPad, RestsWhereItsLoadIsBalanced) {
  const JointPlay law = pad(JournalAxes::free);
  for (const double angle : {0.0, 0.5, -2.0})
    for (const double force : {-3000.0, -10.0, 0.0, 800.0})
      for (const double share : {0.0, 0.2, 0.5, 0.8, 0.99, 1.5, 40.0}) {
        PlayOffsets load = PlayOffsets::Zero();
        load[1] = force;
        load.segment<2>(3) = 0.5 * share * std::max(10.0, std::abs(force)) * kWidth * Vec2T<double>(0.6, -0.8);
        if (load.isZero()) continue;
        const RestingPlay rest = law.rest_under(load, {.twist = turned(angle)}, {});
        EXPECT_EQ(rest.motion.twist, turned(angle));
        PlayWrench<double> wrench;
        law.elastic_only().wrench(rest.motion, speeds(1.0), wrench);
        const double size = load.head<3>().norm() + load.segment<2>(3).norm() / (0.5 * kWidth);
        EXPECT_NEAR(wrench.force.y() + force, 0.0, 1e-7 * size) << force << ' ' << share << ' ' << angle;
        // What works along the axis alone is the twist's, which the joint carries.
        Vec3 couple = couples_of(Vec3(wrench.moment - rest.motion.e.cross(wrench.force)), rest.motion);
        EXPECT_LT(std::hypot(couple[0] + load[3], couple[1] + load[4]) / (0.5 * kWidth), 1e-7 * size)
            << force << ' ' << share << ' ' << angle;
        EXPECT_NEAR(rest.axial_reach, kGap + std::max(std::abs(force) / law.axial_stiffness(), rest.penetration()),
                    1e-9 * kGap);
      }
}

// All four corners bear until the couples reach the edge of the middle that keeps them down, |g_1| / w + |g_2| / l = F; the tilt is Hooke's.
TEST(RectangularPad, AllCornersBearAsLongAsTheLoadIsWithinItsCore) {
  const JointPlay law = pad(JournalAxes::free);
  const double F = 500.0, K = law.axial_stiffness(), w = 0.5 * kWidth, l = 0.5 * kLength;
  for (const double of_width : {0.3, 0.6}) {
    const auto bearing = [&](double share) {
      PlayOffsets load = PlayOffsets::Zero();
      load << 0.0, F, 0.0, of_width * share * F * w, (1.0 - of_width) * share * F * l, 0.0;
      const RestingPlay rest = law.rest_under(load, {}, {});
      int count = 0;
      for (const ContactState<double>& c : rest.contact) count += c.normal_force > 0.0;
      if (share < 1.0) {
        EXPECT_NEAR(rest.motion.slope[0] / (load[3] / (K * w * w)), 1.0, 1e-9);
        EXPECT_NEAR(rest.motion.slope[1] / (load[4] / (K * l * l)), 1.0, 1e-9);
        EXPECT_NEAR(rest.motion.e.y() / (kGap + F / K), 1.0, 1e-9);
      }
      return count;
    };
    EXPECT_EQ(bearing(0.999), 4);
    EXPECT_EQ(bearing(1.001), 3);
  }
}

// Beyond its edge a load tips it, until the other face holds: the threshold is the edge itself, g = F w.
TEST(RectangularPad, TipsWhereItsLoadIsBeyondItsEdge) {
  const JointPlay law = pad(JournalAxes::free);
  const double F = 50.0, w = 0.5 * kWidth;
  const auto tilt = [&](double share) {
    PlayOffsets load = PlayOffsets::Zero();
    load << 0.0, F, 0.0, share * F * w, 0.0, 0.0;
    return law.rest_under(load, {}, {}).motion.slope[0] * w;
  };
  EXPECT_LT(tilt(0.999), 1e-3 * kGap);
  // Its far edge comes to the other face: e_y + w sigma = c here, e_y - w sigma = -c there.
  EXPECT_NEAR(tilt(1.001) / kGap, 1.0, 1e-2);
}

TEST(RectangularPad, WithoutLoadStaysWhereItWas) {
  const JointPlay law = pad(JournalAxes::free);
  RestingPlay before;
  before.motion.e.y() = 0.4 * kGap;
  before.motion.slope = {0.2 * kGap / kWidth, 0.1 * kGap / kWidth};
  const RestingPlay rest = law.rest_under(PlayOffsets::Zero(), {.twist = turned(1.0)}, before);
  EXPECT_EQ(rest.motion.e, before.motion.e);
  EXPECT_EQ(rest.motion.slope, before.motion.slope);
  // One that twists out of its room is turned back into it.
  before.motion.slope = {0.0, 1.15 * kGap / kLength};
  const auto depth = [&](double angle) {
    return law.rest_under(PlayOffsets::Zero(), {.twist = turned(angle)}, before).motion.slope[1] * 0.5 * kLength;
  };
  EXPECT_NEAR(depth(0.0), 0.575 * kGap, 1e-9 * kGap);
  const double half = std::atan2(kWidth, kLength);  // its diagonal lies along the tilt
  EXPECT_NEAR(depth(half) / (0.6 * kGap * kLength / std::hypot(kWidth, kLength)), 1.0, 1e-9);
}

// At the edge of its room the pad touches and is not pressed, whichever way it is twisted.
TEST(RectangularPad, ItsRoomIsThatOfItsCorners) {
  const JointPlay law = pad(JournalAxes::free);
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const JointCoordinates joint{.twist = turned(std::numbers::pi * uniform(generator))};
    const RestingPlay rest = law.rest_under(PlayOffsets::Zero(), joint, {});
    const std::vector<GapPart> parts = law.gap_parts(rest, joint);
    ASSERT_EQ(parts.size(), 1u);
    ASSERT_EQ(parts[0].shape, GapPart::Shape::octahedron);
    Vec3 at(uniform(generator), uniform(generator), uniform(generator));
    at /= at.lpNorm<1>();
    const PlayOffsets offset =
        parts[0].offset * at.cwiseProduct(Vec3(parts[0].radial, parts[0].axial, parts[0].radial));
    ContactStates<double> contact;
    law.penetrations(at_rest_at(offset, joint), contact);
    double deepest = -1.0;
    for (const ContactState<double>& c : contact) deepest = std::max(deepest, c.penetration);
    EXPECT_NEAR(deepest, 0.0, 1e-9 * kGap) << k;
  }
}

TEST(RectangularPad, TangentIsTheForcesChange) {
  std::mt19937 generator(13);
  const ClearanceDescription d = description(JournalAxes::free, "hertz");
  const RectangularPadInSlot law(d, JointType::planar, d.parameters);
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    PlayMotion<double> m = anywhere(generator);
    const ContactTangent tangent = law.tangent(m);
    touching += tangent.count > 0;
    Eigen::Matrix<double, kMostOffsets, kMostOffsets> K;
    K.setZero();
    for (int i = 0; i < tangent.count; ++i) K += tangent.column[i].n * tangent.column[i].n.transpose();
    OffsetJacobian by;
    offset_jacobian(pad(d), at_rest_at(offsets_of(m), {.twist = m.twist}), kSlowImpacts, by);
    // By exact derivatives of the wrench, whose couples are of the slopes as they are.
    const double size = K(1, 1);
    EXPECT_NEAR(-by(1, 1), K(1, 1), 1e-9 * size) << k;
    for (const int i : {3, 4})
      for (const int j : {1, 3, 4})
        EXPECT_NEAR(-by(i, j), K(i, j), 1e-6 * size * kLength * (j == 1 ? 1.0 : kLength)) << k << ' ' << i << ' ' << j;
  }
  EXPECT_GT(touching, 100);
}

// What its wrench hangs on, the twist among it, against differences.
TEST(RectangularPad, DerivativesAreThoseOfItsWrench) {
  std::mt19937 generator(17);
  const JointPlay law = pad(JournalAxes::free, "flores", 0.2);
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    const PlayMotion<double> m = anywhere(generator);
    PlayWrench<double> here;
    law.wrench(m, speeds(0.05), here);
    const double size = pressed(here);
    if (size == 0.0) continue;
    ++touching;
    ContactJacobian by;
    contact_jacobian(law, m, speeds(0.05), MomentAbout::seat, by);
    const double h = 1e-7;
    PlayMotion<double> more = m, less = m;
    more.twist = turned(std::atan2(m.twist[1], m.twist[0]) + h);
    less.twist = turned(std::atan2(m.twist[1], m.twist[0]) - h);
    PlayWrench<double> a, b;
    law.wrench(more, speeds(0.05), a);
    law.wrench(less, speeds(0.05), b);
    const Eigen::Matrix<double, 6, 1> by_twist = -m.twist[1] * by.col(14) + m.twist[0] * by.col(15);
    EXPECT_LT((by_twist.head<3>() - (a.force - b.force) / (2.0 * h)).norm(), 2e-4 * (size + by_twist.norm())) << k;
    EXPECT_LT((by_twist.tail<3>() - (a.moment - b.moment) / (2.0 * h)).norm(), 2e-4 * (size + by_twist.norm())) << k;
  }
  EXPECT_GT(touching, 100);
}

}  // namespace rectangular_pad_in_slot_test
}  // namespace boresight
