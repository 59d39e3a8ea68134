// Derivatives carried through impacts are those that differences of whole motions give.
#include "boresight/slopes/sensitive_motion.hpp"

#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/slopes/start_slopes.hpp"
#include "crank_slider_scene.hpp"

namespace boresight {
namespace sensitive_motion_test {

const std::vector<std::string> kFlores = {"clearance.A.radial", "clearance.A.contact.restitution",
                                          "clearance.A.contact.stiffness_scale", "clearance.A.friction.coefficient"};

class Scene : public crank_slider::Scene {
 public:
  explicit Scene(const std::vector<Setting>& settings = {}, const std::vector<std::string>& varied = kFlores)
      : crank_slider::Scene(settings, varied) {}

  SensitiveMotion follow(const std::vector<double>& v, MotionRequest request, bool derivatives) const {
    request.by_parameters = request.by_start_state = derivatives;
    return follow_with_sensitivity(mechanism, at(v), tables, numbers(v), request);
  }
};

MotionRequest flight_to(double end) {
  MotionRequest request;
  request.end = end;
  request.times = {0.25 * end, 0.5 * end, 0.75 * end, end};
  request.start_state = VecX::Zero(6);
  request.start_state << 2e-5, 1e-5, -1e-5, 0.02, 0.001, 0.03;
  request.tolerance = 1e-13;  // impacts amplify the steps' errors: with ten times this, differences scatter by 3e-6
  request.derivative_tolerance = request.tolerance;
  return request;
}

// Every direction's derivative at the last time against Richardson's of central differences.
void expect_derivatives_of_differences(const Scene& scene, const MotionRequest& request) {
  const SensitiveMotion motion = scene.follow(scene.values, request, true);
  ASSERT_GE(motion.impact_speed.size(), 2u);
  ASSERT_TRUE(motion.grazing.empty());
  const std::size_t last = request.times.size() - 1;
  for (std::size_t d = 0; d < 10; ++d) {
    // Friction and the way along the pin have little effect: they are moved ten times as far.
    const double unit = d == 3 ? 10.0 * scene.values[3] : d < 4 ? scene.values[d] : d == 5 ? 5e-4 : d < 7 ? 5e-5 : 5e-2;
    const auto moved = [&](double share) {
      std::vector<double> v = scene.values;
      MotionRequest r = request;
      (d < 4 ? v[d] : r.start_state[static_cast<Eigen::Index>(d) - 4]) += share * unit;
      return VecX(scene.follow(v, r, false).state.col(static_cast<Eigen::Index>(last)));
    };
    const auto central = [&](double h) { return VecX((moved(h) - moved(-h)) / (2.0 * h * unit)); };
    const VecX exact = motion.by[last].col(static_cast<Eigen::Index>(d));
    // Wide steps leave a truncation error of h^4, narrow ones the integration's noise over h: the best of three (Ridders 1982).
    double least = 1.0;
    for (const double h : {2e-3, 1e-3, 5e-4}) {
      VecX difference = (4.0 * central(0.5 * h) - central(h)) / 3.0 - exact, size = exact;
      difference.tail<3>() *= kFlightTime;
      size.tail<3>() *= kFlightTime;
      least = std::min(least, difference.norm() / size.norm());
    }
    EXPECT_LT(least, 2e-7) << "direction " << d;
  }
}

TEST(SensitiveMotion, DerivativesThroughImpactsAreThoseOfRichardsonDifferences) {
  expect_derivatives_of_differences(Scene(), flight_to(8e-3));
}

TEST(SensitiveMotion, DerivativesJumpWhereADashpotMakesTheForceStartAtOnce) {
  const Scene scene({{"clearance.A.contact.law", "kelvin-voigt"},
                     {"clearance.A.contact.stiffness", "20 MN/m"},
                     {"clearance.A.contact.damping", "500 N s/m"}},
                    {"clearance.A.radial", "clearance.A.contact.stiffness", "clearance.A.contact.damping",
                     "clearance.A.friction.coefficient"});
  expect_derivatives_of_differences(scene, flight_to(8e-3));
}

// A journal that lies in its sleeve is damped as if it had struck at the least speed.
TEST(SensitiveMotion, DerivativesByTheLeastImpactSpeedAreThoseOfDifferences) {
  const Scene scene({}, {"clearance.A.contact.minimum_impact_speed"});
  MotionRequest request = flight_to(4e-3);
  request.start_state =
      start_slopes(
          scene.mechanism, *scene.tables, [&](const auto& x) { return scene.at(x); }, scene.values, true)
          .state;
  request.start_state.head<3>() *= 1.0 + 1e-4;  // pressed deeper, so that the contact swings and is damped
  const SensitiveMotion motion = scene.follow(scene.values, request, true);
  ASSERT_TRUE(motion.impact_speed.empty());
  const auto moved = [&](double share) {
    return VecX(scene.follow({scene.values[0] * (1.0 + share)}, request, false).state.col(0));
  };
  constexpr double kShare = 1e-2;
  const VecX difference = (moved(kShare) - moved(-kShare)) / (2.0 * kShare * scene.values[0]);
  EXPECT_GT(difference.norm(), 0.0);
  EXPECT_LT((motion.by[0].col(0) - difference).norm(), 1e-3 * difference.norm());
}

TEST(SensitiveMotion, DerivativesByAMassAreThoseOfRichardsonDifferences) {
  const Mechanism mechanism(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml", std::vector<Setting>{}));
  const PreparedScene prepared(mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters());
  for (const BodyDescription& body : mechanism.description().bodies) {
    const ParameterPath path(mechanism.description(), "body." + body.name + ".mass");
    const double told = path.get(mechanism.parameters());
    const auto at = [&](double mass) {
      Parameters p = mechanism.parameters();
      path.set(p, mass);
      return p;
    };
    const auto follow = [&](double mass, bool derivatives) {
      MotionRequest request = flight_to(8e-3);
      request.by_parameters = derivatives;
      if (derivatives)
        request.beside = {{0, 2e-3 * mass, prepared.tables(at(0.999 * mass)), prepared.tables(at(1.001 * mass))}};
      return follow_with_sensitivity(mechanism, at(mass), prepared.tables(at(mass)),
                                     contact_numbers(mechanism, [&](const auto& x) { return at(x[0]); }, {mass}),
                                     request);
    };
    const SensitiveMotion motion = follow(told, true);
    ASSERT_GE(motion.impact_speed.size(), 2u);
    const auto size = [](VecX v) {
      v.tail<3>() *= kFlightTime;
      return v.norm();
    };
    const VecX exact = motion.by.back().col(0);
    const auto central = [&](double h) {
      const auto moved = [&](double share) { return VecX(follow(told * (1.0 + share), false).state.rightCols(1)); };
      return VecX((moved(h) - moved(-h)) / (2.0 * h * told));
    };
    if (body.name == "crank") {  // it is driven, and turns about an axis without play
      EXPECT_EQ(size(exact), 0.0);
      continue;
    }
    double least = 1.0;
    for (const double h : {2e-3, 1e-3, 5e-4})
      least = std::min(least, size((4.0 * central(0.5 * h) - central(h)) / 3.0 - exact) / size(exact));
    // What tables bend by over two thousandths of a mass.
    EXPECT_LT(least, 5e-6) << body.name;
  }
}

// A heavier body presses its journal deeper into the bore where the motion starts.
TEST(SensitiveMotion, StartsFollowAMassAsRichardsonDifferencesOfThemDo) {
  const Mechanism mechanism(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", {}));
  const PreparedScene prepared(mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters());
  const ParameterPath path(mechanism.description(), "body.rocker.mass");
  const double told = path.get(mechanism.parameters());
  const auto at = [&](double mass) {
    Parameters p = mechanism.parameters();
    path.set(p, mass);
    return p;
  };
  const auto start = [&](double mass, bool derivatives) {
    std::vector<TablesBeside> beside;
    if (derivatives) beside = {{0, 2e-3 * mass, prepared.tables(at(0.999 * mass)), prepared.tables(at(1.001 * mass))}};
    return start_slopes(
        mechanism, *prepared.tables(at(mass)), [&](const auto& x) { return at(x[0]); }, {mass}, derivatives, beside);
  };
  const VecX slope = start(told, true).by.col(0);
  ASSERT_GT(slope.norm(), 0.0);
  const auto central = [&](double h) {
    return VecX((start(told * (1.0 + h), false).state - start(told * (1.0 - h), false).state) / (2.0 * h * told));
  };
  EXPECT_LT(((4.0 * central(5e-3) - central(1e-2)) / 3.0 - slope).norm(), 1e-4 * slope.norm());
}

TEST(SensitiveMotion, TheSameMotionWithAndWithoutDerivatives) {
  const Scene scene;
  MotionRequest request = flight_to(8e-3);
  request.tolerance = 1e-3;
  request.derivative_tolerance = 0.0;
  const MatX with = scene.follow(scene.values, request, true).state,
             without = scene.follow(scene.values, request, false).state;
  EXPECT_LT((with - without).norm(), 1e-9 * with.norm());
}

TEST(SensitiveMotion, EndsWhereItTakesMoreStepsThanItMay) {
  const Scene scene;
  MotionRequest request = flight_to(8e-3);
  request.tolerance = 1e-3;
  request.derivative_tolerance = 0.0;
  const SensitiveMotion whole = scene.follow(scene.values, request, false);
  ASSERT_GT(whole.steps, 20);
  request.most_steps = whole.steps / 2;
  EXPECT_THROW(scene.follow(scene.values, request, false), ComputationError);
  EXPECT_THROW(scene.follow(scene.values, request, true), ComputationError);
  request.most_steps = 2 * whole.steps;
  EXPECT_EQ(scene.follow(scene.values, request, false).state, whole.state);
}

TEST(SensitiveMotion, GrazingIsNoticed) {
  const Scene scene;
  MotionRequest request = flight_to(1e-4);
  request.start_state << 4.999e-5, 0.0, 0.0, 1.2e-3, 0.0, 0.0;
  const SensitiveMotion motion = scene.follow(scene.values, request, true);
  ASSERT_FALSE(motion.grazing.empty());
  EXPECT_NEAR(motion.grazing.front().speed, 1.2e-3, 2e-4);
  EXPECT_EQ(motion.grazing.front().clearance, 0);
}

}  // namespace sensitive_motion_test
}  // namespace boresight
