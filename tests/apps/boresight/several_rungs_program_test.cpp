// boresight sensitivity, and the fidelities and tail of montecarlo, as a user calls them.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "program.hpp"

namespace boresight::app {
namespace several_rungs_program_test {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class SeveralRungsProgram : public Program {
 protected:
  void study(const std::string& table) const {
    std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" << mechanism_ << R"("
[[random]]
parameter = "clearance.F1.radial"
distribution = { normal = { mean = "0.1 mm", sd = "0.01 mm" }, truncate = ["0.05 mm", "0.15 mm"] }
[[random]]
parameter = "clearance.F1.friction.coefficient"
distribution = { lognormal = { median = 0.03, factor = 1.3 } }
)" << table;
  }
  // The keys of [montecarlo] that these studies have, a line each.
  static std::string fidelities(const std::string& first, const std::string& second, const std::string& budget) {
    return "fidelities = { models = [\"" + first + "\", \"" + second + "\"], budget = \"" + budget +
           "\", pilot = 10 }\n";
  }
  static std::string tail(const std::string& cheap, const std::string& budget, int pilot) {
    return "tail = { cheap = \"" + cheap + "\", exact = \"quasistatic\", budget = \"" + budget +
           "\", pilot = " + std::to_string(pilot) + " }\n";
  }
  static std::string requirement(const std::string& limit, const std::string& probability) {
    return "requirement = { limit = \"" + limit + "\", probability = " + probability + ", confidence = 0.9 }\n";
  }
  // A motion of 20 ms.
  Ended ask(const std::string& verb, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {verb, "study.toml", "--set", "motion.duration=20ms", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return call(arguments);
  }
};

TEST_F(SeveralRungsProgram, SensitivityLeavesWhatTheInterfacePromises) {
  study("[sensitivity]\nsamples = 64\nreplicates = 4\n");
  const Ended ended = ask("sensitivity", {"--rung", "quasistatic"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("clearance.F1.radial"), HasSubstr("total"), HasSubstr("out/report.html")));
  for (const char* file : {"summary.json", "sobol.csv", "local.csv", "report.html", "samples.db"})
    EXPECT_THAT(files("out"), Contains(file));
  const auto summary = json("out/summary.json");
  EXPECT_EQ(summary["verb"], "sensitivity");
  EXPECT_EQ(summary["runs"], 256);
  EXPECT_EQ(summary["failed"], 0);
  // Quasistatic error follows the clearance, and friction has no part in it.
  EXPECT_NEAR(summary["sobol"]["clearance.F1.radial"]["total"]["value"].get<double>(), 1.0, 0.15);
  EXPECT_NEAR(summary["sobol"]["clearance.F1.friction.coefficient"]["total"]["value"].get<double>(), 0.0, 0.01);
  EXPECT_TRUE(summary["local"]["clearance.F1.radial"]["meaningful"].get<bool>());

  const Ended again = ask("sensitivity", {"--rung", "quasistatic"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(json("out/summary.json")["sobol"], summary["sobol"]);
}

TEST_F(SeveralRungsProgram, FidelitiesForecastTheirGainAndAgreeWithThePilot) {
  study("[montecarlo]\n" + fidelities("perturbation", "quasistatic", "2 s"));
  const Ended ended = ask("montecarlo");
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("forecast"), HasSubstr("unbiased for perturbation")));
  const auto summary = json("out/summary.json");
  const auto& mean = summary["index"]["mean"];
  EXPECT_LT(mean["low"].get<double>(), mean["value"].get<double>());
  EXPECT_GT(summary["fidelities"]["rungs"][0]["samples"].get<int>(), 1);
  double counted = 0.0;  // what the plan may spend, whatever a machine takes for it
  for (const auto& rung : summary["fidelities"]["rungs"])
    counted += rung["samples"].get<double>() * rung["counted_seconds_per_sample"].get<double>();
  EXPECT_LE(counted, 2.0);
  EXPECT_GT(counted, 1.5);
  for (const char* file : {"rungs.csv", "report.html", "samples-perturbation.db"})
    EXPECT_THAT(files("out"), Contains(file));
  EXPECT_EQ(ask("montecarlo").status, 0);
  EXPECT_EQ(json("out/summary.json")["index"]["mean"], mean);  // the plan it was begun with, all samples found again
}

// With the times, which no comparison of two starts sees, and in the report as other warnings are.
TEST_F(SeveralRungsProgram, SayInTheirFilesWhereMuchMoreThanTheBudgetWasSpent) {
  study("[montecarlo]\n" + fidelities("perturbation", "quasistatic", "0.5 s"));
  const Ended ended = ask("montecarlo");
  ASSERT_EQ(ended.status, 0) << ended.err;
  const auto fidelities = json("out/summary.json")["fidelities"];
  const bool said = fidelities["cpu_seconds"].get<double>() > 2.5 * fidelities["budget"].get<double>();
  EXPECT_EQ(fidelities.contains("cpu_seconds_beyond_budget"), said);
  for (const std::string& shown : {ended.out, text("out/report.html")})
    EXPECT_EQ(shown.find("times the budget") != std::string::npos, said);
  EXPECT_EQ(json("out/summary.json")["warnings"].dump().find("times the budget"), std::string::npos);
}

TEST_F(SeveralRungsProgram, TheNextCommandIsOneThatTheResultsServe) {
  study("[montecarlo]\n" + fidelities("quasistatic", "envelope", "0.3 s"));
  const Ended ended = ask("montecarlo");
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("next: boresight export out: every sample as CSV, a table for each rung"));
  EXPECT_EQ(call({"export", "out"}).status, 0);
}

TEST_F(SeveralRungsProgram, ExportWritesATableForEachRungAndOneNumberIsOneDraw) {
  study("[montecarlo]\n" + fidelities("quasistatic", "envelope", "0.3 s"));
  ASSERT_EQ(ask("montecarlo").status, 0);
  const Ended exported = call({"export", "out", "--out", "csv"});
  ASSERT_EQ(exported.status, 0) << exported.err;
  EXPECT_THAT(files("csv"), testing::UnorderedElementsAre("samples-quasistatic.csv", "samples-envelope.csv"));
  const auto summary = json("out/summary.json");
  std::vector<std::vector<std::string>> drawn;  // number and parameters, row by row
  for (const auto& rung : summary["fidelities"]["rungs"]) {
    const std::string name = "csv/samples-" + rung["rung"].get<std::string>() + ".csv";
    EXPECT_THAT(exported.out, HasSubstr(name));
    std::istringstream table(text(name));
    std::string line;
    std::getline(table, line);
    EXPECT_EQ(line, "sample,clearance.F1.radial,clearance.F1.friction.coefficient,value,status");
    auto& rows = drawn.emplace_back();
    while (std::getline(table, line)) rows.push_back(line.substr(0, line.rfind(',', line.rfind(',') - 1)));
    EXPECT_EQ(rows.size(), rung["samples"].get<std::size_t>() + 10) << "the pilot's ten and the estimate's";
  }
  ASSERT_EQ(drawn.size(), 2u);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(drawn[0][k], drawn[1][k]);
  EXPECT_NE(text("csv/samples-quasistatic.csv"), text("csv/samples-envelope.csv")) << "the values are the rung's own";
}

TEST_F(SeveralRungsProgram, ExportSaysWhyATailHasNoSamples) {
  study("[montecarlo]\n" + requirement("0.22 mm", "0.9") + tail("envelope", "0.2 s", 10));
  const Ended ended = ask("montecarlo");
  ASSERT_LE(ended.status, 1) << ended.err;
  EXPECT_THAT(ended.out, Not(HasSubstr("boresight export")));
  const Ended exported = call({"export", "out"});
  EXPECT_EQ(exported.status, 2);
  EXPECT_TRUE(is_one_line(exported.err)) << exported.err;
  EXPECT_THAT(exported.err, HasSubstr("holds no samples: the points of a tail"));
}

TEST_F(SeveralRungsProgram, FidelitiesSayThatTheirBudgetDecidesHowManySamplesThereAre) {
  study("[montecarlo]\nsamples = 400\n" + fidelities("perturbation", "quasistatic", "2 s"));
  const Ended ended = ask("montecarlo");
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("samples = 400 is not used: the budget of fidelities decides"));
  EXPECT_THAT(json("out/summary.json")["warnings"].dump(), HasSubstr("samples = 400 is not used"));
}

// Quasistatic error grows with the clearance and knows no friction: what exceeds the error at a clearance of 0.12 mm are the clearances beyond
// it, Phi(2) to Phi(5) of the distribution cut at five standard deviations.
TEST_F(SeveralRungsProgram, TailSaysHowRareTheExcessIsAndAnswersByIt) {
  ASSERT_EQ(call({"run", mechanism_, "--rung", "quasistatic", "--set", "motion.duration=20ms", "--set",
                  "clearance.F1.radial=0.12mm", "--out", "limit", "--quiet"})
                .status,
            0);
  const std::string limit = json("limit/summary.json")["index"]["position_error"]["max"].dump();
  const auto beyond = [](double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); };
  const double truth = (beyond(2.0) - beyond(5.0)) / (1.0 - 2.0 * beyond(5.0));
  for (const auto& [probability, by_samples] : {std::pair{"0.99", false}, std::pair{"0.95", true}}) {
    std::filesystem::remove_all(folder_ / "out");
    study("[montecarlo]\n" + requirement(limit + " m", probability) + tail("perturbation", "0.4 s", 20));
    const Ended ended = ask("montecarlo");
    const auto summary = json("out/summary.json");
    EXPECT_EQ(summary["requirement"]["met_by_samples"].get<bool>(), by_samples) << ended.out << ended.err;
    EXPECT_EQ(ended.status, summary["requirement"]["met"].get<bool>() ? 0 : 1);
    const auto& exceedance = summary["tail"]["exceedance"];
    EXPECT_NEAR(exceedance["value"].get<double>(), truth, 3.0 * summary["tail"]["standard_error"].get<double>());
    EXPECT_LT(summary["tail"]["standard_error"].get<double>(), 0.3 * truth);
    EXPECT_LE(exceedance["low"].get<double>(), truth);
    EXPECT_GE(exceedance["high"].get<double>(), truth);
    for (const char* file : {"levels.csv", "report.html"}) EXPECT_THAT(files("out"), Contains(file));
  }
}

// In the first 20 ms the paper's mechanism rings: journals at rest leave out as much as the error itself. Plain samples of that rung
// do not show a limit a little above its answers, and no more do samples that are spent more cleverly.
TEST_F(SeveralRungsProgram, ARequirementIsMetOnlyWithWhatTheFirstRungLeavesOut) {
  const std::string asked = requirement("0.25 mm", "0.9");
  for (const auto& [table, words] :
       {std::pair{fidelities("quasistatic", "envelope", "0.5 s"),
                  "the samples show the requirement, the model does not"},
        std::pair{tail("envelope", "0.4 s", 20), "the samples show the requirement, the model does not"},
        std::pair{std::string("samples = 100\n"), "The samples show it, the model does not"}}) {
    std::filesystem::remove_all(folder_ / "out");
    study("[montecarlo]\n" + asked + table);
    const bool plain = table.starts_with("samples");
    const Ended ended =
        ask("montecarlo", plain ? std::vector<std::string>{"--rung", "quasistatic"} : std::vector<std::string>{});
    EXPECT_EQ(ended.status, 1) << table << ended.out << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(words));
    const auto summary = json("out/summary.json");
    EXPECT_TRUE(summary["requirement"]["met_by_samples"].get<bool>()) << table;
    EXPECT_FALSE(summary["requirement"]["met"].get<bool>()) << table;
    EXPECT_GT(summary["error"]["rung"]["relative"].get<double>(), 0.3) << table;
    EXPECT_LT(summary["requirement"]["within_model_error"]["value"].get<double>(), 0.9) << table;
  }
}

TEST_F(SeveralRungsProgram, FidelitiesSayThatTheirPlanLeavesTooFewSamplesToShowARequirement) {
  study("[montecarlo]\n" + requirement("1 mm", "0.9999") + fidelities("perturbation", "quasistatic", "0.5 s"));
  const Ended ended = ask("montecarlo");
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("too few to show the requirement, which takes 23025"),
                               HasSubstr("without fidelities, judge it")));
}

TEST_F(SeveralRungsProgram, FidelitiesSayTheirMeanInTheUnitOfTheLimit) {
  study("[montecarlo]\n" + requirement("900 um", "0.9") + fidelities("quasistatic", "envelope", "0.3 s"));
  const Ended ended = ask("montecarlo");
  ASSERT_LE(ended.status, 1) << ended.err;
  EXPECT_THAT(ended.out, testing::ContainsRegex("Mean [0-9.]+ um"));
}

// The budget is divided by what samples are counted at: once more, and resumed, the same plan and the same numbers.
TEST_F(SeveralRungsProgram, FidelitiesAndTailGiveTheSameNumbersAgain) {
  study("[montecarlo]\n" + requirement("0.3 mm", "0.9") + fidelities("perturbation", "quasistatic", "0.5 s"));
  const auto answers = [&](const std::string& part) {
    auto summary = json("out/summary.json");
    for (auto& rung : summary[part]["rungs"]) rung.erase("cpu_seconds_per_sample");
    return std::vector<nlohmann::json>{
        summary["index"],       summary["requirement"],      summary["samples"],
        summary[part]["rungs"], summary[part]["exceedance"], summary[part]["standard_error"]};
  };
  ask("montecarlo");
  const auto first = answers("fidelities");
  EXPECT_TRUE(first[3][0].contains("counted_seconds_per_sample"));
  ask("montecarlo", {"--resume"});
  EXPECT_EQ(answers("fidelities"), first);
  std::filesystem::remove_all(folder_ / "out");
  ask("montecarlo", {"--jobs", "2"});
  EXPECT_EQ(answers("fidelities"), first);
  std::filesystem::remove_all(folder_ / "out");

  study("[montecarlo]\n" + requirement("0.3 mm", "0.99") + tail("perturbation", "0.2 s", 10));
  ask("montecarlo");
  const auto tail = answers("tail");
  std::filesystem::remove_all(folder_ / "out");
  ask("montecarlo", {"--jobs", "2"});
  EXPECT_EQ(answers("tail"), tail);
}

TEST_F(SeveralRungsProgram, ContradictionsAreRefusedWithTheirLine) {
  const struct {
    const char *table, *words;
  } cases[] = {
      {"[montecarlo]\nfidelities = { models = [\"multibody\"], budget = \"2 s\" }\n", "two rungs"},
      {"[montecarlo]\nfidelities = { models = [\"multibody\", \"perturbatoin\"], budget = \"2 s\" }\n",
       "did you mean perturbation?"},
      {"[montecarlo]\nfidelities = { models = [\"multibody\", \"envelope\"], budget = \"-2 s\" }\n", "more than 0"},
      {"[montecarlo]\ndesign = \"sobol\"\nsamples = 64\nfidelities = { models = [\"multibody\", \"envelope\"], budget "
       "= \"2 s\" }\n",
       "random"},
      {"[montecarlo]\ndesign = \"sobol\"\nfidelities = { models = [\"multibody\", \"envelope\"], budget = \"2 s\" }\n",
       "montecarlo.design"},
      {"[montecarlo]\ntail = { budget = \"2 s\" }\n", "requirement"},
      {"[sensitivity]\nsamples = 100\n", "power of two"}};
  for (const auto& c : cases) {
    study(c.table);
    const Ended ended = ask(std::string(c.table).starts_with("[sens") ? "sensitivity" : "montecarlo");
    EXPECT_EQ(ended.status, 2) << c.table;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("study.toml:"), HasSubstr(c.words)));
  }
}

TEST_F(SeveralRungsProgram, ARungBesideThoseThatTheStudyNamesIsRefused) {
  study("[montecarlo]\n" + fidelities("perturbation", "quasistatic", "2 s"));
  const Ended ended = ask("montecarlo", {"--rung", "multibody"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("--rung: found \"multibody\", expected none: the study names its rungs"));
}

}  // namespace several_rungs_program_test
}  // namespace boresight::app
