// Standing errors and contact parameters of one rig, from the same data.
#include <gtest/gtest.h>

#include <cstdio>

#include "boresight/io/expression.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/calibration/calibrate.hpp"
#include "boresight_analyses/calibration/rig.hpp"

namespace boresight {
namespace errors_and_contacts_test {

// The example's rig, whose crank is told 0.3 mrad wrong and whose coupler is 40 um too long.
std::shared_ptr<const Mechanism> rig_with_errors(const std::string& speed) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/calibration/rig.toml",
                                          {{"motion.drives.A", "2*pi*" + speed + "*t"}});
  const auto joint = [&](const std::string& name) {
    for (std::size_t j = 0; j < m.joints.size(); ++j)
      if (m.joints[j].name == name) return static_cast<int>(j);
    throw std::logic_error(name);
  };
  ErrorDescription zero;
  zero.name = "crank.zero";
  zero.kind = ErrorDescription::Kind::drive;
  zero.joint = joint("A");
  zero.law = parse_coordinate_function("1");
  zero.value = 0.3e-3;
  m.errors.push_back(zero);
  ErrorDescription length;
  length.name = "coupler.length";
  length.kind = ErrorDescription::Kind::translation;
  length.joint = joint("C");
  length.body = m.joints[static_cast<std::size_t>(joint("B"))].second;
  length.direction =
      (m.joints[static_cast<std::size_t>(joint("C"))].point - m.joints[static_cast<std::size_t>(joint("B"))].point)
          .normalized();
  length.value = 40e-6;
  m.errors.push_back(length);
  return std::make_shared<const Mechanism>(std::move(m));
}

TEST(Calibrate, SaysThatPlayCountsAsNoiseWhereErrorsAloneAreFitted) {
  SyntheticRig rig;
  rig.samples = 50;
  const auto mechanism = rig_with_errors("2");
  const std::vector<double> times = sample_times(rig, 0.2);
  CalibrationProblem problem;
  problem.runs.emplace_back(
      "poses", mechanism,
      with_rig_errors(rig, times, multibody_readings(mechanism, mechanism->parameters(), times, rig.channels), 0));
  problem.parameters.push_back(fitted_parameter(mechanism->description(), "error.crank.zero", 0.0));
  problem.prepare(10.0, true);
  EXPECT_EQ(problem.freedoms(0), 0);
  const CalibrationResult result = calibrate(problem, {});
  ASSERT_GE(result.warnings.size(), 1u);
  // Nothing else but the channels that the play moves and the fit does not explain.
  for (std::size_t k = 1; k < result.warnings.size(); ++k)
    EXPECT_NE(result.warnings[k].find("these readings"), std::string::npos) << result.warnings[k];
  EXPECT_NE(result.warnings.front().find("the play of D is not followed"), std::string::npos)
      << result.warnings.front();
  // Play of 0.2 mm stands in the readings: far more than the rig's noise is left, and the interval says so.
  const ParameterEstimate& zero = result.inference.parameters.front();
  EXPECT_NEAR(zero.value, 0.3e-3, 4.0 * zero.standard_error);
  EXPECT_GT(zero.standard_error, 2e-5);
}

TEST(CalibrateLong, RecoversErrorsAndContactsOfTheExampleRigTogether) {
  const std::vector<std::string> contacts = {"clearance.D.radial", "clearance.D.contact.restitution",
                                             "clearance.D.friction.coefficient", "clearance.D.contact.stiffness_scale"},
                                 errors = {"error.crank.zero", "error.coupler.length"};
  SyntheticRig rig;
  rig.seed = 3;
  CalibrationProblem problem;
  const std::vector<double> times = sample_times(rig, 0.2);
  for (const char* speed : {"2", "2.4", "2.8"}) {
    const auto mechanism = rig_with_errors(speed);
    const MatX clean = multibody_readings(mechanism, mechanism->parameters(), times, rig.channels);
    problem.runs.emplace_back(speed, mechanism,
                              with_rig_errors(rig, times, clean, static_cast<int>(problem.runs.size())));
  }
  const Mechanism& first = *problem.runs.front().mechanism;
  const auto truth = [&](const std::string& path) {
    return ParameterPath(first.description(), path).get(first.parameters());
  };
  for (const std::string& path : contacts)
    problem.parameters.push_back(
        fitted_parameter(first.description(), path, truth(path) * (path.ends_with("restitution") ? 0.8 : 1.2)));
  for (const std::string& path : errors) problem.parameters.push_back(fitted_parameter(first.description(), path, 0.0));
  problem.prepare(10.0, true);
  CalibrationOptions options;
  options.jobs = 2;
  const CalibrationResult result = calibrate(problem, options);
  EXPECT_TRUE(result.fit.converged) << result.fit.reason;
  EXPECT_NEAR(result.inference.variance_factor, 1.0, 0.15);
  EXPECT_NEAR(result.confirmation, 1.0, 0.1);
  EXPECT_TRUE(result.inference.confused.empty());
  for (const ParameterEstimate& e : result.inference.parameters) {
    std::printf("  %s: %.5g +- %.2g, made with %.5g\n", e.name.c_str(), e.value, e.standard_error, truth(e.name));
    EXPECT_TRUE(e.identifiable) << e.name << ": " << e.reason;
    EXPECT_LT(std::abs(e.value - truth(e.name)), 3.0 * e.standard_error) << e.name;
  }
  // Far better than they were known: half a percent of the crank's zero, a micrometre of the coupler.
  EXPECT_LT(result.inference.parameters[4].standard_error, 0.1 * 0.3e-3);
  EXPECT_LT(result.inference.parameters[5].standard_error, 0.1 * 40e-6);
}

}  // namespace errors_and_contacts_test
}  // namespace boresight
