#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "program.hpp"

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using WriteErrorTest = Program;

TEST_F(WriteErrorTest, AFileThatMayNotGrowIsOneLineAndLeavesNothingOfTheResult) {
  const Ended ended = call({"run", mechanism_, "--set", "motion.duration=50ms", "--out", "out"}, 20'000);
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("timeseries.csv"), HasSubstr("File too large")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(WriteErrorTest, AFullDiskIsOneLineAndLeavesTheResultBefore) {
  // A small file system in a name space of the test's own; where that is not allowed, there is nothing to test with.
  std::filesystem::create_directory(folder_ / "disk");
  const std::string in_name_space =
      "cd '" + folder_.string() + "' && unshare -rm sh -c 'mount -t tmpfs -o size=4m tmpfs disk && ";
  if (std::system((in_name_space + "true' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "cannot mount a small file system here";
  const std::string run =
      std::string(BORESIGHT_PROGRAM) + " run " + mechanism_ + " --set motion.duration=50ms --sample \"10 ms\" --out disk/out >out 2>err; ";
  const std::string command = in_name_space + run + "cp -r disk/out before; cat /dev/zero >disk/filler 2>/dev/null; " + run +
                              "echo $? >status; cp -r disk/out after'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(text("status"), "3\n");
  EXPECT_TRUE(is_one_line(text("err"))) << text("err");
  EXPECT_THAT(text("err"), HasSubstr("No space left on device"));
  EXPECT_THAT(files("after"), ElementsAre("events.csv", "report.html", "summary.json", "timeseries.csv"));
  for (const std::string& name : files("after")) EXPECT_EQ(text("after/" + name), text("before/" + name)) << name;
}

TEST_F(WriteErrorTest, ADirectoryThatCannotBeMadeIsBadInput) {
  const Ended ended = call({"run", mechanism_, "--out", "/proc/boresight"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("/proc/boresight"));
}

TEST_F(WriteErrorTest, AFileInTheWayIsBadInput) {
  std::ofstream(folder_ / "out") << "x";
  const Ended ended = call({"run", mechanism_, "--out", "out"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("found a file, expected a directory"));
}

TEST_F(WriteErrorTest, ATerminalThatWentAwayIsAFailure) {
  const int status = std::system((std::string(BORESIGHT_PROGRAM) + " run " + mechanism_ +
                                  " --set motion.duration=20ms --out '" + (folder_ / "out").string() +
                                  "' >/dev/full 2>'" + (folder_ / "err").string() + "'")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(text("err"), HasSubstr("standard output"));
}

}  // namespace
}  // namespace boresight::app
