// The envelope of one slider in a rectangular guide, by closed form: its two directions stand across each other.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"

namespace boresight {
namespace guide_bound_test {

constexpr double kWidthGap = 30e-6, kHeightGap = 40e-6, kLength = 0.1;

RunResult envelope(const char* axes) {
  const std::string text = std::string(R"toml(format = 1
name = "car"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "car"
mass = "0.01 kg"
center_of_mass = ["0 m", "0 m", "0 m"]
inertia = ["1e-5 kg m^2", "1e-5 kg m^2", "1e-5 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
boresight = [0, 1, 0]
[[joint]]
name = "rail"
type = "prismatic"
connects = ["ground", "car"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 1, 0]
driven = true
[motion]
duration = "0.01 s"
drives = { rail = "0" }
[[clearance]]
joint = "rail"
journal = "car"
guide = "rectangular"
width_direction = [1, 0, 0]
width_gap = "30 um"
height_gap = "40 um"
width = "30 mm"
height = "20 mm"
length = "100 mm"
axes = ")toml") + axes + R"toml("
[clearance.contact]
law = "lankarani-nikravesh"
restitution = 0.5
young = ["207 GPa", "207 GPa"]
poisson = [0.3, 0.3]
)toml";
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism_text(text, "car.toml"));
  RunOptions options;
  options.sample_spacing = 0.0;
  options.model_look = ModelLook::none;
  return make_rung("envelope", mechanism)->run(mechanism->parameters(), options);
}

TEST(GuideBound, IsTheCornerOfBothGapsAndNotTheirSum) {
  EXPECT_NEAR(envelope("parallel").index.position_error.max, std::hypot(kWidthGap, kHeightGap), 1e-8);
}

// One end in one corner and the other in the opposite one.
TEST(GuideBound, OfATiltIsTheCornerOfBothToo) {
  EXPECT_NEAR(envelope("free").index.boresight_error.max, std::hypot(kWidthGap, kHeightGap) / (0.5 * kLength), 1e-6);
}

}  // namespace guide_bound_test
}  // namespace boresight
