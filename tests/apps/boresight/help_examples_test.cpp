// The examples of `boresight VERB --help` run as they stand, in any folder where `boresight new antenna` was called, and --json is JSON
// or refused.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "documented_commands.hpp"
#include "program.hpp"

namespace boresight::app {
namespace help_examples_test {

using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kVerbs = {"new",        "check",       "run",    "sweep",    "chart",     "stability",
                                         "montecarlo", "sensitivity", "match",  "allocate", "calibrate", "budget",
                                         "report",     "export",      "laws",   "serve",    "paths",     "help",
                                         "schema",     "import",      "convert"};

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
  std::vector<std::string> folders_of_results() const {
    std::vector<std::string> folders;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
      if (entry.path().filename() == "summary.json")
        folders.push_back(std::filesystem::relative(entry.path().parent_path(), folder_).string());
    return folders;
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
    if (call({words.front(), "--help"}).out.find("--json") == std::string::npos) {
      EXPECT_EQ(json.status, 2);
      EXPECT_THAT(json.err, HasSubstr("--json is not an option of " + words.front()));
    } else {
      EXPECT_TRUE(nlohmann::json::accept(json.out)) << words.front() << ": " << json.out << json.err;
    }
  }
  // The report of what was computed can be made again from its folder, and is the same.
  for (const std::string& folder : folders_of_results()) {
    const std::string report = text(folder + "/report.html");
    std::filesystem::remove(folder_ / folder / "report.html");
    const Ended again = call({"report", folder});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_FALSE(report.empty()) << folder;
    EXPECT_TRUE(text(folder + "/report.html") == report) << folder;
  }
  // What computes says what to do next, in one line.
  const bool computes = help.find("--out DIR") != std::string::npos && GetParam() != "export";
  EXPECT_EQ(std::regex_search(ended.out, std::regex("\n  next: [^\n]+\n$")), computes) << ended.out;
}

INSTANTIATE_TEST_SUITE_P(Each, HelpExamples, testing::ValuesIn(kVerbs), [](const auto& one) { return one.param; });

TEST_F(Program, ReportRefusesInOneLineWhatIsNoWholeResult) {
  std::filesystem::create_directories(folder_ / "empty");
  const auto refused = [&](const std::string& folder, const std::string& why) {
    const Ended ended = call({"report", folder});
    EXPECT_EQ(ended.status, 2);
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr(why));
  };
  refused("nowhere", "which is no folder");
  refused("empty", "no summary.json");
  ASSERT_EQ(call({"check", mechanism_, "--out", "checked"}).status, 0);
  std::ofstream(folder_ / "checked" / "report.json") << "{\"title\": ";
  refused("checked", "report.json is damaged");
  std::ofstream(folder_ / "checked" / "report.json") << "{\"title\": \"T\", \"sections\": 3}";
  refused("checked", "report.json is damaged");
  std::filesystem::remove(folder_ / "checked" / "report.json");
  refused("checked", "no report.json");
}

TEST_F(Program, TheVerbsWhoseExamplesRunAreAllThatHelpLists) {
  std::set<std::string> listed;
  std::istringstream help(call({"--help"}).out);
  for (std::string line; std::getline(help, line);)
    if (std::smatch match; std::regex_match(line, match, std::regex("  ([a-z]+) {2,}[A-Za-z].*")))
      listed.insert(match[1]);
  listed.erase("completion");  // held by FrontDoor
  EXPECT_EQ(listed, std::set<std::string>(kVerbs.begin(), kVerbs.end()));
}

}  // namespace help_examples_test
}  // namespace boresight::app
