// Data of motions that rattle, past the time to which any step foretells them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "boresight_analyses/calibration/calibrate.hpp"
#include "four_bar_rig.hpp"

namespace boresight {
namespace foretold_data_test {

// A body thrown about in a bearing with play, on no drive and without gravity: within a tenth of a second its impacts part motions that begin
// a micrometre from one another.
std::shared_ptr<const Mechanism> rattle() {
  return std::make_shared<const Mechanism>(read_mechanism_text(
      R"toml(format = 1
name = "rattle"
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "link"
mass = "3.4 kg"
center_of_mass = ["0 mm", "7 mm", "-18 mm"]
inertia = ["0.0052 kg m^2", "0.0101 kg m^2", "0.0122 kg m^2"]
boresight = [0, 0, 1]
[[joint]]
name = "A"
type = "revolute"
connects = ["ground", "link"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0.232, -0.973, 0]
[motion]
duration = "0.3 s"
[initial]
rates = { A = "-1.18 rad/s" }
[[load]]
body = "link"
point = ["-84 mm", "-68 mm", "-56 mm"]
force = ["-0.3*sin(30*t)", "-6.8", "-5.1*cos(30*t)"]
[[clearance]]
joint = "A"
journal = "ground"
radial = "0.38 mm"
axial = "0.98 mm"
cap_radius = "63 mm"
journal_radius = "50 mm"
sleeve_length = "390 mm"
axes = "free"
  [clearance.contact]
  law = "hu-guo"
  restitution = 0.65
  young = ["210 GPa", "110 GPa"]
  poisson = [0.3, 0.34]
  density = "4500 kg/m^3"
  minimum_impact_speed = "2.3 mm/s"
  [clearance.friction]
  law = "modified-coulomb"
  coefficient = 0.04
  static_speed = "0.5 mm/s"
  dynamic_speed = "10 mm/s"
)toml",
      "rattle.toml"));
}

TEST(ForetoldData, ThoseBeyondAreLeftOutAndTheRestTellsTheParameters) {
  const auto mechanism = rattle();
  const std::vector<double> t = four_bar::times(0.3);
  SyntheticRig rig;
  rig.channels = {0, 1, 2};
  rig.deviation = 1e-6;
  CalibrationProblem problem;
  problem.runs.emplace_back("run", mechanism,
                            with_rig_errors(rig, t, four_bar::own_readings(mechanism, t, rig.channels), 0));
  problem.parameters.push_back(fitted_parameter(mechanism->description(), "clearance.A.radial", 0.42e-3));
  problem.prepare(10.0, true);
  CalibrationOptions options;
  options.jobs = 2;
  options.starts = 1;
  options.corrections = 0;
  const CalibrationResult result = calibrate(problem, options);
  const auto left_out = std::find_if(result.warnings.begin(), result.warnings.end(), [](const std::string& warning) {
    return warning.find("of 301 samples are left out") != std::string::npos;
  });
  ASSERT_NE(left_out, result.warnings.end());
  EXPECT_GT(result.inference.values, 3 * 40);
  EXPECT_LT(result.inference.values, 3 * 250);
  const ParameterEstimate& radial = result.inference.parameters.front();
  EXPECT_TRUE(radial.identifiable) << radial.reason;
  EXPECT_LT(radial.standard_error, 2e-3 * 0.38e-3);
  EXPECT_LT(std::abs(radial.value - 0.38e-3), 3.0 * radial.standard_error);
}

}  // namespace foretold_data_test
}  // namespace boresight
