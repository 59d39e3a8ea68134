// What a file leaves out of a clearance is said, and what it gives is not.
#include "boresight/io/assumed_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace boresight {
namespace assumed_values_test {

const std::string kFile = R"toml(format = 1
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "arm"
mass = "1 kg"
center_of_mass = ["0 m", "0 m", "1 m"]
inertia = ["1 kg m^2", "1 kg m^2", "1 kg m^2"]
boresight = [0, 0, 1]
[[body]]
name = "hand"
mass = "1 kg"
center_of_mass = ["0 m", "0 m", "2 m"]
inertia = ["1 kg m^2", "1 kg m^2", "1 kg m^2"]
[[joint]]
name = "R"
type = "revolute"
connects = ["ground", "arm"]
point = ["0 m", "0 m", "0 m"]
axis = [1, 0, 0]
driven = true
[[joint]]
name = "S"
type = "revolute"
connects = ["arm", "hand"]
point = ["0 m", "0 m", "1 m"]
axis = [1, 0, 0]
driven = true
[motion]
duration = "1 s"
drives = { R = "sin(t)", S = "0" }
[[clearance]]
joint = "R"
journal = "arm"
radial = "0.1 mm"
axial = "0.1 mm"
journal_radius = "10 mm"
cap_radius = "16 mm"
sleeve_length = "30 mm"
)toml";

const std::string kWhole = R"toml(axes = "parallel"
[clearance.contact]
law = "flores"
young = ["210 GPa", "210 GPa"]
poisson = [0.3, 0.3]
restitution = 0.8
minimum_impact_speed = "1 mm/s"
density = "7800 kg/m^3"
[clearance.friction]
law = "none"
)toml";

std::set<std::string> keys_of(const std::string& text, const std::vector<Setting>& settings = {}) {
  std::set<std::string> keys;
  for (const AssumedValue& a : assumed_values_of_text(text, "f.toml", settings)) keys.insert(a.key);
  return keys;
}

TEST(AssumedValues, AreNoneWhereEverythingIsGiven) { EXPECT_EQ(keys_of(kFile + kWhole), std::set<std::string>{}); }

TEST(AssumedValues, NameEachKeyThatResultsHangOn) {
  EXPECT_EQ(keys_of(kFile),
            (std::set<std::string>{"axes", "contact.law", "contact.young", "contact.poisson", "contact.restitution",
                                   "contact.minimum_impact_speed", "contact.density", "friction.coefficient"}));
}

TEST(AssumedValues, AreNotAssumedWhereASettingGivesThem) {
  EXPECT_FALSE(keys_of(kFile, {{"clearance.R.contact.young", "210 GPa"}}).contains("contact.young"));
}

TEST(AssumedValues, FollowTheLawsInForce) {
  // A spring knows no restitution; a law that sticks has bristles.
  const auto spring = keys_of(kFile + "[clearance.contact]\nlaw = \"kelvin-voigt\"\nstiffness = \"1e7 N/m\"\n");
  EXPECT_FALSE(spring.contains("contact.restitution"));
  EXPECT_TRUE(spring.contains("contact.damping"));
  const auto sticking = keys_of(kFile + "[clearance.friction]\nlaw = \"lugre\"\ncoefficient = 0.1\n");
  EXPECT_TRUE(sticking.contains("friction.bristle_stiffness"));
  EXPECT_FALSE(sticking.contains("friction.static_speed"));
}

TEST(AssumedValues, AreSaidInOneSentenceForJointsThatLackTheSame) {
  const std::string second =
      "[[clearance]]\njoint = \"S\"\njournal = \"hand\"\nradial = \"0.1 mm\"\naxial = \"0.1 mm\"\n"
      "journal_radius = \"10 mm\"\ncap_radius = \"16 mm\"\nsleeve_length = \"30 mm\"\n";
  const auto sentences = in_words(assumed_values_of_text(kFile + second, "f.toml"));
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(
      sentences[0],
      "R, S: not given, so assumed: axes = \"parallel\", contact.law = \"flores\", contact.young = 72 GPa (aluminium), "
      "contact.poisson = 0.33, contact.restitution = 0.9, contact.minimum_impact_speed = 1 mm/s, contact.density = "
      "2700 kg/m^3, "
      "friction.coefficient = 0 (none)");
  EXPECT_EQ(in_words(assumed_values_of_text(kFile + second + kWhole, "f.toml")).size(), 1u);
}

}  // namespace assumed_values_test
}  // namespace boresight
