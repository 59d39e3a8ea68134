// Laws of drives' errors along a motion by poses, which tells its drives' courses only once it is known: what jumps there or has a corner is
// refused as it is along a drive's own course.
#include "boresight/mechanism/error_course.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace error_course_test {

// The hexapod of the examples, one leg of which errs by `laws`; its platform goes up by `z` [mm].
std::string hexapod(const std::vector<std::string>& laws, const std::string& z = "620 + 10*sin(pi*t/2)^2") {
  std::ifstream file(std::string(BORESIGHT_EXAMPLES) + "/hexapod/hexapod.toml");
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  text.resize(text.find("[motion]"));
  for (std::size_t i = 0; i < laws.size(); ++i)
    text += "[[error]]\nname = \"screw" + std::to_string(i) + "\"\ndrive = \"P1a\"\nlaw = \"" + laws[i] + "\"\n";
  return text +
         "[motion]\nduration = \"2 s\"\nbody = \"platform\"\n"
         "angles = { convention = \"ZYZ\", psi = \"0\", theta = \"0\", phi = \"0\" }\n"
         "position = { unit = \"mm\", x = \"0\", y = \"0\", z = \"" +
         z + "\" }\n";
}

std::string refusal_of(const std::string& text) {
  const Mechanism mechanism(read_mechanism_text(text, "f.toml"));
  try {
    IdealMotion::kinematic(mechanism);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ErrorAlongPoses, IsRefusedWithItsLineWhereItsLawJumpsOrHasACorner) {
  const std::string corner = "abs(q - 0.005)", text = hexapod({"q", corner});
  const auto lines_to = [&](const std::string& key) {
    return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(key)), '\n'));
  };
  const std::string said = refusal_of(text);
  EXPECT_EQ(said.substr(0, said.find(" at t =")), "f.toml:" + lines_to("law = \"abs") + ": error.screw1.law: found \"" +
                                                      corner + "\", which jumps or has a corner");
  EXPECT_NE(said.find(" s, expected a law whose value and rate are continuous"), std::string::npos) << said;
  for (const char* law : {"abs(q - 0.005)/(q - 0.005)", "abs(sin(2*pi*q/0.002))", "abs(t - 0.7)"})
    EXPECT_NE(refusal_of(hexapod({law}))
                  .find("error.screw0.law: found \"" + std::string(law) + "\", which jumps or has a corner at t = 0."),
              std::string::npos)
        << refusal_of(hexapod({law}));
}

TEST(ErrorAlongPoses, IsRefusedWhereItsLawHasNoValue) {
  const std::string said = refusal_of(hexapod({"sqrt(0.005 - q)"}));
  EXPECT_NE(said.find("which is not finite or not smooth at t = "), std::string::npos) << said;
}

TEST(ErrorAlongPoses, IsLetInWhereItsLawIsSmoothAsFarAsItsDriveGoes) {
  EXPECT_EQ(refusal_of(hexapod({"1", "q", "sin(2*pi*q/0.002)", "sqrt((q - 0.005)^2 + 1e-10)", "tanh((q - 0.005)/1e-7)",
                                "abs(q - 0.5)", "abs(q + 0.1)/(q + 0.1) + t^2"})),
            "no error");
}

// Rounding of a drive that stands still, or comes to rest, has jumps and corners of its own.
TEST(ErrorAlongPoses, IsLetInAlongDrivesThatStandStill) {
  const std::vector<std::string> laws = {"q", "abs(q + 1e-4)", "sin(2*pi*q/0.002)", "sin(2*pi*q/1e-5)*cos(t)", "q*t"};
  for (const char* z : {"620 + 1e-9*sin(pi*t)", "620 + 10*(1 - exp(-(20*t)^4))"})
    EXPECT_EQ(refusal_of(hexapod(laws, z)), "no error") << z;
  // A platform that only translates: what drives its legs' swing stands still, to rounding.
  MechanismDescription m =
      scenes::rrcpr({{"motion.angles.psi", "0"}, {"motion.angles.theta", "0"}, {"motion.angles.phi", "0"}});
  for (const char* law : {"abs(q)", "q", "sin(2*pi*q/1e-3)", "q*t"})
    m.errors.push_back(scenes::drive_error(m, "A1", law));
  EXPECT_NO_THROW(IdealMotion::kinematic(Mechanism(m)));
}

}  // namespace error_course_test
}  // namespace boresight
