// The examples of `boresight VERB --help` run as they stand, in any folder where `boresight new antenna` was called, and --json is JSON
// or refused.
#include <gmock/gmock.h>

#include <regex>
#include <set>
#include <sstream>

#include "documented_commands.hpp"
#include "program.hpp"

namespace boresight::app {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kVerbs = {"new",        "check",       "run",   "sweep",    "chart",     "stability",
                                         "montecarlo", "sensitivity", "match", "allocate", "calibrate", "budget",
                                         "export",     "laws",        "paths", "help",     "schema"};

class HelpExamples : public Program, public testing::WithParamInterface<std::string> {
 protected:
  // Words of each line after "Example", `boresight` left out.
  std::vector<std::vector<std::string>> examples_of(const std::string& verb) const {
    std::istringstream help(call({verb, "--help"}).out);
    std::vector<std::vector<std::string>> commands;
    bool begun = false;
    for (std::string line; std::getline(help, line);) {
      if (begun && line.starts_with("  boresight ")) {
        commands.push_back(shell_words(line.substr(2)));
        commands.back().erase(commands.back().begin());
      }
      begun = begun || line.starts_with("Example");
    }
    return commands;
  }
};

TEST_P(HelpExamples, RunFromAnywhere) {
  if (GetParam() != "new") {
    ASSERT_EQ(call({"new", "antenna"}).status, 0);
  }
  const auto commands = examples_of(GetParam());
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands.back().front(), GetParam());
  Ended ended;
  for (const auto& words : commands) {
    ended = call(words);
    EXPECT_LE(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, Not(HasSubstr("boresight:")));
  }
  const std::string help = call({GetParam(), "--help"}).out;
  for (std::vector<std::string> words : commands) {
    words.push_back("--json");
    const Ended json = call(words);
    if (help.find("--json") == std::string::npos && words.front() == GetParam()) {
      EXPECT_EQ(json.status, 2);
      EXPECT_THAT(json.err, HasSubstr("--json is not an option of " + GetParam()));
    } else {
      EXPECT_TRUE(nlohmann::json::accept(json.out)) << words.front() << ": " << json.out << json.err;
    }
  }
  // What computes says what to do next, in one line.
  const bool computes = help.find("--out DIR") != std::string::npos && GetParam() != "export";
  EXPECT_EQ(std::regex_search(ended.out, std::regex("\n  next: [^\n]+\n$")), computes) << ended.out;
}

INSTANTIATE_TEST_SUITE_P(Each, HelpExamples, testing::ValuesIn(kVerbs), [](const auto& one) { return one.param; });

TEST_F(Program, TheVerbsWhoseExamplesRunAreAllThatHelpLists) {
  std::set<std::string> listed;
  std::istringstream help(call({"--help"}).out);
  for (std::string line; std::getline(help, line);)
    if (std::smatch match; std::regex_match(line, match, std::regex("  ([a-z]+) {2,}[A-Za-z].*")))
      listed.insert(match[1]);
  listed.erase("completion");  // held by FrontDoor
  EXPECT_EQ(listed, std::set<std::string>(kVerbs.begin(), kVerbs.end()));
}

}  // namespace
}  // namespace boresight::app
