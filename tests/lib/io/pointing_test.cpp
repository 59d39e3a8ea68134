// What a file says of its line of sight, and of where its journals start.
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {
namespace pointing_test {

const std::string kArm = R"toml(format = 1
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "arm"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "100 mm"]
inertia = ["2 kg m^2", "2 kg m^2", "1 kg m^2"]
boresight = [0, 3, 4]
[[joint]]
name = "R"
type = "revolute"
connects = ["ground", "arm"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]
driven = true
[motion]
duration = "1 s"
drives = { R = "t" }
)toml";

std::string error_of(const std::string& text) {
  try {
    const Mechanism m(read_mechanism_text(text, "f.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Pointing, TakesATargetAndAReferencePoint) {
  const Mechanism m(read_mechanism_text(
      kArm + "[pointing]\ntarget = [\"0 m\", \"0 m\", \"5 m\"]\nfrom = [\"0 mm\", \"10 mm\", \"0 mm\"]\n", "f.toml"));
  const LineOfSight& sight = m.pointing().line_of_sight.value();
  EXPECT_NEAR((sight.target - Vec3(0, 0, 5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((sight.from_B - Vec3(0, 0.01, -0.1)).norm(), 0.0, 1e-15);
  EXPECT_FALSE(sight.reversed);
}

TEST(Pointing, TakesADistanceAlongTheBoresightFromTheCentreOfMass) {
  const Mechanism m(read_mechanism_text(kArm + "[pointing]\ndistance = \"400 km\"\n", "f.toml"));
  const LineOfSight& sight = m.pointing().line_of_sight.value();
  EXPECT_NEAR((sight.target - Vec3(0, 240000, 320000.1)).norm(), 0.0, 1e-9);
  EXPECT_EQ(sight.from_B.norm(), 0.0);
}

TEST(Pointing, IsNoneWhereAFileNamesNone) {
  EXPECT_FALSE(Mechanism(read_mechanism_text(kArm, "f.toml")).pointing().line_of_sight.has_value());
}

TEST(Pointing, RefusesWhatNamesNoLine) {
  EXPECT_EQ(
      error_of(kArm + "[pointing]\nfrom = [\"0 m\", \"0 m\", \"0 m\"]\n"),
      R"~(f.toml:19: pointing.target: found nothing, expected a target, such as ["0 m", "0 m", "5 m"], or a distance along the boresight)~");
  EXPECT_EQ(error_of(kArm + "[pointing]\ndistance = \"1 m\"\ntarget = [\"0 m\", \"0 m\", \"0 m\"]\n"),
            "f.toml:20: pointing.distance: found both a target and a distance, expected one of the two");
  EXPECT_EQ(error_of(kArm + "[pointing]\ntarget = [\"0 mm\", \"0 mm\", \"100 mm\"]\n").substr(0, 40),
            "f.toml:20: pointing.target: found [\"0 mm");
  EXPECT_EQ(error_of(kArm + "[pointing]\ndistance = \"0 m\"\n").substr(0, 29), "f.toml:20: pointing.distance:");
  EXPECT_EQ(error_of(kArm + "[pointing]\ntraget = 1\n").substr(0, 27), "f.toml:20: pointing.traget:");
}

TEST(Initial, JournalsRestUnlessTheFileCentresThem) {
  const auto journals = [](const std::string& more, const std::vector<Setting>& settings = {}) {
    return read_mechanism_text(kArm + more, "f.toml", settings).journals;
  };
  EXPECT_EQ(journals(""), JournalStart::rest);
  EXPECT_EQ(journals("[initial]\njournals = \"rest\"\n"), JournalStart::rest);
  EXPECT_EQ(journals("[initial]\njournals = \"centred\"\n"), JournalStart::centred);
  EXPECT_EQ(journals("", {{"initial.journals", "centred"}}), JournalStart::centred);
  EXPECT_EQ(
      error_of(kArm + "[initial]\njournals = \"centered\"\n"),
      R"~(f.toml:20: initial.journals: found "centered", expected one of "rest", "centred"; did you mean centred?)~");
}

TEST(Clearance, OfACylindricalJointHasNoAxialOne) {
  const std::string slides = R"toml([[joint]]
name = "C"
type = "cylindrical"
connects = ["ground", "arm"]
point = ["0 mm", "0 mm", "50 mm"]
axis = [0, 0, 1]
[[clearance]]
joint = "C"
journal = "arm"
radial = "0.1 mm"
axial = "1 um"
journal_radius = "10 mm"
)toml";
  EXPECT_EQ(
      error_of(kArm + slides),
      R"~(f.toml:29: clearance.C.axial: found it on "C", a cylindrical joint, expected no axial clearance: the journal slides through its sleeve and has no end faces)~");
}

}  // namespace pointing_test
}  // namespace boresight
