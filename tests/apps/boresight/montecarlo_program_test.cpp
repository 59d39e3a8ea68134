// boresight montecarlo as a user calls it: killed, resumed, spread over threads and ranks, replayed.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "program.hpp"

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MonteCarloProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    study("study.toml", 400);
  }
  void study(const std::string& name, int samples, const std::string& more = "") const {
    std::ofstream(folder_ / name) << "format = 1\nmechanism = \"" << mechanism_ << R"("
[[random]]
parameter = "clearance.F1.radial"
distribution = { normal = { mean = "0.1 mm", sd = "0.01 mm" }, truncate = ["0.05 mm", "0.15 mm"] }
[[random]]
parameter = "clearance.F1.contact.restitution"
distribution = { uniform = { min = 0.7, max = 0.95 } }
[[random]]
parameter = "clearance.F1.friction.coefficient"
distribution = { lognormal = { median = 0.03, factor = 1.3 } }
[montecarlo]
samples = )" << samples << "\n" << more
                                  << "\n";
  }
  // A motion of 20 ms on the cheapest rung with impacts.
  std::vector<std::string> quick(const std::string& name, const std::string& out,
                                 std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {
        "montecarlo", name, "--set", "motion.duration=20ms", "--rung", "perturbation", "--out", out, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  std::uintmax_t stored_bytes(const std::string& out) const {
    std::uintmax_t sum = 0;
    if (!std::filesystem::exists(folder_ / out)) return sum;
    std::error_code gone;  // the program may merge or remove one meanwhile
    for (const auto& file : std::filesystem::directory_iterator(folder_ / out))
      if (const std::uintmax_t size = std::filesystem::file_size(file, gone); !gone) sum += size;
    return sum;
  }
  // However fast the machine, there is something stored and more to come.
  void wait_until_stored(const std::string& out, std::uintmax_t before) const {
    for (int k = 0; k < 10000 && stored_bytes(out) < before + 100'000; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::string samples_of(const std::string& out) const {
    EXPECT_EQ(call({"export", out, "--quiet"}).status, 0);
    return text(out + "/samples.csv");
  }
  std::string csv_of(const std::string& name, const std::string& out, std::vector<std::string> more = {}) const {
    const Ended ended = call(quick(name, out, std::move(more)));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return samples_of(out);
  }
};

TEST_F(MonteCarloProgram, WritesSummaryReportStoreAndCsv) {
  const std::string csv = csv_of("study.toml", "out");
  EXPECT_THAT(csv, testing::StartsWith("sample,clearance.F1.radial,clearance.F1.contact.restitution,"
                                       "clearance.F1.friction.coefficient,value,status\n0,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 401);
  const nlohmann::json summary = json("out/summary.json");
  EXPECT_EQ(summary["samples"], 400);
  EXPECT_EQ(summary["failed"], 0);
  EXPECT_EQ(summary["seed"], 1);
  EXPECT_EQ(summary["interrupted"], false);
  for (const char* name : {"mean", "sd", "p50", "p95", "p99", "p99.73"})
    EXPECT_TRUE(summary["index"][name].contains("value") && summary["index"][name].contains("low")) << name;
  EXPECT_LT(summary["index"]["p50"]["low"], summary["index"]["p50"]["value"]);
  EXPECT_TRUE(summary["index"]["p99.73"]["high"].is_null()) << "400 samples do not bound this quantile";
  for (const char* part : {"sampling", "discretisation", "rung"}) EXPECT_TRUE(summary["error"][part].contains("why"));
  EXPECT_THAT(text("out/report.html"), HasSubstr("How sure the numbers are"));
}

TEST_F(MonteCarloProgram, AnyNumberOfThreadsGivesTheSameTable) {
  EXPECT_EQ(csv_of("study.toml", "one", {"--jobs", "1"}), csv_of("study.toml", "two", {"--jobs", "2"}));
}

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

double value_of_sample_7(const std::string& csv) {
  std::istringstream lines(csv);
  std::string row;
  for (int k = 0; k < 9; ++k) std::getline(lines, row);
  EXPECT_THAT(row, testing::StartsWith("7,"));
  const std::string value = row.substr(0, row.rfind(','));
  return std::stod(value.substr(value.rfind(',') + 1));
}

TEST_F(MonteCarloProgram, ASampleIsReplayedToTheSameBitsWhereAllTakeOneStep) {
  const double stored = value_of_sample_7(csv_of("study.toml", "out", {"--step", "50 us"}));
  const Ended ended = call({"run", "study.toml", "--set", "motion.duration=20ms", "--rung", "perturbation", "--step",
                            "50 us", "--sample-number", "7", "--out", "seven"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(json("seven/summary.json")["index"]["position_error"]["max"].get<double>(), stored);
  EXPECT_EQ(call({"run", "study.toml", "--sample-number", "-1"}).status, 2);
  EXPECT_EQ(call({"run", "study.toml", "--sample-number", "1.5"}).status, 2);
}

// Lanes choose their steps by the error; so does the replay, by the same method at other times.
TEST_F(MonteCarloProgram, ASampleOfLanesIsReplayedWithinItsStatedError) {
  const double stored = value_of_sample_7(csv_of("study.toml", "out"));
  EXPECT_THAT(json("out/summary.json")["replay"], HasSubstr("--integrator rosenbrock"));
  const Ended ended = call({"run", "study.toml", "--set", "motion.duration=20ms", "--rung", "perturbation",
                            "--integrator", "rosenbrock", "--sample-number", "7", "--out", "seven"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NEAR(json("seven/summary.json")["index"]["position_error"]["max"].get<double>(), stored, 5e-3 * stored);
}

// One step for all samples, the mean of what error control took in a pilot, is far too long for a contact.
TEST_F(MonteCarloProgram, WithAnIntegratorASampleIsTheRunOfItsNumber) {
  study("few.toml", 9);
  const double stored =
      value_of_sample_7(csv_of("few.toml", "out", {"--integrator", "rosenbrock", "--tolerance", "1e-4"}));
  const nlohmann::json summary = json("out/summary.json");
  EXPECT_EQ(summary["failed"], 0);
  EXPECT_EQ(summary["step"], 0.0);
  EXPECT_THAT(summary["replay"], HasSubstr("--integrator rosenbrock --tolerance 1e-4"));
  const Ended ended =
      call({"run", "few.toml", "--set", "motion.duration=20ms", "--rung", "perturbation", "--integrator", "rosenbrock",
            "--tolerance", "1e-4", "--sample-number", "7", "--out", "seven"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(json("seven/summary.json")["index"]["position_error"]["max"].get<double>(), stored);
  // Neither resumed with another tolerance nor with another integrator.
  for (const char* integrator : {"rosenbrock", "dopri5"})
    EXPECT_EQ(call(quick("few.toml", "out", {"--integrator", integrator, "--resume"})).status, 2) << integrator;
}

TEST_F(MonteCarloProgram, AStudyThatFailsSaysWhyOnTheTerminalInTheSummaryAndInTheReport) {
  study("few.toml", 4);
  std::vector<std::string> arguments = quick("few.toml", "out", {"--integrator", "rosenbrock", "--step", "2 ms"});
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--quiet"));
  const Ended ended = call(arguments);
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.out,
              AllOf(HasSubstr("4 of 4 samples failed"), HasSubstr("the first of them, sample 0: step too large")));
  const nlohmann::json summary = json("out/summary.json");
  EXPECT_EQ(summary["first_failure"]["sample"], 0);
  EXPECT_THAT(summary["first_failure"]["reason"].get<std::string>(), HasSubstr("step too large"));
  EXPECT_THAT(text("out/report.html"), HasSubstr("step too large"));
}

TEST_F(MonteCarloProgram, WhatEverySampleWouldRefuseIsRefusedAtTheStart) {
  const Ended ended =
      call({"montecarlo", "study.toml", "--set", "motion.duration=20ms", "--set", "clearance.F1.friction.law=lugre",
            "--rung", "multibody", "--integrator", "generalized-alpha", "--out", "out", "--quiet"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("--integrator: found \"generalized-alpha\""), HasSubstr("LuGre")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(MonteCarloProgram, ARequirementThatIsNotMetIsStatusOneAndWilksIsToldBefore) {
  study("tight.toml", 100, "requirement = { limit = \"1 um\", probability = 0.9973, confidence = 0.95 }");
  std::vector<std::string> arguments = quick("tight.toml", "out");
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--quiet"));
  const Ended ended = call(arguments);
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("1109 independent samples if none"), HasSubstr("not shown to be met")));
  EXPECT_EQ(json("out/summary.json")["requirement"]["met"], false);
  study("wide.toml", 1200, "requirement = { limit = \"5 mm\", probability = 0.9973, confidence = 0.95 }");
  EXPECT_EQ(call(quick("wide.toml", "wide")).status, 0);
  EXPECT_GE(json("wide/summary.json")["requirement"]["probability"]["low"], 0.9973);
}

TEST_F(MonteCarloProgram, LookingAgainWithMoreSamplesIsJudgedByTheRiskThatWasLeft) {
  const std::string wanted = "requirement = { limit = \"1 um\", probability = 0.95, confidence = 0.95 }";
  study("first.toml", 100, wanted);
  study("more.toml", 150, wanted);
  ASSERT_EQ(call(quick("first.toml", "out")).status, 1);
  EXPECT_FALSE(json("out/summary.json")["requirement"].contains("judged"));
  ASSERT_EQ(call(quick("more.toml", "out", {"--resume"})).status, 1);
  const auto again = json("out/summary.json")["requirement"];
  EXPECT_THAT(again["judged"].get<std::string>(), HasSubstr("judged at 100 samples before"));
  EXPECT_GT(again["probability"]["confidence"].get<double>(), 0.95);
  // The first look again is what it was.
  ASSERT_EQ(call(quick("first.toml", "out", {"--resume"})).status, 1);
  EXPECT_FALSE(json("out/summary.json")["requirement"].contains("judged"));
}

TEST_F(MonteCarloProgram, AnAccuracyThatThePilotDidNotReachIsStatusOneAlsoWhenResumed) {
  study("rough.toml", 8);
  const std::vector<std::string> arguments = {"montecarlo", "rough.toml", "--set", "motion.duration=20ms",
                                              "--accuracy", "0.0001 %",   "--out", "out",
                                              "--quiet",    "--resume"};
  EXPECT_EQ(call(arguments).status, 1);
  const auto first = json("out/summary.json");
  ASSERT_TRUE(first.contains("pilot"));
  EXPECT_FALSE(first["pilot"]["met"].get<bool>());
  EXPECT_EQ(call(arguments).status, 1);
  EXPECT_EQ(json("out/summary.json")["pilot"], first["pilot"]);
}

TEST_F(MonteCarloProgram, InterruptedWhileItsStepsAreMeasuredItHasItsSamplesAndTheirTable) {
  study("few.toml", 8);
  const std::vector<std::string> arguments = {"montecarlo", "few.toml",     "--set", "motion.duration=60s",
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

TEST_F(MonteCarloProgram, TheCostIsThatOfAllParts) {
  std::vector<double> cpu;
  for (const int samples : {400, 800, 1200}) {
    study("study.toml", samples);
    ASSERT_EQ(call(quick("study.toml", "out", {"--resume"})).status, 0);
    cpu.push_back(json("out/summary.json")["cpu_seconds"].get<double>());
  }
  // The first part takes most: it also measures what the steps do.
  EXPECT_GT(cpu[1], cpu[0] + 0.01);
  EXPECT_GT(cpu[2], cpu[1] + 0.01);
}

TEST_F(MonteCarloProgram, MistakesInTheStudyAreOneLine) {
  study("bad.toml", 100, "desing = \"lhs\"");
  const Ended ended = call(quick("bad.toml", "out"));
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err));
  EXPECT_THAT(ended.err, AllOf(HasSubstr("bad.toml:"), HasSubstr("did you mean design?")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

#ifdef BORESIGHT_MPIEXEC

class MonteCarloRanks : public MonteCarloProgram {
 protected:
  int under_mpirun(int ranks, const std::vector<std::string>& arguments) const {
    std::string command = "cd '" + folder_.string() +
                          "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" BORESIGHT_MPIEXEC
                          "' --oversubscribe -np " +
                          std::to_string(ranks) + " '" BORESIGHT_PROGRAM "'";
    for (const std::string& argument : arguments) command += " '" + argument + "'";
    const int status = std::system((command + " > mpi.out 2> mpi.err").c_str());
    return WEXITSTATUS(status);
  }
};

TEST_F(MonteCarloRanks, TwoRanksGiveTheTableOfOneProcess) {
  const std::string whole = csv_of("study.toml", "whole");
  EXPECT_EQ(under_mpirun(2, quick("study.toml", "out", {"--jobs", "1"})), 0) << text("mpi.err");
  EXPECT_EQ(samples_of("out"), whole);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/samples.1.db")) << "shards are merged";
}

TEST_F(MonteCarloRanks, ARankThatIsKilledCostsOnlyWhatItHadNotStored) {
  study("long.toml", 25000);
  const std::string whole = csv_of("long.toml", "whole");
  // The shell of rank 1 kills its program from outside once samples are being stored.
  const std::string script = (folder_ / "rank.sh").string();
  std::ofstream(script)
      << "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then '" BORESIGHT_PROGRAM
         "' \"$@\" & child=$!; for k in $(seq 200); do ls out/*.db > /dev/null 2>&1 && break; sleep 0.05; done; "
         "sleep 0.2; kill -9 $child; wait $child; else exec '" BORESIGHT_PROGRAM "' \"$@\"; fi\n";
  std::string command = "cd '" + folder_.string() +
                        "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" BORESIGHT_MPIEXEC
                        "' --oversubscribe -np 2 bash rank.sh";
  for (const std::string& argument : quick("long.toml", "out", {"--jobs", "1"})) command += " '" + argument + "'";
  std::system((command + " > mpi.out 2> mpi.err").c_str());
  EXPECT_EQ(under_mpirun(2, quick("long.toml", "out", {"--jobs", "1", "--resume"})), 0) << text("mpi.err");
  EXPECT_EQ(samples_of("out"), whole);
}

TEST_F(MonteCarloRanks, AMistakeIsSaidOnce) {
  study("bad.toml", 100, "desing = \"lhs\"");
  EXPECT_EQ(under_mpirun(2, quick("bad.toml", "out")), 2);
  const std::string said = text("mpi.err");
  EXPECT_NE(said.find("did you mean design?"), std::string::npos) << said;
  EXPECT_EQ(said.find("did you mean design?"), said.rfind("did you mean design?")) << said;
}

#endif

}  // namespace
}  // namespace boresight::app
