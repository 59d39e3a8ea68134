// Every pair of a contact and a friction law, at the ends of what a mechanism file may say of a joint and of
// how a journal can move in it: forces, moments and their derivatives by the motion stay finite.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace law_extremes_test {

using Jet = ceres::Jet<double, 13>;  // by e, e_dot, w, slope, slope_rate

struct Joint {
  std::string name;
  JointPlay numbers;
  FrictionLaw friction;
};

// read_joints.cpp accepts open intervals: their ends are approached.
std::vector<Joint> joints_at_the_ends() {
  std::vector<Joint> out;
  for (const NormalLawEntry& normal : normal_laws())
    for (const FrictionLawEntry& friction : friction_laws())
      for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free})
        for (const double restitution : {1e-6, 1.0})
          for (const double radial : {1e-9, 5e-3})
            for (const double poisson : {0.0, 0.4999})
              for (const double rub : {0.0, 10.0}) {
                ClearanceDescription d;
                d.contact_law = normal.name;
                d.friction_law = friction.name;
                d.axes = axes;
                ClearanceParameters& p = d.parameters;
                p.radial = radial;
                p.axial = rub > 0.0 ? 0.0 : radial;
                p.journal_radius = 10e-3;
                p.cap_radius = 16e-3;
                p.sleeve_length = 30e-3;
                p.contact.restitution = restitution;
                p.contact.young = {1e6, 1.2e12};  // rubber on diamond
                p.contact.poisson = {poisson, poisson};
                p.contact.linear_stiffness = 1e8;
                p.contact.linear_damping = rub;
                p.friction.coefficient = rub;
                p.friction.static_coefficient = 2.0 * rub;
                p.friction.static_speed = 0.0;
                p.friction.dynamic_speed = 1e-9;
                p.friction.stribeck_speed = 1e-9;
                out.push_back({std::string(normal.name) + ", " + friction.name +
                                   (axes == JournalAxes::free ? ", free" : ", parallel") + ", e " +
                                   std::to_string(restitution) + ", mu " + std::to_string(rub),
                               JointPlay(d, JointType::revolute, p), make_friction_law(d.friction_law, p.friction)});
              }
  return out;
}

// At the centre, just not touching, just touching, deep; at rest, drifting, fast.
std::vector<std::array<double, 13>> motions(double radial) {
  std::vector<std::array<double, 13>> out;
  for (const double offset : {0.0, radial, radial * (1.0 + 1e-15), radial + 1e-15, radial + 1e-9, radial + 1e-4})
    for (const double along : {0.0, radial + 1e-6, -1e-4})
      for (const double speed : {0.0, 1e-12, -0.1, 1e3})
        for (const double slope : {0.0, 1e-3})
          out.push_back(
              {offset, along, 0.0, speed, speed, -speed, 0.0, 1e2 * speed, speed, slope, -slope, slope * speed, 0.0});
  return out;
}

template <typename T>
PlayMotion<T> as_motion(const std::array<T, 13>& x) {
  PlayMotion<T> m;
  m.e = {x[0], x[1], x[2]};
  m.e_dot = {x[3], x[4], x[5]};
  m.w = {x[6], x[7], x[8]};
  m.slope = {x[9], x[10]};
  m.slope_rate = {x[11], x[12]};
  return m;
}

bool is_finite(double x) { return std::isfinite(x); }
bool is_finite(const Jet& x) { return std::isfinite(x.a) && x.v.allFinite(); }

template <typename T>
bool is_finite(const PlayWrench<T>& wrench) {
  bool all = true;
  for (int i = 0; i < 3; ++i) all = all && is_finite(wrench.force[i]) && is_finite(wrench.moment[i]);
  for (const ContactState<T>& c : wrench.contact)
    all = all && is_finite(c.penetration) && is_finite(c.rate) && is_finite(c.normal_force);
  return all;
}

TEST(EveryPairOfLaws, StaysFiniteAtTheEndsOfWhatAFileMaySay) {
  int pressing = 0;
  for (const Joint& joint : joints_at_the_ends()) {
    for (const double speed : {0.0, 1e-300, 1e-9, 1e3})
      ASSERT_TRUE(std::isfinite(joint.friction.force_per_velocity(speed))) << joint.name << " at " << speed;
    for (const double impact_speed : {1e-9, 10.0})
      for (const std::array<double, 13>& x : motions(joint.numbers.clearances()[0])) {
        std::array<double, kContactPlaces> impact_speeds;
        impact_speeds.fill(impact_speed);
        const PlayMotion<double> motion = as_motion(x);
        PlayWrench<double> wrench;
        if (joint.numbers.sticks) {
          for (const double bristle : {0.0, 1e-5, -1.0}) {
            Bristles<double> bristles, rate;
            bristles.fill(Vec2T<double>(bristle, 0.0));
            joint.numbers.wrench(motion, impact_speeds, bristles, wrench, rate, 1e6);
            ASSERT_TRUE(is_finite(wrench)) << joint.name;
            for (const Vec2T<double>& r : rate) ASSERT_TRUE(r.allFinite()) << joint.name;
          }
        } else {
          joint.numbers.wrench(motion, impact_speeds, wrench);
          ASSERT_TRUE(is_finite(wrench)) << joint.name;
          std::array<Jet, 13> jets;
          for (int i = 0; i < 13; ++i) jets[i] = Jet(x[i], i);
          PlayWrench<Jet> with_slopes;
          joint.numbers.wrench(as_motion(jets), impact_speeds, with_slopes);
          ASSERT_TRUE(is_finite(with_slopes)) << joint.name << ": a derivative, at offset " << x[0] << ", " << x[1]
                                              << ", speed " << x[3] << ", slope " << x[9];
        }
        pressing += wrench.force.norm() > 0.0;
        ASSERT_TRUE(std::isfinite(joint.numbers.elastic_energy(motion))) << joint.name;
        const ContactTangent tangent = joint.numbers.tangent(motion);
        for (int c = 0; c < tangent.count; ++c) ASSERT_TRUE(tangent.column[c].n.allFinite()) << joint.name;
      }
  }
  EXPECT_GT(pressing, 10000);
}

}  // namespace law_extremes_test
}  // namespace boresight
