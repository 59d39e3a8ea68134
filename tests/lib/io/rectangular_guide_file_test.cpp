// The clearance of a prismatic joint with a rectangular guide in a mechanism file: what it takes, and what it refuses by name.
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/mechanism/parameter_path.hpp"

namespace boresight {
namespace rectangular_guide_file_test {

constexpr char kSizes[] = "width = \"50 mm\"\nheight = \"30 mm\"\nlength = \"60 mm\"\n";
constexpr char kGaps[] = "width_gap = \"0.02 mm\"\nheight_gap = \"0.01 mm\"\n";
constexpr char kAcross[] = "width_direction = [0, 0.6, 0.8]\n";

std::string stage(const std::string& clearance, const char* type = "prismatic") {
  return std::string(R"toml(format = 1
name = "stage"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "stage"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "10 mm"]
inertia = ["2 kg m^2", "2 kg m^2", "1 kg m^2"]
boresight = [0, 0, 1]
[[joint]]
name = "rail"
type = ")toml") +
         type + R"toml("
connects = ["ground", "stage"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]
[motion]
duration = "1 s"
[[clearance]]
joint = "rail"
journal = "stage"
)toml" + clearance;
}

std::string refusal(const std::string& clearance, const char* type = "prismatic") {
  try {
    read_mechanism_text(stage(clearance, type), "f.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(RectangularGuideInAFile, HasSizesAndGapsInBothDirections) {
  const MechanismDescription m = read_mechanism_text(
      stage(std::string("guide = \"rectangular\"\naxes = \"free\"\n") + kSizes + kGaps + kAcross), "f.toml");
  ASSERT_EQ(m.clearances.size(), 1u);
  const ClearanceDescription& c = m.clearances[0];
  EXPECT_EQ(c.guide, GuideShape::rectangular);
  EXPECT_DOUBLE_EQ(c.parameters.width, 50e-3);
  EXPECT_DOUBLE_EQ(c.parameters.height, 30e-3);
  EXPECT_DOUBLE_EQ(c.parameters.length, 60e-3);
  EXPECT_DOUBLE_EQ(c.parameters.width_gap, 0.02e-3);
  EXPECT_DOUBLE_EQ(c.parameters.height_gap, 0.01e-3);
  EXPECT_LT((c.width_direction - Vec3(0.0, 0.6, 0.8)).norm(), 1e-15);
  // The guide's frame has its width along x.
  EXPECT_LT((Mechanism(m).geometry(0).first.R.col(0) - Vec3(0.0, 0.6, 0.8)).norm(), 1e-15);
  // Its paths are those of its own numbers.
  EXPECT_EQ(ParameterPath(m, "clearance.rail.width_gap", {}).unit(), "m");
  for (const char* path : {"clearance.rail.radial", "clearance.rail.axial", "clearance.rail.pad_radius"})
    EXPECT_THROW(ParameterPath(m, path, {}), InputError) << path;
}

TEST(RectangularGuideInAFile, RefusesWhatItHasNot) {
  const std::string shape = "guide = \"rectangular\"\n", all = shape + kSizes + kGaps + kAcross;
  EXPECT_EQ(
      refusal(all + "radial = \"1 mm\"\n"),
      "f.toml:28: clearance.rail.radial: found it on \"rail\", whose guide is rectangular, expected width, height, "
      "length, width_gap and height_gap: the slider's size and its gaps");
  EXPECT_EQ(
      refusal(std::string(kSizes) + "radial = \"0.1 mm\"\njournal_radius = \"9 mm\"\n"),
      "f.toml:21: clearance.rail.width: found it on \"rail\", which has no rectangular guide, expected it only on a "
      "prismatic joint with guide = \"rectangular\", or on a planar one with a rectangular pad");
  EXPECT_EQ(
      refusal(all, "cylindrical"),
      "f.toml:21: clearance.rail.guide: found it on \"rail\", a cylindrical joint, expected it only on a prismatic "
      "joint");
  EXPECT_EQ(refusal(shape + kSizes + kGaps + "width_direction = [1, 0.2, 0]\n"),
            "f.toml:27: clearance.rail.width_direction: found a direction that is not perpendicular to the axis of "
            "\"rail\", expected perpendicular directions");
  EXPECT_EQ(
      refusal(all + "contact = { law = \"johnson\" }\n"),
      "f.toml:28: clearance.rail.contact.law: found \"johnson\", a law for cylinders, expected a law for points or "
      "a spring: \"rail\" is a slider between faces, to which it lends its damping");
  EXPECT_NE(refusal(shape + kSizes + "width_gap = \"26 mm\"\nheight_gap = \"0.01 mm\"\n" + kAcross)
                .find("less than half of width"),
            std::string::npos);
}

}  // namespace rectangular_guide_file_test
}  // namespace boresight
