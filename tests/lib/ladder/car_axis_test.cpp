// The car axis of the Test Set for IVP Solvers (Bari): two wheels on springs at the ends of a massless axle,
// over a bump that turns the base. A problem of index 3 there; here bodies, joints, springs and one drive.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace car_axis_test {

// M eps^2 / 2 with M = 10, eps = 0.01; the base is one long and lifts its right end by 0.1 sin(10 t). The
// left wheel stays on the line through the base's left end across the base. What has no mass there has a
// billionth here.
MechanismDescription car_axis() {
  MechanismDescription m;
  m.name = "car axis";
  m.gravity = Vec3(0.0, -1.0, 0.0);
  const auto body = [&m](const char* name, double mass, const Vec3& at) {
    BodyDescription b;
    b.name = name;
    b.mass = mass;
    b.center_of_mass = at;
    b.inertia = 1e-15 * Mat3::Identity();
    m.bodies.push_back(b);
    return static_cast<int>(m.bodies.size()) - 1;
  };
  const int base = body("base", 1e-9, Vec3::Zero()), left = body("left wheel", 5e-4, Vec3(0.0, 0.5, 0.0)),
            right = body("axle with the right wheel", 5e-4, Vec3(1.0, 0.5, 0.0));
  m.bodies[left].boresight = Vec3::UnitY();
  const auto joint = [&m](const char* name, JointType type, int first, int second, const Vec3& point,
                          const Vec3& axis) {
    JointDescription j;
    j.name = name;
    j.type = type;
    j.first = first;
    j.second = second;
    j.point = point;
    j.axis = axis;
    m.joints.push_back(j);
  };
  joint("road", JointType::revolute, kGround, base, Vec3::Zero(), Vec3::UnitZ());
  joint("strut", JointType::prismatic, base, left, Vec3(0.0, 0.5, 0.0), Vec3::UnitY());
  joint("hub", JointType::revolute, left, right, Vec3(0.0, 0.5, 0.0), Vec3::UnitZ());
  m.joints[0].driven = true;
  m.motion.duration = 3.0;
  m.motion.drives[0] = parse_expression("asin(0.1*sin(10*t))");
  const auto spring = [&m](int first, int second, const Vec3& from, const Vec3& to) {
    SpringDescription s;
    s.first = first;
    s.second = second;
    s.first_point = from;
    s.second_point = to;
    s.parameters = {1.0, 0.0, 0.5};
    m.springs.push_back(s);
  };
  spring(kGround, left, Vec3::Zero(), Vec3(0.0, 0.5, 0.0));
  spring(base, right, Vec3(1.0, 0.0, 0.0), Vec3(1.0, 0.5, 0.0));
  // Both wheels move with (-0.5, 0) at first, so that the axle does not turn while the base does with 1
  // rad/s.
  m.initial_rates.push_back({2, InitialRateDescription::Freedom::angle, -1.0, {}});
  return m;
}

TEST(CarAxis, EndsWhereTheTestSetPutsIt) {
  const auto mechanism = scenes::build(car_axis());
  RunOptions options;
  options.step = 1e-4;
  options.sample_spacing = 0.1;
  options.pose_bodies = {2};
  const RunResult result = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const PoseSample &left = result.boresight.samples.back(), &right = result.others[0].samples.back();
  ASSERT_NEAR(result.time.back(), 3.0, 1e-9);
  const std::pair<const char*, const char*> reference[] = {
      {"x of the left wheel [m]", "0.0493455784275402809122"},
      {"y of the left wheel [m]", "0.496989460230171153861"},
      {"x of the right wheel [m]", "1.04174252488542151681"},
      {"y of the right wheel [m]", "0.373911027265361256927"},
      {"speed of the left wheel along x [m/s]", "-0.0770583684040972357970"},
      {"speed of the left wheel along y [m/s]", "0.00744686658723778553466"},
      {"speed of the right wheel along x [m/s]", "0.0175568157537232222276"},
      {"speed of the right wheel along y [m/s]", "0.770341043779251976443"}};
  const double computed[] = {left.pose.p.x(), left.pose.p.y(), right.pose.p.x(), right.pose.p.y(),
                             left.v.x(),      left.v.y(),      right.v.x(),      right.v.y()};
  for (int k = 0; k < 8; ++k)
    validation::expect_printed("Bari test set, car axis, at 3 s", reference[k].first, reference[k].second, computed[k],
                               1e-9);
}

}  // namespace car_axis_test
}  // namespace boresight
