// Where a drawing puts its origin and its axes is nobody's error.
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/multibody/multibody_start.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace moved_drawing_test {

MechanismDescription drawing() {
  MechanismDescription d = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml",
                                          {{"motion.duration", "0.03 s"}, {"initial.journals", "rest"}});
  d.line_of_sight = {.from = {0.15, 0.1, 0.2}, .target = {0.5, -0.3, 2.0}, .origin = {}};
  return d;
}

// Everything turned about the origin, then moved.
MechanismDescription placed(MechanismDescription d, const Mat3& turn, const Vec3& by) {
  const auto move = [&](Vec3& point) { point = turn * point + by; };
  for (BodyDescription& b : d.bodies) {
    move(b.center_of_mass);
    b.axes = turn * b.axes;
    if (b.boresight) *b.boresight = turn * *b.boresight;
  }
  for (JointDescription& j : d.joints) {
    move(j.point);
    j.axis = turn * j.axis;
    j.second_axis = turn * j.second_axis;
  }
  if (d.payload) move(d.payload->center_of_mass);
  d.gravity = turn * d.gravity;
  move(d.line_of_sight->from);
  move(d.line_of_sight->target);
  return d;
}

PointingIndices indices(const MechanismDescription& d, const char* rung) {
  const auto m = std::make_shared<const Mechanism>(d);
  RunOptions options;
  options.step = 2e-5;
  options.sample_spacing = 0.0;
  return make_rung(rung, m)->run(m->parameters(), options).index;
}

void expect_equal(const PointingIndices& a, const PointingIndices& b, double relative, const std::string& what) {
  for (const auto quantity : {&PointingIndices::position_error, &PointingIndices::boresight_error,
                              &PointingIndices::orientation_error, &PointingIndices::line_of_sight_error})
    for (const auto statistic : {&Statistics::max, &Statistics::rms, &Statistics::mean})
      EXPECT_NEAR(a.*quantity.*statistic, b.*quantity.*statistic, relative * (a.*quantity.*statistic) + 1e-13) << what;
  EXPECT_GT(a.line_of_sight_error.max, 1e-6) << what;
}

TEST(MovedDrawing, ChangesNoIndex) {
  const MechanismDescription here = drawing();
  for (const char* rung : {"envelope", "quasistatic", "perturbation"}) {
    const PointingIndices own = indices(here, rung);
    expect_equal(own, indices(placed(here, Mat3::Identity(), {0.3, -0.8, 0.5}), rung), 1e-7,
                 std::string(rung) + ", a metre");
    expect_equal(own, indices(placed(here, Mat3::Identity(), {300, -800, 500}), rung), 1e-4,
                 std::string(rung) + ", a kilometre");
    const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    expect_equal(own, indices(placed(here, turn, {0.1, 0.2, 0.3}), rung), 1e-6, std::string(rung) + ", turned");
  }
}

// A journal that next to nothing presses into a stiff sleeve: what holds it along the sleeve's wall is its load over the clearance, a ten-millionth
// of what the contact holds it with across the wall. Where it starts is known all the same.
TEST(MovedDrawing, ChangesNoStartUnderALightLoad) {
  MechanismDescription here = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/planar.toml",
                                             {{"motion.drives.A", "2.6e-4*sin(158*t)"}});
  here.gravity.setZero();
  here.line_of_sight = {.from = Vec3::Zero(), .target = Vec3::UnitX(), .origin = {}};
  const auto displaced = [](const MechanismDescription& d) {
    const Mechanism mechanism(d);
    const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
    IdealState start;
    ideal.state(0.0, start);
    const RestingBodies rest = resting_bodies(mechanism, mechanism.parameters(), ideal);
    EXPECT_EQ(rest.refusal, "");
    VecX by(mechanism.bodies());
    for (int b = 0; b < mechanism.bodies(); ++b) by[b] = (rest.exact.at(b).p - start.bodies[b].p).norm();
    return by;
  };
  const VecX own = displaced(here);
  EXPECT_GT(own.norm(), 1e-5);
  for (const double angle : {0.3, 1.1, 2.1, 4.0}) {
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
    EXPECT_LT((displaced(placed(here, turn, Vec3::Zero())) - own).norm(), 1e-8 * own.norm()) << angle;
  }
}

// In a planar mechanism nothing pushes a journal along its axis but what rounding makes of a drawing that lies askew; without friction at its
// faces that decided, instant by instant, at which of them it lay.
TEST(MovedDrawing, PushesNoJournalAlongItsAxis) {
  MechanismDescription d = scenes::planar_four_bar();
  d.bodies[0].boresight.reset();
  d.bodies[1].boresight = Vec3::UnitZ();
  d.joints[0].driven = true;
  d.joints[2].type = JointType::cylindrical;
  d.motion.drives[0] = scenes::sine(0.3, 6.0);
  d.motion.duration = 0.4;
  scenes::add_clearance(d, 1, false);
  d.clearances[0].parameters.friction.coefficient = 0.0;
  d.line_of_sight = {.from = {0.3, 0.0, 0.3}, .target = {0.5, -0.3, 2.0}, .origin = {}};
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const MechanismDescription& drawn : {d, placed(d, turn, {0.1, 0.2, 0.3})}) {
    const auto m = std::make_shared<const Mechanism>(drawn);
    const RunResult r = make_rung("quasistatic", m)->run(m->parameters(), {});
    ASSERT_GT(r.clearances[0].size(), 100u);
    for (const ClearanceSample& s : r.clearances[0]) EXPECT_EQ(s.offset.y(), 0.0);
    EXPECT_GT(r.index.position_error.rms, 0.0);
  }
}

// Ten kilometres away a metre keeps four digits less: the poses that a motion is told by must not be differentiated more closely than that.
TEST(MovedDrawing, ByTenKilometresChangesNoAccelerationOfAPrescribedPose) {
  const auto at = [](const std::string& z) {
    return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml",
                          {{"motion.duration", "0.2 s"}, {"motion.position.z", z}});
  };
  const MechanismDescription here = at("500*cos(theta)");
  MechanismDescription far = at("500*cos(theta) + 1e7");
  for (BodyDescription& b : far.bodies) b.center_of_mass.z() += 1e4;
  for (JointDescription& j : far.joints) j.point.z() += 1e4;
  if (far.payload) far.payload->center_of_mass.z() += 1e4;
  const auto own = std::make_shared<const Mechanism>(here), moved = std::make_shared<const Mechanism>(far);
  const IdealMotion a = ideal_motion(*own, own->parameters()), b = ideal_motion(*moved, moved->parameters());
  EXPECT_LT(b.knots(), 4 * a.knots());
  RunOptions options;
  options.step = 2e-5;
  options.sample_spacing = 0.0;
  const auto index = [&](const std::shared_ptr<const Mechanism>& m) {
    return make_rung("multibody", m)->run(m->parameters(), options).index.position_error;
  };
  EXPECT_NEAR(index(moved).rms / index(own).rms, 1.0, 2e-3);
}

// Two arms on a universal joint that nothing drives, one joint with play. Which coordinates serve is looked at during the motion; a longer one
// must not take other ones that fail where it starts.
TEST(MotionOnAUniversalJoint, StartsAtRestForAnyDuration) {
  for (const double duration : {0.3, 0.5, 1.0}) {
    MechanismDescription m;
    m.gravity = Vec3(0.0, 0.0, -9.81);
    const int upper = scenes::add_body(m, "upper", 1.0, {0.1, 0.0, 0.0}, Vec3::Zero()),
              lower = scenes::add_body(m, "lower", 1.0, {0.3, 0.0, 0.0}, Vec3::Zero());
    m.bodies[upper].boresight.reset();
    m.bodies[lower].boresight = Vec3::UnitX();
    const int cross = scenes::add_joint(m, JointType::universal, kGround, upper, Vec3::Zero(), Vec3::UnitY());
    m.joints[cross].second_axis = Vec3::UnitZ();
    const int hinge = scenes::add_joint(m, JointType::revolute, upper, lower, {0.2, 0.0, 0.0}, Vec3::UnitY());
    scenes::add_clearance(m, hinge, false, JournalAxes::parallel);
    m.journals = JournalStart::rest;
    m.motion.duration = duration;
    const auto mechanism = scenes::build(m);
    RunOptions options;
    options.sample_spacing = duration;
    for (const char* rung : {"multibody", "perturbation"}) {
      const RunResult run = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
      const Vec3 offset = run.clearances[0].front().offset;  // y along the axis
      EXPECT_NEAR(std::hypot(offset.x(), offset.z()), m.clearances[0].parameters.radial,
                  0.05 * m.clearances[0].parameters.radial)
          << rung << ", " << duration << " s";
    }
  }
}

}  // namespace moved_drawing_test
}  // namespace boresight
