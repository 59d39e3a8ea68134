// How fast loads change is found wherever in a motion they do it.
#include "boresight/mechanism/load_time.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"

namespace boresight {
namespace load_time_test {

Mechanism pushed_arm(const std::string& force, const std::string& duration) {
  return Mechanism(read_mechanism_text(R"toml(format = 1
name = "arm"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "arm"
mass = "3 kg"
center_of_mass = ["0.1 m", "0 m", "0 m"]
inertia = ["0.1 kg m^2", "0.1 kg m^2", "0.1 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "az"
type = "revolute"
connects = ["ground", "arm"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 0, 1]
driven = true
[motion]
drives = { az = "0.3*t/1000" }
duration = ")toml" + duration + R"toml("
[[load]]
body = "arm"
point = ["0.3 m", "0 m", "0 m"]
force = ["0", "0", ")toml" + force + R"toml("]
)toml",
                                       "arm.toml"));
}

// A bell exp(-(t / w)^2) changes by its height in w sqrt(e / 2) at its steepest.
TEST(LoadTime, OfABlowIsFoundAtAnyTimeOfALongMotion) {
  const double bell = 1e-3 * std::sqrt(0.5 * std::exp(1.0));
  for (int k = 0; k < 40; ++k) {
    const double at = 437.1 + 0.00137 * k;
    const double found = load_time(pushed_arm("200*exp(-((t - " + std::to_string(at) + ")/0.001)^2)", "1000 s"));
    EXPECT_GT(found, 0.5 * bell) << at;
    EXPECT_LT(found, 3.0 * bell) << at;
  }
}

TEST(LoadTime, OfASinusoidIsTwoOverItsFrequency) {
  for (const char* duration : {"0.05 s", "1 s", "300 s"})
    EXPECT_NEAR(load_time(pushed_arm("5*sin(400*t)", duration)), 2.0 / 400.0, 1e-4) << duration;
}

TEST(LoadTime, OfWhatKeepsStillIsInfinite) { EXPECT_TRUE(std::isinf(load_time(pushed_arm("5", "10 s")))); }

}  // namespace load_time_test
}  // namespace boresight
