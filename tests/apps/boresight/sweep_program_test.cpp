// What a sweep says of its points: its rung holds between the ends too, and what a point warns of is heard.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"

namespace boresight::app {
namespace sweep_program_test {

using testing::Contains;
using testing::HasSubstr;

class SweepProgram : public Program {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
};

// At both ends the bound is next to the truth: heavy loads lie at it, and next to none lets journals stand anywhere. Between them it is 11 % above.
TEST_F(SweepProgram, ChoosesARungThatHoldsBetweenTheEndsToo) {
  ASSERT_EQ(call({"new", "antenna"}).status, 0);
  write("antenna/study.toml",
        "format = 1\nmechanism = \"mechanism.toml\"\naccuracy = \"2 %\"\n[index]\nquantity = \"boresight_error\"\n"
        "statistic = \"max\"\n[[sweep.axis]]\nparameter = \"gravity.z\"\n"
        "values = [\"-9.81 m/s^2\", \"-1 m/s^2\", \"-0.05 m/s^2\"]\n");
  ASSERT_EQ(call({"sweep", "antenna/study.toml", "--out", "auto", "--quiet"}).status, 0);
  ASSERT_EQ(call({"sweep", "antenna/study.toml", "--out", "exact", "--quiet", "--rung", "multibody"}).status, 0);
  const auto chosen = json("auto/summary.json")["index"]["values"],
             exact = json("exact/summary.json")["index"]["values"];
  ASSERT_EQ(chosen.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(chosen[k].get<double>() / exact[k].get<double>(), 1.0, 0.02) << k;
}

TEST_F(SweepProgram, TellsWhatItsPointsWarnOfOnce) {
  write("wide.toml", R"toml(format = 1
name = "wide"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "slider"
mass = "2 kg"
center_of_mass = ["10 mm", "10 mm", "0 mm"]
inertia = ["0.002 kg m^2", "0.002 kg m^2", "0.002 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "G"
type = "prismatic"
connects = ["ground", "slider"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]
driven = true
[motion]
duration = "20 ms"
drives = { G = "0*t" }
[[clearance]]
joint = "G"
journal = "slider"
guide = "rectangular"
width_gap = "0.03 mm"
height_gap = "0.02 mm"
width = "200 mm"
height = "20 mm"
length = "20 mm"
width_direction = [0, 1, 0]
axes = "free"
  [clearance.contact]
  law = "flores"
  restitution = 0.6
  young = ["207 GPa", "72 GPa"]
  poisson = [0.3, 0.33]
)toml");
  write("study.toml",
        "format = 1\nmechanism = \"wide.toml\"\n[[sweep.axis]]\nparameter = \"clearance.G.width_gap\"\n"
        "values = [\"0.1 mm\", \"0.12 mm\"]\n");
  const Ended ended = call({"sweep", "study.toml", "--out", "out", "--rung", "quasistatic"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out + ended.err, HasSubstr("to first order in its gaps"));
  EXPECT_THAT(ended.out + ended.err, HasSubstr("(at 2 of 2 points)"));
  const auto summary = json("out/summary.json");
  EXPECT_THAT(summary["warnings"], Contains(HasSubstr("(at 2 of 2 points)")));
  for (const auto& point : summary["points"]) EXPECT_THAT(point["warnings"], Contains(HasSubstr("about")));
  const Ended checked = call({"check", "wide.toml", "--set", "clearance.G.width_gap=0.1mm"});
  EXPECT_THAT(checked.out, HasSubstr("to first order in its gaps"));
}

}  // namespace sweep_program_test
}  // namespace boresight::app
