// Slopes carried by implicit steps: those of explicit ones, at a cost that damping does not drive up.
#include <gtest/gtest.h>

#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/slopes/sensitive_motion.hpp"
#include "boresight/slopes/start_slopes.hpp"
#include "crank_slider_scene.hpp"

namespace boresight {
namespace implicit_sensitivity_test {

class Scene : public crank_slider::Scene {
 public:
  using crank_slider::Scene::Scene;

  SensitiveMotion follow(const MotionRequest& request) const {
    return follow_with_sensitivity(mechanism, at(values), tables, numbers(values), request);
  }
  bool implicit_steps_pay(const MotionRequest& request) const {
    return boresight::implicit_steps_pay(mechanism, at(values), tables, numbers(values), request);
  }
  // To `end`, begun where journals rest.
  MotionRequest from_rest(double end) const {
    MotionRequest request;
    request.end = end;
    request.times = {0.25 * end, 0.5 * end, end};
    const StartSlopes start = start_slopes(
        mechanism, *tables, [&](const auto& x) { return at(x); }, values, true);
    request.start_state = start.state;
    request.start_by_parameters = start.by;
    return request;
  }
};

// Of the columns of two derivatives, each over its size, rates times the flight's time: the largest difference.
double apart(const MatX& a, const MatX& b) {
  const auto scaled = [](MatX m) {
    m.bottomRows(m.rows() / 2) *= kFlightTime;
    return m;
  };
  double worst = 0.0;
  for (Eigen::Index d = 0; d < a.cols(); ++d)
    worst = std::max(worst, scaled(a - b).col(d).norm() / scaled(a).col(d).norm());
  return worst;
}

TEST(ImplicitSensitivity, ThroughImpactsIsThatOfExplicitSteps) {
  const Scene scene({}, {"clearance.A.radial", "clearance.A.contact.restitution", "clearance.A.friction.coefficient"});
  MotionRequest request = scene.from_rest(8e-3);
  request.start_state << 2e-5, 1e-5, -1e-5, 0.02, 0.001, 0.03;
  request.start_by_parameters = MatX();
  request.by_parameters = request.by_start_state = true;
  request.tolerance = 1e-9;
  request.derivative_tolerance = 1e-9;
  const SensitiveMotion by_explicit = scene.follow(request);
  ASSERT_GE(by_explicit.impact_speed.size(), 2u);
  request.implicit = true;
  const SensitiveMotion by_implicit = scene.follow(request);
  EXPECT_EQ(by_implicit.impact_joint, by_explicit.impact_joint);
  for (std::size_t k = 0; k < request.times.size(); ++k)
    EXPECT_LT(apart(by_explicit.by[k], by_implicit.by[k]), 2e-5) << k;
  // With directions and without the steps are the same.
  request.derivative_tolerance = 0.0;
  const MatX with = scene.follow(request).state;
  request.by_parameters = request.by_start_state = false;
  EXPECT_LT((scene.follow(request).state - with).norm(), 1e-9 * with.norm());
}

// The journal lies in a contact so damped that explicit steps stay far shorter than the motion asks for.
TEST(ImplicitSensitivity, PaysWhereDampingKeepsExplicitStepsShort) {
  const Scene damped({{"clearance.A.contact.law", "kelvin-voigt"},
                      {"clearance.A.contact.stiffness", "20 GN/m"},
                      {"clearance.A.contact.damping", "2 MN s/m"}},
                     {"clearance.A.radial"});
  MotionRequest request = damped.from_rest(5e-3);
  request.tolerance = 1e-7;
  EXPECT_TRUE(damped.implicit_steps_pay(request));
  request.by_parameters = true;
  request.derivative_tolerance = 1e-4;
  const SensitiveMotion by_explicit = damped.follow(request);
  request.implicit = true;
  const SensitiveMotion by_implicit = damped.follow(request);
  EXPECT_LT(10 * by_implicit.steps, by_explicit.steps);
  EXPECT_LT(apart(by_explicit.by.back(), by_implicit.by.back()), 1e-3);

  const Scene light({}, {"clearance.A.radial"});
  request = light.from_rest(8e-3);
  request.tolerance = 1e-7;
  EXPECT_FALSE(light.implicit_steps_pay(request));
}

}  // namespace implicit_sensitivity_test
}  // namespace boresight
