// What the program says of keys, paths and schemas.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "program.hpp"

namespace boresight::app {
namespace reference_program_test {

using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using ReferenceProgram = Program;

TEST_F(ReferenceProgram, HelpSaysWhatAKeyIs) {
  const Ended ended = call({"help", "restitution"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out,
              AllOf(HasSubstr("[clearance.contact]"), HasSubstr("Range: 0 to 1."), HasSubstr("Unless given: 0.9.")));
  EXPECT_THAT(call({"help", "stribeck_speed"}).out, HasSubstr("10 mm/s"));
}

TEST_F(ReferenceProgram, HelpListsTheKeysOfATable) {
  EXPECT_THAT(call({"help", "clearance.friction"}).out,
              AllOf(HasSubstr("bristle_stiffness"), HasSubstr("viscosity"), HasSubstr("lugre")));
}

TEST_F(ReferenceProgram, HelpOfAVerbIsItsOptionsAndItsKeys) {
  const Ended ended = call({"help", "montecarlo"});
  EXPECT_THAT(ended.out, AllOf(HasSubstr("Usage: boresight montecarlo"), HasSubstr("--resume"), HasSubstr("strata")));
  EXPECT_THAT(ended.out, HasSubstr(call({"montecarlo", "--help"}).out));
}

TEST_F(ReferenceProgram, HelpOfAnUnknownWordOffersTheNearest) {
  const Ended ended = call({"help", "restituton"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("did you mean restitution?"));
  EXPECT_THAT(call({"help", "montecarl"}).err, HasSubstr("did you mean montecarlo?"));
}

TEST_F(ReferenceProgram, HelpAloneIsAnOverview) {
  const Ended ended = call({"help"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("sensitivity"), HasSubstr("expressions")));
}

TEST_F(ReferenceProgram, SchemasAreJsonAndOtherKindsAreRefused) {
  for (const char* kind : {"mechanism", "study"})
    EXPECT_EQ(nlohmann::json::parse(call({"schema", kind}).out)["type"], "object") << kind;
  const Ended refused = call({"schema", "studies"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("did you mean study?"));
}

TEST_F(ReferenceProgram, PathsAreThoseThatSettingsTake) {
  const nlohmann::json paths = nlohmann::json::parse(call({"paths", mechanism_, "--json"}).out);
  bool radial = false;
  for (const nlohmann::json& number : paths["numbers"])
    if (number["path"] == "clearance.F1.radial") {
      radial = true;
      EXPECT_EQ(number["value"], 1e-4);
      EXPECT_EQ(number["unit"], "m");
    }
  EXPECT_TRUE(radial);
  EXPECT_THAT(paths["others"].dump(), AllOf(HasSubstr("\"motion.duration\""), HasSubstr("\"clearance.F1.axes\"")));
  EXPECT_THAT(call({"paths", mechanism_}).out, AllOf(HasSubstr("clearance.F1.radial"), Not(HasSubstr("bristle"))));
  const Ended sticky = call({"paths", mechanism_, "--set", "clearance.F1.friction.law=lugre"});
  EXPECT_EQ(sticky.status, 0) << sticky.err;
  EXPECT_THAT(sticky.out, HasSubstr("clearance.F1.friction.coefficient"));
}

// The longest path is of a joint whose name takes twice as many bytes as letters.
TEST_F(ReferenceProgram, PathsStandInColumnsWhateverLettersTheyHave) {
  std::ifstream in(BORESIGHT_EXAMPLES "/four-bar/four-bar.toml");
  std::string text((std::istreambuf_iterator<char>(in)), {}), name;
  for (int k = 0; k < 30; ++k) name += "Ä";
  for (std::size_t at = text.find("\"D\""); at != std::string::npos; at = text.find("\"D\"", at))
    text.replace(at, 3, '"' + name + '"');
  write("named.toml", text);
  const Ended ended = call({"paths", "named.toml"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  std::istringstream lines(ended.out);
  std::size_t column = 0, fewest_blanks = 1000;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ")) continue;
    const std::size_t end = line.find(' ', 2), value = line.find_first_not_of(' ', end);
    ASSERT_NE(value, std::string::npos) << line;
    fewest_blanks = std::min(fewest_blanks, value - end);
    const auto letters = static_cast<std::size_t>(std::count_if(
        line.begin(), line.begin() + static_cast<std::ptrdiff_t>(value), [](char c) { return (c & 0xc0) != 0x80; }));
    if (column == 0) column = letters;
    EXPECT_EQ(letters, column) << line;
  }
  EXPECT_GT(column, 40u);
  EXPECT_EQ(fewest_blanks, 2u) << "no wider than the longest asks for";
}

TEST_F(ReferenceProgram, EveryNumberListedMayBeSetToItsOwnValue) {
  const nlohmann::json paths = nlohmann::json::parse(call({"paths", mechanism_, "--json"}).out);
  std::vector<std::string> arguments = {"paths", mechanism_};
  for (const nlohmann::json& number : paths["numbers"]) {
    const std::string unit = number["unit"].get<std::string>();
    arguments.push_back("--set");
    arguments.push_back(number["path"].get<std::string>() + "=" + number["value"].dump() +
                        (unit == "1" ? "" : " " + unit));
  }
  const Ended ended = call(arguments);
  EXPECT_EQ(ended.status, 0) << ended.err;
  arguments.push_back("--json");
  const nlohmann::json set = nlohmann::json::parse(call(arguments).out);
  ASSERT_EQ(set["numbers"].size(), paths["numbers"].size());
  for (std::size_t k = 0; k < set["numbers"].size(); ++k)
    for (const char* key : {"path", "value", "unit"}) EXPECT_EQ(set["numbers"][k][key], paths["numbers"][k][key]);
}

TEST_F(ReferenceProgram, PathsShowWhatWasTyped) {
  const std::string out = call({"paths", mechanism_, "--set", "clearance.F1.contact.young=72 GPa"}).out;
  EXPECT_THAT(out, AllOf(ContainsRegex("clearance.F1.radial +0.1 mm\n"), ContainsRegex("contact.young +72 GPa\n")));
  EXPECT_THAT(out, ContainsRegex("body.rod3.mass +1.5 kg\n"));
}

TEST_F(ReferenceProgram, PathsShowEachNumberWhereThoseOfOnePathDiffer) {
  const std::string four_bar = std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml";
  EXPECT_THAT(call({"paths", four_bar}).out, ContainsRegex("contact.young +2.07e\\+11 and 7.2e\\+10 Pa\n"));
  const nlohmann::json paths = nlohmann::json::parse(call({"paths", four_bar, "--json"}).out);
  bool found = false;
  for (const nlohmann::json& number : paths["numbers"])
    if (number["path"] == "clearance.D.contact.young") {
      found = true;
      EXPECT_EQ(number["value"], nlohmann::json({207e9, 72e9}));
    }
  EXPECT_TRUE(found);
}

TEST_F(ReferenceProgram, TheManualPageHasEveryVerbAndTopic) {
  const Ended ended = call({"help", "--man"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, StartsWith(".TH BORESIGHT 1"));
  for (const char* verb : {"new", "check", "run", "montecarlo", "budget", "paths"})
    EXPECT_THAT(ended.out, HasSubstr(std::string(".SS boresight ") + verb + "\n"));
  EXPECT_THAT(ended.out, AllOf(HasSubstr(".SH VALUES AND THEIR UNITS"), HasSubstr("\\-\\-accuracy")));
  std::istringstream lines(ended.out);
  const std::vector<std::string> requests = {".TH", ".SH", ".SS", ".B",  ".I",  ".RI",
                                             ".br", ".nf", ".fi", ".PP", ".RS", ".RE"};
  for (std::string line; std::getline(lines, line);) {  // no text that roff takes for a request
    if (!line.starts_with('.')) continue;
    EXPECT_THAT(requests, Contains(line.substr(0, line.find(' ')))) << line;
  }
  EXPECT_EQ(call({"help", "--man", "--page"}).status, 2);
}

TEST_F(ReferenceProgram, ThePageIsOneFileThatWorksOffline) {
  const Ended ended = call({"help", "--page"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("</html>"), HasSubstr("bristle_damping"), HasSubstr("boresight calibrate")));
  EXPECT_THAT(ended.out, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("<link")), Not(HasSubstr("src="))));
}

}  // namespace reference_program_test
}  // namespace boresight::app
