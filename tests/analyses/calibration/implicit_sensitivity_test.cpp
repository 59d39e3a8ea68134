// Slopes carried by implicit steps: those of explicit ones, at a cost that damping does not drive up.
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/slopes/sensitive_motion.hpp"
#include "boresight/slopes/start_slopes.hpp"

namespace boresight {
namespace implicit_sensitivity_test {

class Scene {
 public:
  Scene(const std::vector<Setting>& settings, const std::vector<std::string>& varied)
      : mechanism(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml", settings)),
        prepared(mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters()),
        tables(prepared.tables(mechanism.parameters())) {
    for (const std::string& path : varied) paths.emplace_back(mechanism.description(), path);
    for (const ParameterPath& path : paths) values.push_back(path.get(mechanism.parameters()));
  }
  Parameters at(const std::vector<double>& v) const {
    Parameters p = mechanism.parameters();
    for (std::size_t k = 0; k < paths.size(); ++k) paths[k].set(p, v[k]);
    return p;
  }
  ContactNumbers numbers() const {
    return contact_numbers(
        mechanism, [&](const auto& x) { return at(x); }, values);
  }
  SensitiveMotion follow(const MotionRequest& request) const {
    return follow_with_sensitivity(mechanism, at(values), tables, numbers(), request);
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

  Mechanism mechanism;
  PreparedScene prepared;
  std::shared_ptr<const SceneTables> tables;
  std::vector<ParameterPath> paths;
  std::vector<double> values;
};

// Per row: of a derivative's columns, over the largest column, rates times the flight's time.
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
  EXPECT_TRUE(implicit_steps_pay(damped.mechanism, damped.at(damped.values), damped.tables, damped.numbers(), request));
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
  EXPECT_FALSE(implicit_steps_pay(light.mechanism, light.at(light.values), light.tables, light.numbers(), request));
}

}  // namespace implicit_sensitivity_test
}  // namespace boresight
