// Journals in a mechanism that floats free: no joint has coordinates for the ways that nothing holds.
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"

namespace boresight {
namespace floating_start_test {

const char* kFloatingHinge = R"toml(
format = 1
name = "a satellite and its panel"
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]

[[body]]
name = "satellite"
mass = "20 kg"
center_of_mass = ["0 m", "0 m", "0 m"]
inertia = ["1 kg m^2", "1 kg m^2", "1 kg m^2"]

[[body]]
name = "panel"
mass = "4 kg"
center_of_mass = ["0.5 m", "0 m", "0 m"]
inertia = ["0.02 kg m^2", "0.1 kg m^2", "0.1 kg m^2"]
boresight = [0, 0, 1]

[[joint]]
name = "hinge"
type = "revolute"
connects = ["satellite", "panel"]
point = ["0.3 m", "0 m", "0 m"]
axis = [0, 1, 0]
driven = true

[motion]
duration = "20 ms"
drives = { hinge = "0.3*sin(6*t)" }

[[clearance]]
joint = "hinge"
journal = "panel"
radial = "0.02 mm"
axial = "0.02 mm"
journal_radius = "8 mm"
cap_radius = "12 mm"
sleeve_length = "20 mm"
)toml";

TEST(FloatingStart, IsSaidToBeCentredWithoutAdviceToTakeTheRungThatSaysIt) {
  const auto m = std::make_shared<const Mechanism>(read_mechanism_text(kFloatingHinge, "floating.toml"));
  RunOptions options;
  options.step = 1e-4;
  const RunResult r = make_rung("multibody", m)->run(m->parameters(), options);
  ASSERT_FALSE(r.warnings.empty());
  EXPECT_NE(r.warnings.front().find("start in the middle of their sleeves: the mechanism can move in 6 way(s)"),
            std::string::npos)
      << r.warnings.front();
  for (const std::string& warning : r.warnings)
    EXPECT_EQ(warning.find("use the multibody rung"), std::string::npos) << warning;
}

}  // namespace floating_start_test
}  // namespace boresight
