// Whatever is wrong with a mechanism file: one line that says where, what was found, what was expected.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "good_file.hpp"

namespace boresight {
namespace error_line_test {

TEST(ErrorLine, IsAbsentWhereTheFileIsGood) { EXPECT_EQ(error_of(kGood), "no error"); }

TEST(ErrorLine, IsOfTheLetterBeyondAsciiThatStandsOutsideQuotationMarks) {
  const auto refused_at = [](int line) {
    return "f.toml:" + std::to_string(line) +
           ": found a letter beyond ASCII outside quotation marks, expected it inside them, or none";
  };
  const std::string name = "name = \"test\"";
  for (const char* fine : {"name = \"t\u00e9st\"  # \u00b5, \"", "name = 't\u00e9st\\'", "name = \"a \\\" \u00b5\"",
                           "name = \"\"\"\n\u00b5 \\\"\" \"\"\"\"\"  # \u00b5", "name = \'\'\'\u3000\n\\\'\'\'"})
    EXPECT_EQ(error_of(with(name, fine)), "no error") << fine;
  for (const char* stray : {"name = \"test\" \u00b5", "n\u00e4me = \"test\"", "name = \"test\"\u00a0", "name = \u00e9",
                            "name = \u4e00\"test\""})
    EXPECT_EQ(error_of(with(name, stray)), refused_at(2)) << stray;
  EXPECT_EQ(error_of(with(name, "name = \"\"\"\n\u00b5\\\n\"\"\" \u00b5")), refused_at(4));
  EXPECT_EQ(error_of("\xEF\xBB\xBF" + kGood), "no error");
}

TEST(ErrorLine, GivesTheLineOfAFaultInTheToml) {
  check({
      {"name = \"arm\"", "name = \"arm",
       R"~(f.toml:5: found a fault in the TOML (Error while parsing string: unescaped control characters other than TAB (U+0009) are explicitly prohibited), expected TOML 1.0)~"},
      {"mass = \"1 kg\"", "mass = \"1 kg\"\nmass = \"1 kg\"",
       R"~(f.toml:7: found a fault in the TOML (Error while parsing key-value pair: cannot redefine existing string 'mass'), expected TOML 1.0)~"},
      {"[motion]", "[motion",
       R"~(f.toml:34: found a fault in the TOML (Error while parsing table header: expected ']', saw '\n'), expected TOML 1.0)~"},
      {"mass = \"1 kg\"", "mass = ",
       R"~(f.toml:6: found a fault in the TOML (Error while parsing key-value pair: expected value, saw '\n'), expected TOML 1.0)~"},
      {"mass = \"1 kg\"", "mass = [ } ]",
       R"~(f.toml:6: found a fault in the TOML (Error while parsing value: could not determine value type), expected TOML 1.0)~"},
  });
}

TEST(ErrorLine, RefusesNestingThatWouldExhaustTheStack) {
  std::string key = "a";
  for (int i = 0; i < 100; ++i) key += ".a";
  EXPECT_EQ(error_of(with("[motion]", "[" + key + "]\n[motion]")),
            "f.toml:34: found a key of more than 64 parts, expected a shorter key");
  EXPECT_EQ(
      error_of(with("mass = \"1 kg\"", "mass = " + std::string(400, '['))),
      "f.toml:6: found a fault in the TOML (Error while parsing value: exceeded maximum nested value depth of 256 "
      "(TOML_MAX_NESTED_VALUES)), expected TOML 1.0");
}

TEST(ErrorLine, StaysOneLineWhateverTheFileHolds) {
  const std::string line = error_of(with("connects = [\"arm\", \"slider\"]",
                                         "connects = [\"a\\nb\\u0007" + std::string(5000, 'x') + "\", \"slider\"]"));
  EXPECT_LT(line.size(), 400u);
  EXPECT_EQ(line.substr(0, 45), "f.toml:30: joint.P.connects: found \"a b xxxxx");
}

TEST(ErrorLine, SaysThatAFileIsNotThereOrTooLarge) {
  const auto error_of_file = [](const std::string& path) -> std::string {
    try {
      read_mechanism(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of_file("/nowhere/at/all.toml"),
            "/nowhere/at/all.toml: found no such file, expected a file that exists");
  EXPECT_EQ(error_of_file("/tmp"), "/tmp: found a folder, expected a file");
  const std::string path = testing::TempDir() + "boresight_too_large.toml";
  std::ofstream(path) << std::string((16u << 20) + 1, ' ');
  EXPECT_EQ(error_of_file(path), path + ": found a file of more than 16 MiB, expected a smaller file");
  std::remove(path.c_str());
}

TEST(ErrorLine, OfASettingNamesTheSettingAndNoLine) {
  EXPECT_EQ(error_of(kGood, {{"body.arm.mass", "2 kg"}}), "no error");
  EXPECT_EQ(error_of(kGood, {{"body.arm.mass", "-2kg"}}),
            "--set body.arm.mass=-2kg: body.arm.mass: found \"-2kg\", expected a mass above zero");
  EXPECT_EQ(error_of(kGood, {{"body.arm.mass", "2"}}),
            "--set body.arm.mass=2: body.arm.mass: found \"2\" without a unit, expected a mass such as \"1.5 kg\"");
  EXPECT_EQ(error_of(kGood, {{"body.arn.mass", "2 kg"}}),
            "--set body.arn.mass=2 kg: body.arn.mass: found a path that names nothing, expected the path of a value; "
            "did you mean "
            "body.arm.mass?");
  EXPECT_EQ(error_of(kGood, {{"clearance.R.contact.young.sleeve", "0 Pa"}}),
            "--set clearance.R.contact.young.sleeve=0 Pa: clearance.R.contact.young: found \"0 Pa\", expected elastic "
            "moduli above zero");
  EXPECT_EQ(error_of(kGood, {{"gravity.z", "1 m"}}),
            "--set gravity.z=1 m: gravity.z: found \"1 m\", expected an acceleration such as \"-9.81 m/s^2\"");
}

TEST(ErrorLine, CarriesItsPartsApart) {
  try {
    read_mechanism_text(with("radial =", "radal ="), "f.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.origin.file, "f.toml");
    EXPECT_EQ(error.origin.line, 40);
    EXPECT_EQ(error.key, "clearance[1].radal");
    EXPECT_EQ(error.nearest, "radial");
  }
}

TEST(EditDistance, CountsASwapAsOne) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("radial", "radail"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

}  // namespace error_line_test
}  // namespace boresight
