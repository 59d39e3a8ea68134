// What a Monte Carlo study keeps: killed, interrupted, resumed, on a disk that is full, damaged or read only.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "boresight_analyses/runs/sample_store.hpp"
#include "montecarlo_program.hpp"

namespace boresight::app {
namespace montecarlo_store_program_test {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(MonteCarloProgram, KilledAndResumedThreeTimesItGivesTheTableOfOneRun) {
  study("long.toml", 25000);
  const std::string whole = csv_of("long.toml", "whole", {"--jobs", "2"});
  int killed = 0;
  for (int k = 0; k < 3; ++k) {
    const std::uintmax_t before = stored_bytes("cut");
    const pid_t child = start(quick("long.toml", "cut", {"--jobs", "2", "--resume"}));
    wait_until_stored("cut", before);
    ::kill(child, SIGKILL);
    killed += wait_for(child).status == 128 + SIGKILL;
  }
  EXPECT_GT(killed, 0);
  EXPECT_EQ(csv_of("long.toml", "cut", {"--resume"}), whole);
}

TEST_F(MonteCarloProgram, AskedToStopItEndsWithWhatThereIsAndGoesOnLater) {
  study("long.toml", 200000);
  const pid_t child = start(quick("long.toml", "out"));
  wait_until_stored("out", 0);
  ::kill(child, SIGINT);
  EXPECT_EQ(wait_for(child).status, 130);
  EXPECT_EQ(json("out/summary.json")["interrupted"], true);
  study("long.toml", 100);
  EXPECT_EQ(samples_of("out").find("nan"), std::string::npos);
  EXPECT_EQ(call(quick("long.toml", "out", {"--resume"})).status, 0) << "fewer samples are part of what there is";
}

TEST_F(MonteCarloProgram, ContinuedWithMoreSamplesItGivesTheTableOfOneRun) {
  study("more.toml", 900);
  csv_of("study.toml", "out");
  EXPECT_EQ(csv_of("more.toml", "out", {"--resume"}), csv_of("more.toml", "once"));
}

TEST_F(MonteCarloProgram, TheSameCommandGoesOnAndAnotherStudyIsLeftAlone) {
  const std::string table = csv_of("study.toml", "out");
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--resume"}}) {
    std::filesystem::remove(folder_ / "out/samples.csv");
    EXPECT_EQ(csv_of("study.toml", "out", more), table);
  }
  study("other.toml", 400, "seed = 2");
  const Ended again = call(quick("other.toml", "out"));
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, AllOf(HasSubstr("another study"), HasSubstr("--out")));
  EXPECT_TRUE(is_one_line(again.err));
  EXPECT_EQ(call({"export", "nothing"}).status, 2);
}

TEST_F(MonteCarloProgram, SamplesOfAnotherVersionAreRefusedInALineAndLeftAsTheyAre) {
  const std::string table = csv_of("study.toml", "out");
  const auto version = [&] { return SampleStore(folder_ / "out/samples.db").fact("version"); };
  const std::string own = version();
  EXPECT_EQ(json("out/summary.json")["version"], own);
  const auto parameters = [&] { return SampleStore(folder_ / "out/samples.db").parameters(); }();
  SampleStore(folder_ / "out/samples.db", {}, parameters).note("version", "0.9.0");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--resume"}, {"--resume", "--from", (folder_ / "out").string()}}) {
    const Ended again = call(quick("study.toml", more.size() > 1 ? "copy" : "out", more));
    EXPECT_EQ(again.status, 2);
    EXPECT_THAT(again.err, HasSubstr("holds results of version 0.9.0, and this is " + own));
    EXPECT_TRUE(is_one_line(again.err)) << again.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "copy/samples.db"));
  EXPECT_EQ(version(), "0.9.0");
  EXPECT_EQ(samples_of("out"), table) << "who only reads it may";
}

TEST_F(MonteCarloProgram, InterruptedWhileItsStepsAreMeasuredItHasItsSamplesAndTheirTable) {
  study("few.toml", 8);
  const std::vector<std::string> arguments = {"montecarlo", "few.toml",     "--set", "motion.duration=15s",
                                              "--rung",     "perturbation", "--out", "out",
                                              "--resume",   "--jobs",       "1"};
  const pid_t child = start(arguments);
  for (int k = 0; k < 60'000 && text("stderr").find("runs that measure what the steps do") == std::string::npos; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  const Ended ended = wait_for(child);
  ASSERT_EQ(ended.status, 130) << ended.err;
  const auto summary = json("out/summary.json");
  EXPECT_TRUE(summary["interrupted"].get<bool>());
  EXPECT_EQ(summary["samples"], 8);
  EXPECT_GT(summary["index"]["mean"]["value"].get<double>(), 0.0);
  EXPECT_THAT(summary["errors"]["mean"]["discretisation"]["why"].get<std::string>(), HasSubstr("interrupted"));
}

TEST_F(MonteCarloProgram, AFullDiskIsOneLineAndLeavesTheStoreIntact) {
  study("long.toml", 20000);
  const Ended ended = wait_for(start(quick("long.toml", "out"), 200'000));
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("samples.db"), HasSubstr("the same command goes on")));
  study("long.toml", 100);
  EXPECT_EQ(csv_of("long.toml", "out", {"--resume"}).substr(0, 2000), csv_of("long.toml", "fresh").substr(0, 2000));
}

TEST_F(MonteCarloProgram, ADamagedStoreGivesTheTableOfOneRunAndSaysWhatWasDamaged) {
  ASSERT_EQ(call(quick("study.toml", "whole")).status, 0);
  ASSERT_EQ(call(quick("study.toml", "out")).status, 0);
  std::string bytes = text("out/samples.db");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder_ / "out/samples.db", std::ios::binary) << bytes;
  const Ended exported = call({"export", "out", "--out", "part"});
  EXPECT_EQ(exported.status, 3);
  EXPECT_THAT(exported.err, HasSubstr("samples.db is damaged"));
  const Ended resumed = call(quick("study.toml", "out", {"--resume"}));
  EXPECT_EQ(resumed.status, 0);
  EXPECT_THAT(resumed.err, HasSubstr("samples in it are whole and kept"));
  EXPECT_EQ(samples_of("out"), samples_of("whole"));
  EXPECT_THAT(json("out/summary.json")["warnings"].dump(), HasSubstr("damaged-samples.db"));
  EXPECT_EQ(text("out/damaged-samples.db"), bytes);
}

TEST_F(MonteCarloProgram, ExportReplacesItsOwnTableAndNoOther) {
  ASSERT_EQ(call(quick("study.toml", "out")).status, 0);
  const std::string table = samples_of("out");
  study("study.toml", 500);
  ASSERT_EQ(call(quick("study.toml", "out", {"--resume"})).status, 0);
  EXPECT_GT(samples_of("out").size(), table.size()) << "a table of fewer samples gives way";
  std::ofstream(folder_ / "out/samples.csv") << "my own notes\n";
  const Ended refused = call({"export", "out"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("samples.csv: is there already"));
  EXPECT_EQ(text("out/samples.csv"), "my own notes\n");
  EXPECT_EQ(files("out").size(), 5u) << "no litter";
}

TEST_F(MonteCarloProgram, ADiskThatFillsAtAnyByteIsOneLineAndCostsNoSampleThatWasStored) {
  const std::string whole = csv_of("study.toml", "whole");
  std::uintmax_t result = 0;
  for (const std::string& name : files("whole")) result += std::filesystem::file_size(folder_ / "whole" / name);
  for (const std::uintmax_t room :
       {std::uintmax_t{0}, std::uintmax_t{3000}, std::uintmax_t{40'000}, result / 4, result / 2}) {
    SCOPED_TRACE("room for " + std::to_string(room) + " bytes");
    std::filesystem::remove_all(folder_ / "disk");
    std::filesystem::create_directory(folder_ / "disk");
    const Ended full = call(quick("study.toml", "disk/out"), PlayedDisk{"disk", room});
    EXPECT_EQ(full.status, 3);
    EXPECT_TRUE(is_one_line(full.err)) << full.err;
    const Ended resumed = call(quick("study.toml", "disk/out", {"--resume"}));
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(samples_of("disk/out"), whole);
  }
}

TEST_F(MonteCarloProgram, ResultsOnADiskThatCannotBeWrittenAreExportedAndGoneOnWithElsewhere) {
  ASSERT_EQ(call(quick("study.toml", "whole")).status, 0);
  const std::string table = samples_of("whole");
  study("more.toml", 600);
  const PlayedDisk shut{"shut", {}, true};
  for (const bool with_log : {false, true}) {
    std::filesystem::remove_all(folder_ / "shut");
    std::filesystem::remove_all(folder_ / "csv");
    std::filesystem::remove_all(folder_ / "new");
    std::filesystem::copy(folder_ / "whole", folder_ / "shut", std::filesystem::copy_options::recursive);
    std::filesystem::remove(folder_ / "shut/samples.csv");
    if (with_log) {  // as a kill leaves it
      std::filesystem::remove_all(folder_ / "shut");
      const pid_t child = start(quick("study.toml", "shut", {"--jobs", "1"}));
      wait_until_stored("shut", 0);
      ::kill(child, SIGKILL);
      wait_for(child);
    }
    const auto there = files("shut");
    const Ended inside = call({"export", "shut", "--quiet"}, shut);
    EXPECT_EQ(inside.status, 2);
    EXPECT_THAT(inside.err, AllOf(HasSubstr("Read-only file system"), HasSubstr("give another --out")));
    const Ended exported_to = call({"export", "shut", "--out", "csv", "--quiet"}, shut);
    EXPECT_EQ(exported_to.status, 0) << exported_to.err;
    const Ended went_on = call(quick("more.toml", "new", {"--from", "shut"}), shut);
    EXPECT_EQ(went_on.status, 0) << went_on.err;
    EXPECT_EQ(files("shut"), there);
    const std::string exported = text("csv/samples.csv");
    EXPECT_EQ(table.substr(0, exported.size()), exported);
    EXPECT_EQ(samples_of("new").substr(0, table.size()), table);
    EXPECT_GT(json("new/summary.json")["cpu_seconds"].get<double>(), 0.0);
  }
}

}  // namespace montecarlo_store_program_test
}  // namespace boresight::app
