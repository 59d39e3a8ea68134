// Every command that the READMEs, the examples and .ci/start tell a user to give runs here, shortened where it is long, and does what the text
// around it says. A command or an example file that is new and not run here makes a test fail.
#include "documented_commands.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <set>

#include "command_table.hpp"
#include "documented_summary.hpp"

namespace boresight::app {

void PrintTo(const TableCommand& c, std::ostream* out) { *out << c.text; }

namespace documented_commands_test {

class DocumentedCommands : public Program, public testing::WithParamInterface<TableCommand> {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::filesystem::copy(BORESIGHT_EXAMPLES, folder_ / "examples", std::filesystem::copy_options::recursive);
  }
  void edit(const Edit& e) const {
    std::string content = text("examples/" + e.file);
    const std::size_t at = content.find(e.what);
    ASSERT_NE(at, std::string::npos) << e.file << " has no " << e.what;
    std::ofstream(folder_ / "examples" / e.file) << content.replace(at, e.what.size(), e.with);
  }
  static std::vector<std::string> arguments(const std::string& command, const std::vector<std::string>& more) {
    std::vector<std::string> words = shell_words(command);
    words.erase(words.begin());
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  // As the program names it: results/FILE-VERB, or results/FILE where that says the verb already.
  std::string folder_of_results() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "results"))
      return "results/" + entry.path().filename().string();
    return "";
  }
};

TEST_P(DocumentedCommands, RunAndDoWhatTheTextSays) {
  const TableCommand& c = GetParam();
  SCOPED_TRACE(c.text);
  for (const Edit& e : c.edits) edit(e);
  for (const std::string& command : c.before) {
    const Ended ended = call(arguments(command, {}));
    ASSERT_EQ(ended.status, 0) << command << "\n" << ended.err;
  }
  Left left;
  left.ended = call(arguments(c.text, c.shorter));
  ASSERT_EQ(left.ended.status, c.status) << left.ended.out << left.ended.err;
  EXPECT_EQ(left.ended.out.find("nan"), std::string::npos) << left.ended.out;
  const std::string folder = std::filesystem::exists(folder_ / "results") ? folder_of_results() : "";
  if (!folder.empty()) {
    left.summary = json(folder + "/summary.json");
    EXPECT_THAT(unexplained_keys(left.summary), testing::IsEmpty());
  }
  if (!c.claims) return;
  left.file = [&](const std::string& name) { return text(folder + "/" + name); };
  left.again = [&](const std::vector<std::string>& options) {
    std::vector<std::string> more = c.shorter;
    more.insert(more.end(), options.begin(), options.end());
    more.insert(more.end(), {"--out", "again"});
    const Ended ended = call(arguments(c.text, more));
    EXPECT_EQ(ended.status, c.status) << ended.err;
    return json("again/summary.json");
  };
  c.claims(left);
}

std::string name_of(const testing::TestParamInfo<TableCommand>& one) {
  std::string name = std::to_string(one.index);
  for (const std::string& word : shell_words(one.param.text)) {
    if (word == "boresight") continue;
    std::string last = word.substr(word.find_last_of('/') + 1);
    last = last.substr(0, last.find(".toml"));
    std::replace_if(
        last.begin(), last.end(), [](char ch) { return !std::isalnum(static_cast<unsigned char>(ch)); }, '_');
    name += "_" + last;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Each, DocumentedCommands, testing::ValuesIn(commands()), name_of);

TEST(Documents, TellNoCommandThatIsNotRunHere) {
  std::set<std::string> run, told;
  for (const TableCommand& c : commands()) EXPECT_TRUE(run.insert(c.text).second) << "twice: " << c.text;
  for (const DocumentedCommand& c : documented_commands()) {
    told.insert(c.text);
    EXPECT_TRUE(run.contains(c.text)) << c.document << " tells to give " << c.text;
  }
  for (const std::string& text : run) EXPECT_TRUE(told.contains(text)) << "no document tells any more: " << text;
}

TEST(Documents, ExplainNoKeyOfASummaryThatNothingWrites) { EXPECT_THAT(keys_without_a_source(), testing::IsEmpty()); }

TEST(Documents, OtherCommandsOfTheReadmeAreKnownAndHeldElsewhere) {
  EXPECT_THAT(other_documented_commands(),
              testing::UnorderedElementsAre("bash .ci/start",   // its commands are among the above
                                            "bash .ci/test"));  // is what runs this
}

// Each link to a file of the repository, of every page that a reader may come to.
TEST(Documents, LinkToFilesThatAreThere) {
  const std::filesystem::path source = BORESIGHT_SOURCE;
  std::vector<std::filesystem::path> pages;
  for (const char* part : {"lib", "apps", "examples", "tests"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / part))
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
  pages.push_back(source / "README.md");
  int links = 0;
  for (const auto& page : pages) {
    std::ifstream in(page);
    const std::string words{std::istreambuf_iterator<char>(in), {}};
    const std::regex link(R"(\]\(([^)#:\s]+)\))");
    for (std::sregex_iterator at(words.begin(), words.end(), link), end; at != end; ++at, ++links)
      EXPECT_TRUE(std::filesystem::exists(page.parent_path() / (*at)[1].str())) << page << " links to " << (*at)[1];
  }
  EXPECT_GT(links, 40);
}

// lib/README.md says in which file an equation is.
TEST(Documents, NameFilesOfTheLibraryThatAreThere) {
  const std::filesystem::path library = std::filesystem::path(BORESIGHT_SOURCE) / "lib";
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(library))
    names.insert(entry.path().filename());
  std::ifstream in(library / "README.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::regex file(R"(`(?:([a-z_/]+)/)?([a-z_]+\.[ch]pp)`)");
  int found = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), file), end; at != end; ++at, ++found) {
    const std::string folder = (*at)[1], name = (*at)[2];
    const bool there = folder.empty() ? names.contains(name)
                       : folder.starts_with("analyses/")
                           ? std::filesystem::exists(library.parent_path() / folder / name)
                           : std::filesystem::exists(library / "boresight" / folder / name);
    EXPECT_TRUE(there) << "lib/README.md names " << at->str();
  }
  EXPECT_GT(found, 30);
}

// As they stand: what holds for a shortened one need not hold for the whole.
TEST_F(Program, LongTheFirstCommandsExamplesRunUnshortened) {
  std::filesystem::copy(BORESIGHT_EXAMPLES, folder_ / "examples", std::filesystem::copy_options::recursive);
  int run = 0;
  for (const DocumentedCommand& c : documented_commands()) {
    if (c.document != ".ci/start") continue;
    std::vector<std::string> words = shell_words(c.text);
    words.erase(words.begin());
    const Ended ended = call(words);
    EXPECT_EQ(ended.status, 0) << c.text << "\n" << ended.out << ended.err;
    ++run;
  }
  EXPECT_EQ(run, 4);
  for (const char* folder : {"3-rrcpr-run", "clearance-sweep", "load-sweep", "montecarlo"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "results" / folder / "report.html")) << folder;
}

TEST(Examples, EveryFileIsRunByADocumentedCommand) {
  std::string all;
  for (const TableCommand& c : commands()) all += c.text + "\n";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(BORESIGHT_EXAMPLES)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().filename();
    if (all.find("/" + name) != std::string::npos) continue;
    // Or it is the mechanism of a study that is.
    bool taken = false;
    for (const auto& other : std::filesystem::directory_iterator(entry.path().parent_path())) {
      if (other.path().extension() != ".toml" || all.find("/" + other.path().filename().string()) == std::string::npos)
        continue;
      std::ifstream in(other.path());
      const std::string study{std::istreambuf_iterator<char>(in), {}};
      taken = taken || study.find("mechanism = \"" + name + "\"") != std::string::npos;
    }
    EXPECT_TRUE(taken) << entry.path() << " is run by no documented command";
  }
}

}  // namespace documented_commands_test
}  // namespace boresight::app
