#include "output_directory.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace boresight::app {
namespace {

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
  }
  std::string text_of(const fs::path& file) const {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path root_;
  const Json mine_ = {{"verb", "run"}, {"mechanism", "abc"}},
             other_ = {{"verb", "run"}, {"mechanism", "def"}};
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
  const OutputDirectory first = OutputDirectory::open("", "run", "some/m.toml", mine_);
  finish(first);
  EXPECT_EQ(first.path(), fs::path("results/m-run"));
  const OutputDirectory second = OutputDirectory::open("", "run", "some/m.toml", other_);
  finish(second);
  EXPECT_EQ(second.path(), fs::path("results/m-run-2"));
  EXPECT_EQ(OutputDirectory::open("", "run", "some/m.toml", other_).path(), second.path());
  EXPECT_EQ(OutputDirectory::open("", "sweep", "clearance-sweep.toml", mine_).path(),
            fs::path("results/clearance-sweep"));
  fs::current_path(before);
}

TEST_F(OutputDirectoryTest, AWriteReplacesTheFileWholly) {
  const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
  out.write("a.csv", [](std::ostream& s) { s << "a long first version"; });
  out.write("a.csv", [](std::ostream& s) { s << "short"; });
  EXPECT_EQ(text_of(root_ / "out" / "a.csv"), "short");
}

TEST_F(OutputDirectoryTest, ContentThatFailsLeavesTheOldFileAndNoLitter) {
  const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
  out.write("a.csv", [](std::ostream& s) { s << "old"; });
  EXPECT_THROW(out.write("a.csv", [](std::ostream&) { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_EQ(text_of(root_ / "out" / "a.csv"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(root_ / "out"), fs::directory_iterator()), 1);
}

TEST_F(OutputDirectoryTest, ADirectoryThatWentAwayIsAWriteError) {
  const OutputDirectory out = OutputDirectory::open(root_ / "out", "run", "m.toml", mine_);
  fs::remove_all(root_ / "out");
  try {
    out.write("a.csv", [](std::ostream& s) { s << "x"; });
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("a.csv"), testing::HasSubstr("No such file")));
  }
}

}  // namespace
}  // namespace boresight::app
