// An azimuth axis that stands on the end face of its bearing, as every mount does.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace standing_gimbal_test {

constexpr const char* kGimbal = R"(
format = 1
name = "azimuth-elevation gimbal"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]

[[body]]
name = "yoke"
mass = "12 kg"
center_of_mass = ["0 mm", "0 mm", "120 mm"]
inertia = ["0.12 kg m^2", "0.10 kg m^2", "0.14 kg m^2"]

[[body]]
name = "tube"
mass = "8 kg"
center_of_mass = ["5 mm", "0 mm", "250 mm"]
inertia = ["0.05 kg m^2", "0.20 kg m^2", "0.20 kg m^2"]
boresight = [1, 0, 0]

[[joint]]
name = "AZ"
type = "revolute"
connects = ["ground", "yoke"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
driven = true

[[joint]]
name = "EL"
type = "revolute"
connects = ["yoke", "tube"]
point = ["0 mm", "0 mm", "250 mm"]
axis = [0, 1, 0]
driven = true

[motion]
duration = "0.1 s"
drives = { AZ = "0*t", EL = "0*t" }

[[clearance]]
joint = "AZ"
journal = "yoke"
radial = "20 um"
axial = "20 um"
journal_radius = "40 mm"
cap_radius = "60 mm"
sleeve_length = "80 mm"
axes = "free"
  [clearance.contact]
  law = "flores"
  restitution = 0.7
  young = ["210 GPa", "210 GPa"]
  poisson = [0.3, 0.3]
  density = "7800 kg/m^3"
  minimum_impact_speed = "1 mm/s"
  [clearance.friction]
  law = "modified-coulomb"
  coefficient = 0.05
  static_speed = "0.1 mm/s"
  dynamic_speed = "1 mm/s"

[[clearance]]
joint = "EL"
journal = "tube"
radial = "10 um"
axial = "10 um"
journal_radius = "20 mm"
cap_radius = "30 mm"
sleeve_length = "200 mm"
axes = "free"
  [clearance.contact]
  law = "flores"
  restitution = 0.7
  young = ["210 GPa", "210 GPa"]
  poisson = [0.3, 0.3]
  density = "7800 kg/m^3"
  minimum_impact_speed = "1 mm/s"
  [clearance.friction]
  law = "modified-coulomb"
  coefficient = 0.05
  static_speed = "0.1 mm/s"
  dynamic_speed = "1 mm/s"
)";

TEST(StandingGimbal, RestsEvenlyOnItsFaceAsMultibodySettles) {
  const auto mechanism = scenes::build(read_mechanism_text(kGimbal, "gimbal.toml"));
  RunOptions options;
  options.sample_spacing = 0.01;
  const RunResult rest = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), options);
  const RunResult settled = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  // A journal against both ends of its bore would turn the gimbal by 2 c / L_b, half a milliradian.
  EXPECT_LT(rest.index.orientation_error.max, 1e-6);
  EXPECT_LT(settled.boresight.samples.back().error.orientation, 1e-6);
  EXPECT_NEAR(rest.boresight.samples.back().error.displacement.z(),
              settled.boresight.samples.back().error.displacement.z(), 2e-8);
}

}  // namespace standing_gimbal_test
}  // namespace boresight
