#include "results/output_directory.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

namespace boresight::app {
namespace output_directory_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class OutputDirectoryTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "boresight-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    root_ = name;
  }
  void TearDown() override { fs::remove_all(root_); }

  static void finish(const OutputDirectory& out) {
    out.write("summary.json", [&](std::ostream& s) { s << Json({{"identity", out.identity()}}); });
    out.publish();
  }
  static void put(const OutputDirectory& out, const std::string& name, const std::string& text) {
    out.write(name, [&](std::ostream& s) { s << text; });
  }
  std::vector<std::string> names_in(const fs::path& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::string text_of(const fs::path& file) const {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path root_;
  const Json mine_ = {{"verb", "run"}, {"mechanism", "abc"}}, other_ = {{"verb", "run"}, {"mechanism", "def"}};
};

TEST_F(OutputDirectoryTest, TheSameStudyMayBeRunAgain) {
  finish(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_));
  EXPECT_NO_THROW(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_));
}

TEST_F(OutputDirectoryTest, AnotherStudysResultsAreRefused) {
  finish(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_));
  try {
    OutputDirectory::open(root_ / "out", "run", "m.toml", other_);
    FAIL();
  } catch (const OutputDirectoryError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("another study"));
  }
}

TEST_F(OutputDirectoryTest, ResultsOfUnknownOwnersAreRefused) {
  fs::create_directory(root_ / "out");
  std::ofstream(root_ / "out" / "report.html") << "x";
  EXPECT_THROW(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_), OutputDirectoryError);
  std::ofstream(root_ / "out" / "summary.json") << "{ broken";
  EXPECT_THROW(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_), OutputDirectoryError);
}

TEST_F(OutputDirectoryTest, ADirectoryWithOtherThingsIsFine) {
  fs::create_directory(root_ / "out");
  std::ofstream(root_ / "out" / "notes.txt") << "x";
  EXPECT_NO_THROW(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_));
}

TEST_F(OutputDirectoryTest, AFileInTheWayIsNamed) {
  std::ofstream(root_ / "out") << "x";
  try {
    OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
    FAIL();
  } catch (const OutputDirectoryError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("found a file, expected a directory"));
  }
}

TEST_F(OutputDirectoryTest, TheDefaultGivesWayToAnotherStudy) {
  const fs::path before = fs::current_path();
  fs::current_path(root_);
  const auto open_run = [&](const Json& identity) {
    const OutputDirectory out = OutputDirectory::open("", "run", "some/m.toml", identity);
    finish(out);
    return out.path();
  };
  EXPECT_EQ(open_run(mine_), fs::path("results/m-run"));
  EXPECT_EQ(open_run(other_), fs::path("results/m-run-2"));
  EXPECT_EQ(open_run(other_), fs::path("results/m-run-2"));
  EXPECT_EQ(OutputDirectory::open("", "sweep", "clearance-sweep.toml", mine_).path(),
            fs::path("results/clearance-sweep"));
  fs::current_path(before);
}

TEST_F(OutputDirectoryTest, TheDefaultGivesWayToOneThatIsBeingWritten) {
  const fs::path before = fs::current_path();
  fs::current_path(root_);
  const OutputDirectory first = OutputDirectory::open("", "run", "m.toml", mine_),
                        second = OutputDirectory::open("", "run", "m.toml", other_),
                        third = OutputDirectory::open("", "run", "m.toml", mine_);
  EXPECT_EQ(first.path(), fs::path("results/m-run"));
  EXPECT_EQ(second.path(), fs::path("results/m-run-2"));
  EXPECT_EQ(third.path(), fs::path("results/m-run-3"));
  fs::current_path(before);
}

TEST_F(OutputDirectoryTest, WhileOneWritesNoOtherMay) {
  {
    const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
    try {
      OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
      FAIL();
    } catch (const OutputDirectoryError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("another run is writing there"));
    }
  }
  EXPECT_NO_THROW(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_));
}

TEST_F(OutputDirectoryTest, ResultsAppearTogether) {
  const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
  put(out, "summary.json", Json({{"identity", mine_}, {"files", {"summary.json", "a.csv", "b.csv"}}}).dump());
  put(out, "a.csv", "first a");
  put(out, "b.csv", "first b");
  EXPECT_FALSE(fs::exists(root_ / "out" / "summary.json"));
  EXPECT_FALSE(fs::exists(root_ / "out" / "a.csv"));
  out.publish();
  EXPECT_THAT(names_in(root_ / "out"), testing::ElementsAre("a.csv", "b.csv", "summary.json"));

  // What the new result does not have goes with the old one; what is not of a result stays.
  std::ofstream(root_ / "out" / "notes.txt") << "x";
  put(out, "summary.json", Json({{"identity", mine_}, {"files", {"summary.json", "a.csv"}}}).dump());
  put(out, "a.csv", "second");
  EXPECT_EQ(text_of(root_ / "out" / "a.csv"), "first a");
  out.publish();
  EXPECT_EQ(text_of(root_ / "out" / "a.csv"), "second");
  EXPECT_THAT(names_in(root_ / "out"), testing::ElementsAre("a.csv", "notes.txt", "summary.json"));
}

TEST_F(OutputDirectoryTest, AKillBeforeAllIsWrittenLeavesTheOldResults) {
  finish(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_));
  fs::create_directory(root_ / "out" / ".being-written");
  std::ofstream(root_ / "out" / ".being-written" / "a.csv") << "half of";
  { const OutputDirectory again = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_); }
  EXPECT_THAT(names_in(root_ / "out"), testing::ElementsAre("summary.json"));
}

TEST_F(OutputDirectoryTest, AKillAmidTheMovesIsCompletedByTheNextThatOpens) {
  // As publish() leaves it after the first of its moves: the old summary is gone, one file is in its place.
  fs::create_directories(root_ / "out" / ".written");
  std::ofstream(root_ / "out" / "a.csv") << "new";
  std::ofstream(root_ / "out" / ".written" / "b.csv") << "new";
  std::ofstream(root_ / "out" / ".written" / "summary.json") << Json({{"identity", mine_}});
  EXPECT_THROW(OutputDirectory::open(root_ / "out", "run", "m.toml", other_), OutputDirectoryError)
      << "it is another study's";
  EXPECT_THAT(names_in(root_ / "out"), testing::ElementsAre("a.csv", "b.csv", "summary.json"));
  EXPECT_NO_THROW(OutputDirectory::open(root_ / "out", "run", "m.toml", mine_));
}

TEST_F(OutputDirectoryTest, AFolderIntoWhichNothingCameGoesAway) {
  {
    const OutputDirectory out = OutputDirectory::open(root_ / "results" / "out", "run", "m.toml", mine_);
    put(out, "a.csv", "never published");
  }
  EXPECT_FALSE(fs::exists(root_ / "results"));
  fs::create_directory(root_ / "there");
  { const OutputDirectory out = OutputDirectory::open(root_ / "there", "run", "m.toml", mine_); }
  EXPECT_TRUE(fs::exists(root_ / "there")) << "it was there before";
}

TEST_F(OutputDirectoryTest, AWriteReplacesTheFileWholly) {
  const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
  put(out, "summary.json", Json({{"identity", mine_}}).dump());
  put(out, "a.csv", "a long first version");
  put(out, "a.csv", "short");
  out.publish();
  EXPECT_EQ(text_of(root_ / "out" / "a.csv"), "short");
}

TEST_F(OutputDirectoryTest, ContentThatFailsLeavesTheOldFileAndNoLitter) {
  {
    const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
    put(out, "a.csv", "old");
    finish(out);
    EXPECT_THROW(out.write("a.csv", [](std::ostream&) { throw std::runtime_error("no"); }), std::runtime_error);
  }
  EXPECT_EQ(text_of(root_ / "out" / "a.csv"), "old");
  EXPECT_THAT(names_in(root_ / "out"), testing::ElementsAre("a.csv", "summary.json"));
}

TEST_F(OutputDirectoryTest, ADirectoryThatWentAwayIsAWriteError) {
  const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
  fs::remove_all(root_ / "out");
  try {
    out.write("a.csv", [](std::ostream& s) { s << "x"; });
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("a.csv"), testing::HasSubstr("No such file")));
  }
}

}  // namespace output_directory_test
}  // namespace boresight::app
