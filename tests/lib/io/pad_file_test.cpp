// The clearance of a planar joint in a mechanism file: what it takes, and what it refuses by name.
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
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
            "f.toml:23: clearance.table.sleeve_length: found it on \"table\", a planar joint, expected axial and "
            "pad_radius alone: the gap on each side of a pad and the pad's radius");
  EXPECT_EQ(refusal(gap), "f.toml:18: clearance.table.pad_radius: found nothing, expected a length such as \"0.1 mm\"");
  EXPECT_EQ(refusal(radius), "f.toml:18: clearance.table.axial: found nothing, expected a length such as \"0.1 mm\"");
  EXPECT_EQ(refusal(gap + radius + "contact = { law = \"johnson\" }\n"),
            "f.toml:23: clearance.table.contact.law: found \"johnson\", a law for cylinders, expected a law for points "
            "or a spring: \"table\" is a pad between faces, to which it lends its damping");
}

}  // namespace pad_file_test
}  // namespace boresight
