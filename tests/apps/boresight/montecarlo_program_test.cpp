// boresight montecarlo as a user calls it: what it writes, replays, refuses and concludes.
#include "montecarlo_program.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace boresight::app {
namespace montecarlo_program_test {

using testing::AllOf;
using testing::HasSubstr;

double value_of_sample_7(const std::string& csv) {
  std::istringstream lines(csv);
  std::string row;
  for (int k = 0; k < 9; ++k) std::getline(lines, row);
  EXPECT_THAT(row, testing::StartsWith("7,"));
  const std::string value = row.substr(0, row.rfind(','));
  return std::stod(value.substr(value.rfind(',') + 1));
}

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

TEST_F(MonteCarloProgram, WarnsOfALawOutsideOfItsRange) {
  write("study.toml", "format = 1\nmechanism = \"" + mechanism_ +
                          "\"\n[[random]]\nparameter = \"clearance.F1.contact.restitution\"\n"
                          "distribution = { uniform = { min = 0.7, max = 0.95 } }\n[montecarlo]\nsamples = 20\n");
  const auto warnings_at = [&](const std::string& radial) {
    const Ended ended = call(quick("study.toml", radial, {"--set", "clearance.F1.radial=" + radial}));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return json(radial + "/summary.json")["warnings"];
  };
  const auto of_range = HasSubstr("flores is used outside of its range");
  EXPECT_THAT(warnings_at("20um"), testing::Contains(of_range));
  EXPECT_THAT(warnings_at("0.2mm"), testing::Each(testing::Not(of_range)));
}

TEST_F(MonteCarloProgram, AnyNumberOfThreadsGivesTheSameTable) {
  EXPECT_EQ(csv_of("study.toml", "one", {"--jobs", "1"}), csv_of("study.toml", "two", {"--jobs", "2"}));
}

TEST_F(MonteCarloProgram, ASampleIsReplayedToTheSameBitsWhereAllTakeOneStep) {
  const double stored = value_of_sample_7(csv_of("study.toml", "out", {"--step", "50 us"}));
  const Ended ended = call({"run", "study.toml", "--set", "motion.duration=20ms", "--rung", "perturbation", "--step",
                            "50 us", "--sample-number", "7", "--out", "seven"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(json("seven/summary.json")["index"]["position_error"]["max"].get<double>(), stored);
  EXPECT_EQ(call({"run", "study.toml", "--sample-number", "-1"}).status, 2);
  EXPECT_EQ(call({"run", "study.toml", "--sample-number", "7", "--index", "position_error.max"}).status, 2);
  EXPECT_EQ(call({"run", "study.toml", "--sample-number", "1.5"}).status, 2);
  const Ended beyond = call({"run", "study.toml", "--sample-number", "400"});
  EXPECT_EQ(beyond.status, 2);
  EXPECT_THAT(beyond.err, HasSubstr("expected one of the study's 400 samples, from 0 to 399"));
}

// Without --out, as everything without it.
TEST_F(MonteCarloProgram, ASampleThatIsReplayedDifferentlyHasAFolderOfItsOwn) {
  for (const char* step : {"50 us", "25 us"}) {
    const Ended ended = call({"run", "study.toml", "--set", "motion.duration=5ms", "--rung", "perturbation", "--step",
                              step, "--sample-number", "7", "--step-error", "off"});
    EXPECT_EQ(ended.status, 0) << ended.err;
  }
  EXPECT_EQ(json("results/study-sample-7/summary.json")["verb"], "run");
  EXPECT_EQ(json("results/study-sample-7-2/summary.json")["verb"], "run");
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

TEST_F(MonteCarloProgram, SaysTheLimitAsItIsTyped) {
  study("typed.toml", 20, "requirement = { limit = \"1.00096 mm\", probability = 0.5, confidence = 0.9 }");
  EXPECT_EQ(call(quick("typed.toml", "typed")).status, 0);
  EXPECT_THAT(json("typed/report.json").dump(), HasSubstr("at or below 1.00096 mm in 50 % of all cases"));
}

TEST_F(MonteCarloProgram, BothSharesOfARequirementAreOneSidedAtItsConfidence) {
  study("both.toml", 60, "requirement = { limit = \"1 mm\", probability = 0.5, confidence = 0.9 }");
  ASSERT_EQ(call(quick("both.toml", "both")).status, 0);
  const nlohmann::json requirement = json("both/summary.json")["requirement"];
  for (const char* share : {"probability", "within_model_error"}) {
    EXPECT_EQ(requirement.at(share).at("confidence"), 0.9) << share;
    EXPECT_EQ(requirement.at(share).at("bounds"), "one-sided, each at this confidence") << share;
  }
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

// The rows' hash has digits like those of a number too large for any.
TEST_F(MonteCarloProgram, ReportsRowsOfATable) {
  std::ofstream(folder_ / "rows.csv") << "b\n49\n88\n28\n";
  std::ofstream(folder_ / "rows.toml")
      << "format = 1\nmechanism = \"" << mechanism_
      << "\"\n[montecarlo]\nsamples = 20\n[[random]]\nparameters = "
         "[\"clearance.F1.radial\"]\ndistribution = { rows = { file = \"rows.csv\", columns = "
         "[\"b\"], units = [\"um\"] } }\n";
  const Ended ended =
      call({"montecarlo", "rows.toml", "--rung", "quasistatic", "--set", "motion.duration=10ms", "--out", "rows"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(text("rows/report.html"), HasSubstr("rows("));
}

TEST_F(MonteCarloProgram, MistakesInTheStudyAreOneLine) {
  study("bad.toml", 100, "desing = \"lhs\"");
  const Ended ended = call(quick("bad.toml", "out"));
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err));
  EXPECT_THAT(ended.err, AllOf(HasSubstr("bad.toml:"), HasSubstr("did you mean design?")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace montecarlo_program_test
}  // namespace boresight::app
