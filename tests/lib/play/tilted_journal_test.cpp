#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "boresight/play/joint_play.hpp"
#include "boresight/play/journal/journal_in_sleeve.hpp"

namespace boresight {
namespace tilted_journal_test {

using Offsets = Eigen::Matrix<double, 5, 1>;
const std::array<double, kContactPlaces> kImpactSpeed{0.02, 0.02, 0.02, 0.02, 0.02};

JournalInSleeve joint(JointType type = JointType::revolute, double friction = 0.0, const char* law = "hertz",
                      JournalAxes axes = JournalAxes::free, double axial = 1e-4) {
  ClearanceDescription d;
  d.axes = axes;
  d.contact_law = law;
  d.parameters.radial = 1e-4;
  d.parameters.axial = axial;
  d.parameters.journal_radius = 10e-3;
  d.parameters.cap_radius = 16e-3;
  d.parameters.sleeve_length = 30e-3;
  d.parameters.friction.coefficient = friction;
  return {d, type, d.parameters};
}

// A journal at the given offsets, its body turning with w: slope rates follow from w.
PlayMotion<double> at(const Offsets& o, const Vec3& e_dot, const Vec3& w) {
  PlayMotion<double> m{o.head<3>(), e_dot, w};
  m.slope = o.tail<2>();
  const Vec3 along(m.slope[0], 1.0, m.slope[1]), turning = w.cross(along);
  m.slope_rate << turning.x() - m.slope[0] * turning.y(), turning.z() - m.slope[1] * turning.y();
  return m;
}

Offsets random_offsets(std::mt19937& generator, double slide) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Offsets o;
  o << 1.2e-4 * uniform(generator), slide + 1.2e-4 * uniform(generator), 1.2e-4 * uniform(generator),
      8e-3 * uniform(generator), 8e-3 * uniform(generator);
  return o;
}

// Power of the wrench on the journal's motion.
double power(const PlayWrench<double>& wrench, const PlayMotion<double>& m) {
  return wrench.force.dot(m.e_dot) + (wrench.moment - m.e.cross(wrench.force)).dot(m.w);
}

TEST(TiltedJournal, TakesNoMoreEnergyThanItsSpringsStore) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (JointType type : {JointType::revolute, JointType::cylindrical}) {
    const JournalInSleeve law = joint(type);
    int touching = 0;
    for (int k = 0; k < 2000; ++k) {
      const Offsets o = random_offsets(generator, type == JointType::cylindrical ? 0.01 : 0.0);
      const Vec3 e_dot = 0.1 * Vec3(uniform(generator), uniform(generator), uniform(generator));
      const Vec3 w = 5.0 * Vec3(uniform(generator), uniform(generator), uniform(generator));
      const PlayMotion<double> m = at(o, e_dot, w);
      PlayWrench<double> wrench;
      law.wrench(m, kImpactSpeed, wrench);
      const double h = 1e-8;
      Offsets rate;
      rate << e_dot, m.slope_rate;
      const double growth =
          (law.elastic_energy(at(o + h * rate, e_dot, w)) - law.elastic_energy(at(o - h * rate, e_dot, w))) / (2.0 * h);
      // Differences cross kinks (a face that begins to touch): an error of second order in the step of 1e-9 m.
      const double scale = wrench.force.norm() * e_dot.norm() + wrench.moment.norm() * w.norm();
      ASSERT_NEAR(power(wrench, m), -growth, 1e-6 * scale + 2e-5);
      touching += law.elastic_energy(m) > 0.0;
    }
    EXPECT_GT(touching, 500);
  }
}

TEST(TiltedJournal, HasThePapersForcesWhenItIsParallel) {
  const JournalInSleeve tilts = joint(JointType::revolute, 0.03, "flores");
  const JournalInSleeve parallel = joint(JointType::revolute, 0.03, "flores", JournalAxes::parallel);
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    Offsets o = random_offsets(generator, 0.0);
    o.tail<2>().setZero();
    const PlayMotion<double> m = at(o, 0.01 * Vec3(uniform(generator), uniform(generator), uniform(generator)),
                                    {0.0, 5.0 * uniform(generator), 0.0});
    PlayWrench<double> a, b;
    tilts.wrench(m, kImpactSpeed, a);
    parallel.wrench(m, kImpactSpeed, b);
    EXPECT_LT((a.force - b.force).norm(), 1e-10 * (1.0 + b.force.norm()));
    // The parallel journal's normal forces meet at the sleeve's centre, the tilting one's at its own: no work without tilt.
    const JournalInSleeve smooth = joint(),
                          smooth_parallel = joint(JointType::revolute, 0.0, "hertz", JournalAxes::parallel);
    PlayWrench<double> normal, normal_parallel;
    smooth.wrench(m, kImpactSpeed, normal);
    smooth_parallel.wrench(m, kImpactSpeed, normal_parallel);
    ASSERT_LT((normal.moment - m.e.cross(normal.force)).norm(), 1e-10 * (1.0 + normal.force.norm()));
    ASSERT_LT(normal_parallel.moment.norm(), 1e-10 * (1.0 + normal.force.norm()));
    Vec3 pushed(0.0, 0.0, 0.0);
    for (int side : {-1, 1}) {
      pushed.y() += side * a.contact[static_cast<int>(TiltedJournal::axial_place(side))].normal_force;
      const double F =
          a.contact[static_cast<int>(TiltedJournal::radial_place(side))].normal_force / std::hypot(o[0], o[2]);
      pushed -= F * Vec3(o[0], 0.0, o[2]);
    }
    const Vec3 shift = m.e.cross(pushed);
    ASSERT_LT((a.moment - shift - b.moment).norm(), 1e-10 * (1.0 + b.moment.norm()));
  }
}

// A pure couple M on the journal: each end carries F = M / l, and the axis leans by 2 (c + d) / l, d the Hertz depth under F.
TEST(TiltedJournal, CarriesAPureCoupleAtBothEnds) {
  const JournalInSleeve law = joint(JointType::revolute, 0.0, "hertz", JournalAxes::free, 1e-3);  // caps far off
  const double l = 30e-3, depth = 3e-5, slope = 2.0 * (1e-4 + depth) / l;
  Offsets o = Offsets::Zero();
  o[3] = slope;
  PlayWrench<double> wrench;
  law.wrench(at(o, Vec3::Zero(), Vec3::Zero()), kImpactSpeed, wrench);
  const double F = 0.5 * law.radial_law.stiffness * std::pow(depth, 1.5);
  EXPECT_NEAR(wrench.contact[static_cast<int>(ContactPlace::radial_plus)].normal_force, F, 1e-9 * F);
  EXPECT_NEAR(wrench.contact[static_cast<int>(ContactPlace::radial_minus)].normal_force, F, 1e-9 * F);
  EXPECT_LT(wrench.force.norm(), 1e-9 * F);
  // The axis leans towards +x, a turn about -z; the sleeve turns it back. 1 + slope^2: a moment about a leaning axis.
  EXPECT_NEAR(wrench.moment.z(), F * l * (1.0 + slope * slope), 1e-9 * F * l);
}

TEST(TiltedJournal, TangentIsTheChangeOfForce) {
  std::mt19937 generator(6);
  for (JournalAxes axes : {JournalAxes::free, JournalAxes::parallel}) {
    const JournalInSleeve law = joint(JointType::revolute, 0.0, "hertz", axes);
    int touching = 0;
    for (int k = 0; k < 500; ++k) {
      Offsets o = random_offsets(generator, 0.0);
      if (axes == JournalAxes::parallel) o.tail<2>().setZero();
      const PlayMotion<double> m = at(o, Vec3::Zero(), Vec3::Zero());
      Eigen::Matrix<double, 5, 5> stiffness = Eigen::Matrix<double, 5, 5>::Zero();
      const ContactTangent tangent = law.tangent(m);
      for (int i = 0; i < tangent.count; ++i)
        stiffness += tangent.column[i].n.head<5>() * tangent.column[i].n.head<5>().transpose();
      // Second differences of the energy; forces that stand add a geometric part of (force / offset), which the tangent
      // leaves out: along the offset's own direction there is none.
      const Eigen::Matrix<double, 5, 1> probe =
          tangent.count > 0 ? Offsets(tangent.column[0].n.head<5>().normalized()) : Offsets(o);
      if (tangent.count != 1) continue;
      ++touching;
      const double h = 1e-8;
      const auto energy = [&](double s) { return law.elastic_energy(at(o + s * probe, Vec3::Zero(), Vec3::Zero())); };
      const double second = (energy(h) - 2.0 * energy(0.0) + energy(-h)) / (h * h);
      EXPECT_NEAR(probe.dot(stiffness * probe) / second, 1.0, 0.02);
    }
    EXPECT_GT(touching, 20);
  }
}

// A sleeve and a journal are round: the tangent of one that tilts elsewhere is the same, turned.
TEST(ContactTangent, TurnsWithTheDirectionInWhichTheJournalTilts) {
  const JournalInSleeve law = joint();
  const auto stiffness = [&](double direction) {
    Offsets o;
    o << 0.0, 1.2e-4, 0.0, 2e-3 * std::cos(direction), 2e-3 * std::sin(direction);
    Eigen::Matrix<double, 5, 5> sum = Eigen::Matrix<double, 5, 5>::Zero();
    const ContactTangent tangent = law.tangent(at(o, Vec3::Zero(), Vec3::Zero()));
    for (int i = 0; i < tangent.count; ++i)
      sum += tangent.column[i].n.head<5>() * tangent.column[i].n.head<5>().transpose();
    return sum;
  };
  const Eigen::Matrix<double, 5, 5> along_x = stiffness(0.0);
  ASSERT_GT(along_x(4, 4), 0.0) << "the ring resists turning about the tilt too";
  for (const double direction : {0.4, 1.3, 2.5, -2.0}) {
    Eigen::Matrix<double, 5, 5> turn = Eigen::Matrix<double, 5, 5>::Identity();
    turn(0, 0) = turn(2, 2) = turn(3, 3) = turn(4, 4) = std::cos(direction);
    turn(2, 0) = turn(4, 3) = std::sin(direction);
    turn(0, 2) = turn(3, 4) = -std::sin(direction);
    EXPECT_LT((stiffness(direction) - turn * along_x * turn.transpose()).norm(), 1e-9 * along_x.norm()) << direction;
  }
}

}  // namespace tilted_journal_test
}  // namespace boresight
