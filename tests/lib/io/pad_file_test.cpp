// The clearance of a planar joint in a mechanism file: what it takes, and what it refuses by name.
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/mechanism/parameter_path.hpp"

namespace boresight {
namespace pad_file_test {

std::string stage(const std::string& clearance) {
  return R"toml(format = 1
name = "stage"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "stage"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "10 mm"]
inertia = ["2 kg m^2", "2 kg m^2", "1 kg m^2"]
boresight = [0, 0, 1]
[[joint]]
name = "table"
type = "planar"
connects = ["ground", "stage"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
[motion]
duration = "1 s"
[[clearance]]
joint = "table"
journal = "stage"
)toml" + clearance;
}

std::string refusal(const std::string& clearance) {
  try {
    read_mechanism_text(stage(clearance), "f.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(PadInAFile, HasAGapAndARadius) {
  const MechanismDescription m =
      read_mechanism_text(stage("axial = \"0.02 mm\"\npad_radius = \"40 mm\"\naxes = \"free\"\n"), "f.toml");
  ASSERT_EQ(m.clearances.size(), 1u);
  EXPECT_EQ(m.clearances[0].axes, JournalAxes::free);
  EXPECT_DOUBLE_EQ(m.clearances[0].parameters.axial, 0.02e-3);
  EXPECT_DOUBLE_EQ(m.clearances[0].parameters.pad_radius, 40e-3);
  // Its paths are those of its own numbers.
  EXPECT_EQ(ParameterPath(m, "clearance.table.pad_radius", {}).unit(), "m");
  EXPECT_THROW(ParameterPath(m, "clearance.table.radial", {}), InputError);
}

TEST(PadInAFile, RefusesWhatAJournalHas) {
  const std::string gap = "axial = \"0.02 mm\"\n", radius = "pad_radius = \"40 mm\"\n";
  EXPECT_EQ(refusal(gap + radius + "sleeve_length = \"3 mm\"\n"),
            "f.toml:23: clearance.table.sleeve_length: found it on \"table\", a planar joint, expected axial with "
            "pad_radius, "
            "or with width, length and width_direction: the gap on each side of a pad, and the pad's size");
  EXPECT_EQ(refusal(gap), "f.toml:18: clearance.table.pad_radius: found nothing, expected a length such as \"0.1 mm\"");
  EXPECT_EQ(refusal(radius), "f.toml:18: clearance.table.axial: found nothing, expected a length such as \"0.1 mm\"");
  EXPECT_EQ(refusal(gap + radius + "contact = { law = \"johnson\" }\n"),
            "f.toml:23: clearance.table.contact.law: found \"johnson\", a law for cylinders, expected a law for points "
            "or a spring: \"table\" is a pad between faces, to which it lends its damping");
}

TEST(PadInAFile, IsRectangularWhereItHasAWidth) {
  const MechanismDescription m = read_mechanism_text(
      stage("axial = \"0.02 mm\"\nwidth = \"40 mm\"\nlength = \"60 mm\"\nwidth_direction = [0.6, 0.8, 0]\n"), "f.toml");
  ASSERT_EQ(m.clearances.size(), 1u);
  const ClearanceDescription& c = m.clearances[0];
  EXPECT_EQ(c.pad, PadShape::rectangular);
  EXPECT_DOUBLE_EQ(c.parameters.axial, 0.02e-3);
  EXPECT_DOUBLE_EQ(c.parameters.width, 40e-3);
  EXPECT_DOUBLE_EQ(c.parameters.length, 60e-3);
  EXPECT_EQ(c.parameters.pad_radius, 0.0);
  EXPECT_LT((c.width_direction - Vec3(0.6, 0.8, 0.0)).norm(), 1e-15);
  for (const char* path : {"clearance.table.width", "clearance.table.length", "clearance.table.axial"})
    EXPECT_EQ(ParameterPath(m, path, {}).unit(), "m") << path;
  for (const char* path : {"clearance.table.pad_radius", "clearance.table.height", "clearance.table.width_gap"})
    EXPECT_THROW(ParameterPath(m, path, {}), InputError) << path;
  // Its width lies along the x of both frames of the joint.
  const Mechanism mechanism(m);
  EXPECT_LT((mechanism.geometry(0).first.R.col(0) - Vec3(0.6, 0.8, 0.0)).norm(), 1e-15);
}

TEST(PadInAFile, IsRoundOrRectangularAndNotBoth) {
  const std::string gap = "axial = \"0.02 mm\"\n", radius = "pad_radius = \"40 mm\"\n", width = "width = \"40 mm\"\n",
                    length = "length = \"60 mm\"\n", along = "width_direction = [1, 0, 0]\n";
  for (const std::string& part : {width, length, along})
    EXPECT_EQ(refusal(gap + radius + part),
              "f.toml:22: clearance.table.pad_radius: found it on \"table\", whose pad is rectangular, expected either "
              "pad_radius, of a round pad, or width, length and width_direction");
  EXPECT_EQ(refusal(gap + length + along),
            "f.toml:18: clearance.table.width: found nothing, expected a length such as \"0.1 mm\"");
  EXPECT_EQ(refusal(gap + width + along),
            "f.toml:18: clearance.table.length: found nothing, expected a length such as \"0.1 mm\"");
  EXPECT_NE(refusal(gap + width + length).find("clearance.table.width_direction: found nothing"), std::string::npos);
  EXPECT_EQ(refusal(gap + width + length + "width_direction = [1, 0, 0.2]\n"),
            "f.toml:24: clearance.table.width_direction: found a direction that is not perpendicular to the axis of "
            "\"table\", expected perpendicular directions");
  EXPECT_EQ(
      refusal(gap + width + length + along + "height = \"40 mm\"\n"),
      "f.toml:25: clearance.table.height: found it on \"table\", which has no rectangular guide, expected it only "
      "on a prismatic joint with guide = \"rectangular\"");
}

}  // namespace pad_file_test
}  // namespace boresight
