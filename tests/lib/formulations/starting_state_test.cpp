// Where mechanisms with free joints start: home, at rest, but for what drives, errors and given rates make of it.
#include "boresight/formulations/starting_state.hpp"

#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace starting_state_test {

TimeFunctionPtr turning(double angle, double speed) {
  return std::make_shared<scenes::FunctionOfTime>([=](double t) { return TimeValue{angle + speed * t, speed, 0.0}; });
}

IdealState start_of(const Mechanism& mechanism) {
  std::vector<TimeValue> laws(static_cast<std::size_t>(mechanism.joints()));
  for (const auto& [joint, law] : mechanism.description().motion.drives) laws[joint] = law->at(0.0);
  return starting_state(mechanism, laws);
}

// A table on a driven axis, and a flap on a hinge that is free, aslant on the table's edge.
MechanismDescription table_with_flap(double angle, double speed) {
  MechanismDescription m;
  const int table = scenes::add_body(m, "table", 5.0, Vec3::Zero(), Vec3(0.2, 0.1, 0.0));
  const int flap = scenes::add_body(m, "flap", 1.0, Vec3(0.4, 0.1, 0.1), Vec3::Zero());
  scenes::add_joint(m, JointType::revolute, kGround, table, Vec3::Zero(), Vec3::UnitZ(), turning(angle, speed));
  scenes::add_joint(m, JointType::revolute, table, flap, Vec3(0.3, 0.0, 0.0), Vec3(0.0, 1.0, 0.4));
  m.motion.duration = 0.1;
  return m;
}

// One body in a universal joint, and another hinged to it: nothing is driven.
MechanismDescription two_in_a_row() {
  MechanismDescription m;
  const int first = scenes::add_body(m, "first", 2.0, Vec3(0.2, 0.0, 0.1), Vec3::Zero());
  const int second = scenes::add_body(m, "second", 1.0, Vec3(0.6, 0.1, 0.0), Vec3::Zero());
  scenes::add_joint(m, JointType::universal, kGround, first, Vec3::Zero(), Vec3::UnitX());
  scenes::add_joint(m, JointType::revolute, first, second, Vec3(0.4, 0.0, 0.0), Vec3(0.2, 0.3, 1.0));
  m.motion.duration = 0.1;
  return m;
}

TEST(StartingState, FreeJointsAreCarriedAlongAtRest) {
  const auto mechanism = scenes::build(table_with_flap(0.0, 2.0));
  const IdealState start = start_of(*mechanism);
  for (const BodyMotion& body : start.bodies) {
    EXPECT_LT((body.w - Vec3(0.0, 0.0, 2.0)).norm(), 1e-12);
    EXPECT_LT((body.v - Vec3(0.0, 0.0, 2.0).cross(body.p)).norm(), 1e-12);
  }
}

// A pin of next to no mass, welded on anywhere, is no part of what moves.
TEST(StartingState, DoesNotHangOnPartsThatAreWeldedOn) {
  MechanismDescription m = table_with_flap(0.0, 2.0);
  const Vec3 alone = start_of(*scenes::build(m)).bodies[1].w;
  const int pin = scenes::add_body(m, "pin", 1e-9, Vec3(0.5, 0.6, -0.2), Vec3::Zero());
  scenes::add_joint(m, JointType::fixed, 1, pin, Vec3(0.4, 0.1, 0.1), Vec3::UnitX());
  EXPECT_LT((start_of(*scenes::build(m)).bodies[1].w - alone).norm(), 1e-12);
}

TEST(StartingState, JointsOfWhichNoRateIsGivenAreAtRest) {
  MechanismDescription m = two_in_a_row();
  const int last = static_cast<int>(m.joints.size()) - 1;
  m.initial_rates.push_back({last, InitialRateDescription::Freedom::angle, 2.0, {}});
  const IdealState start = start_of(*scenes::build(m));
  EXPECT_LT(start.bodies[0].w.norm() + start.bodies[0].v.norm(), 1e-12);
  EXPECT_LT((start.bodies[1].w - 2.0 * m.joints[last].axis).norm(), 1e-12);
}

// Drives need not begin at home: what is free is carried along.
TEST(StartingState, OfDrivesThatBeginAwayFromHomeLeavesFreeJointsAtHome) {
  for (const double angle : {0.2, 2.9, -1.7}) {
    const auto mechanism = scenes::build(table_with_flap(angle, 0.0));
    const IdealState start = start_of(*mechanism);
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    for (std::size_t b = 0; b < start.bodies.size(); ++b) {
      const BodyDescription& home = mechanism->description().bodies[b];
      EXPECT_LT((start.bodies[b].p - turn * home.center_of_mass).norm(), 1e-12) << angle;
      EXPECT_LT((start.bodies[b].R - turn * home.axes).norm(), 1e-12) << angle;
    }
    EXPECT_NO_THROW(ideal_motion(*mechanism, mechanism->parameters()));
  }
}

// X_a D_a J(0) = X_b: a hinge's seat built aside takes the free body along, and turns nothing.
TEST(StartingState, OfABuiltMechanismLeavesFreeJointsAtHome) {
  MechanismDescription m = table_with_flap(0.0, 0.0);
  ErrorDescription aside, turned;
  aside.name = "aside";
  aside.kind = ErrorDescription::Kind::translation;
  aside.joint = 1;
  aside.body = 0;
  aside.direction = Vec3(1.0, 2.0, 2.0) / 3.0;
  aside.value = 1e-3;
  turned.name = "turned";
  turned.kind = ErrorDescription::Kind::rotation;
  turned.joint = 1;
  turned.body = 0;
  turned.direction = Vec3::UnitX();
  turned.value = 0.01;
  m.errors = {aside, turned};
  const auto drawn = scenes::build(m);
  const auto commanded = std::make_shared<const IdealMotion>(ideal_motion(*drawn, drawn->parameters()));
  for (const bool both : {false, true}) {
    Parameters parameters = drawn->parameters();
    if (!both) parameters.error[1] = 0.0;
    const BuiltMotion built = built_motion(drawn, commanded, parameters);
    const BodyMotion flap = built.motion->body(0.0, 1);
    const BodyDescription& home = m.bodies[1];
    const Mat3 turn = Eigen::AngleAxisd(both ? 0.01 : 0.0, Vec3::UnitX()).toRotationMatrix();
    const Vec3 hinge = m.joints[1].point;
    EXPECT_LT((flap.R - turn * home.axes).norm(), 1e-12);
    EXPECT_LT((flap.p - (hinge + 1e-3 * aside.direction + turn * (home.center_of_mass - hinge))).norm(), 1e-12);
  }
}

TEST(StartingState, OfAClosedLoopIsAsNearToHomeAsItsJointsAllow) {
  // One crank of a parallelogram is driven, which begins at 0.1 rad: the loop has one place there.
  MechanismDescription m = scenes::planar_four_bar();
  m.joints[0].driven = true;
  m.motion.drives[0] = turning(0.1, 3.0);
  m.motion.duration = 0.02;
  const auto mechanism = scenes::build(m);
  const IdealState start = start_of(*mechanism);
  const BodyMotion exact = IdealMotion::kinematic(*mechanism).body(0.0, 1);
  EXPECT_LT((start.bodies[1].p - exact.p).norm(), 1e-10);
  EXPECT_LT((start.bodies[1].v - exact.v).norm(), 1e-8);
  EXPECT_LT((start.bodies[1].w - exact.w).norm(), 1e-8);
}

// A body that no joint holds shows in no joint's coordinate.
TEST(StartingState, OfALoopTakesRatesBesideABodyThatNothingHolds) {
  for (const double rate : {2.0, 1e-6}) {
    MechanismDescription m = scenes::planar_four_bar();
    m.motion.duration = 0.1;
    m.initial_rates.push_back({0, InitialRateDescription::Freedom::angle, rate, {}});
    const std::vector<BodyMotion> alone = start_of(*scenes::build(m)).bodies;
    scenes::add_body(m, "lost", 1.0, Vec3(1.0, 0.3, 0.0), Vec3::Zero());
    const std::vector<BodyMotion> beside = start_of(*scenes::build(m)).bodies;
    for (std::size_t b = 0; b < alone.size(); ++b) {
      EXPECT_LT((beside[b].w - alone[b].w).norm(), 1e-10 * rate);
      EXPECT_LT((beside[b].v - alone[b].v).norm(), 1e-10 * rate);
    }
    EXPECT_LT(beside.back().v.norm() + beside.back().w.norm(), 1e-10 * rate);
  }
}

// One axis of a planar loop a degree aslant locks it.
TEST(StartingState, SaysThatJointsLockWhatARateIsGivenOf) {
  MechanismDescription m = scenes::planar_four_bar();
  m.motion.duration = 0.1;
  m.joints[2].axis = Vec3(0.02, 1.0, 0.0).normalized();
  m.initial_rates.push_back({0, InitialRateDescription::Freedom::angle, 2.0, {}});
  try {
    start_of(*scenes::build(m));
    FAIL() << "moves";
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("nothing free to move"), std::string::npos) << refusal.what();
  }
}

}  // namespace starting_state_test
}  // namespace boresight
