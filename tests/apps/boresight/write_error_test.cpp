#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "program.hpp"

namespace boresight::app {
namespace write_error_test {

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
  const std::vector<std::string> run = {"run",      mechanism_, "--set", "motion.duration=50ms",
                                        "--sample", "10 ms",    "--out", "disk/out"};
  ASSERT_EQ(call(run).status, 0);
  std::filesystem::copy(folder_ / "disk/out", folder_ / "before");
  ASSERT_THAT(files("before"),
              ElementsAre("events.csv", "report.html", "report.json", "summary.json", "timeseries.csv"));
  std::uintmax_t result = 0;
  for (const std::string& name : files("before")) result += std::filesystem::file_size(folder_ / "before" / name);
  for (const std::uintmax_t room :
       {std::uintmax_t{0}, std::uintmax_t{1}, std::uintmax_t{5000}, result / 2, result - 1000}) {
    SCOPED_TRACE("room for " + std::to_string(room) + " bytes");
    const Ended ended = call(run, PlayedDisk{"disk", room});
    EXPECT_EQ(ended.status, 3);
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("No space left on device"));
    EXPECT_THAT(files("disk"), ElementsAre("out")) << "litter";
    EXPECT_EQ(files("disk/out"), files("before"));
    for (const std::string& name : files("before")) EXPECT_EQ(text("disk/out/" + name), text("before/" + name)) << name;
  }
  EXPECT_EQ(call(run, PlayedDisk{"disk", result + 100'000}).status, 0) << "a disk with room is none that is full";
}

// As above on a file system of the kernel's own, where the machine lets a test mount one.
TEST_F(WriteErrorTest, AFullFileSystemIsOneLineAndLeavesTheResultBefore) {
  std::filesystem::create_directory(folder_ / "disk");
  std::string in_name_space;
  for (const char* privilege : {"-m", "-rm"}) {
    const std::string tried =
        "cd '" + folder_.string() + "' && unshare " + privilege + " sh -c 'mount -t tmpfs -o size=4m tmpfs disk && ";
    if (std::system((tried + "true' 2>/dev/null").c_str()) == 0) in_name_space = tried;
  }
  if (in_name_space.empty()) {
    std::puts("no file system may be mounted here: the played disk above stands alone");
    return;
  }
  const std::string run = std::string(BORESIGHT_PROGRAM) + " run " + mechanism_ +
                          " --set motion.duration=50ms --sample \"10 ms\" --out disk/out >out 2>err; ";
  const std::string command = in_name_space + run + "cp -r disk/out before; cat /dev/zero >disk/filler 2>/dev/null; " +
                              run + "echo $? >status; cp -r disk/out after'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(text("status"), "3\n");
  EXPECT_TRUE(is_one_line(text("err"))) << text("err");
  EXPECT_THAT(text("err"), HasSubstr("No space left on device"));
  EXPECT_THAT(files("after"),
              ElementsAre("events.csv", "report.html", "report.json", "summary.json", "timeseries.csv"));
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
  const int status =
      std::system((std::string(BORESIGHT_PROGRAM) + " run " + mechanism_ + " --set motion.duration=20ms --out '" +
                   (folder_ / "out").string() + "' >/dev/full 2>'" + (folder_ / "err").string() + "'")
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(text("err"), HasSubstr("standard output"));
}

}  // namespace write_error_test
}  // namespace boresight::app
