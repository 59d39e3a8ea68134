// boresight budget as a user calls it: answers, exit statuses, what is written, going on after a kill.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <numbers>
#include <thread>

#include "program.hpp"

namespace boresight::app {
namespace budget_program_test {

using testing::AllOf;
using testing::HasSubstr;

class BudgetProgram : public Program {
 protected:
  void study(const std::string& more, const std::string& members = "20") const {
    std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" << mechanism_ << R"("
[index]
quantity = "boresight_error"
[[random]]
parameter = "clearance.F1.radial"
distribution = { uniform = { min = "0.08 mm", max = "0.12 mm" } }
[budget]
attribution = 4
sampling = "0.2 ms"
window = "2 ms"
members = )" << members << '\n' << more;
  }
  static std::vector<std::string> arguments(const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = {
        "budget",      "study.toml", "--set", "motion.duration=20ms", "--set", "clearance.F1.axes=free", "--rung",
        "quasistatic", "--out",      "out"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static std::string requirement(const std::string& limit) {
    return "[[budget.requirement]]\nlimit = \"" + limit + "\"\nprobability = 0.8\nconfidence = 0.9\n";
  }
};

TEST_F(BudgetProgram, AnswersARequirementThatIsMetAndWritesWhatItSays) {
  study(requirement("3 deg") +
        "[[budget.contributor]]\nname = \"mounting\"\nclass = \"bias\"\nvalue = \"60 arcsec\"\n");
  const Ended ended = call(arguments());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out,
              AllOf(HasSubstr("APE, half cone, mixed, 80 %"), HasSubstr("limit 3 deg: met"), Not(HasSubstr("arcsec"))));
  const auto summary = json("out/summary.json");
  EXPECT_TRUE(summary["requirements"][0]["met"].get<bool>());
  EXPECT_EQ(summary["levels"].size(), 3u * 3u * 3u);  // APE, MPE, RPE; three axes; three interpretations
  double share = 0.0;
  for (const auto& c : summary["contributions"]) share += c["share"].get<double>();
  EXPECT_NEAR(share, 1.0, 1e-9);
  EXPECT_EQ(summary["tighten_first"][0]["name"], "F1");
  // Every number's source is named, with where it comes from.
  for (const auto& level : summary["levels"]) {
    const auto& source = summary["sources"][level["source"].get<std::string>()];
    EXPECT_EQ(source["store"], "samples.db");
    EXPECT_EQ(source["seed"], summary["seed"]);
    EXPECT_EQ(source["study_hash"], summary["study"]["hash"]);
    EXPECT_EQ(source["mechanism_hash"], summary["mechanism"]["hash"]);
    EXPECT_EQ(source["rung"], "quasistatic");
  }
  EXPECT_THAT(text("out/report.html"), AllOf(HasSubstr("Classical table"), HasSubstr("What to tighten first")));
  EXPECT_THAT(text("out/levels.csv"), HasSubstr("\nRPE,half cone,temporal,"));
}

TEST_F(BudgetProgram, SaysLimitsAndAllocationsAsTheyAreTyped) {
  study(requirement("3.00096 deg") +
        "[[budget.contributor]]\nname = \"mounting\"\nclass = \"bias\"\nvalue = \"60 arcsec\"\n"
        "[[budget.part]]\nname = \"base\"\ncontributors = [\"mounting\"]\nallocated = \"0.10096 mrad\"\n");
  const Ended ended = call(arguments());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out + ended.err,
              AllOf(HasSubstr("limit 3.00096 deg: met"), HasSubstr(" of 0.10096 mrad allocated")));
  EXPECT_THAT(ended.out + ended.err, testing::ContainsRegex("base comes to [0-9.]+ mrad of 0.10096 mrad"))
      << "what is held against it has its unit";
  EXPECT_THAT(text("out/report.html"), AllOf(HasSubstr("3.00096 deg"), HasSubstr("0.10096 mrad")));
}

TEST_F(BudgetProgram, AnswersNoWhereARequirementIsNotMetAndReusesTheRuns) {
  study(requirement("3 deg"));
  ASSERT_EQ(call(arguments({"--quiet"})).status, 0);
  const auto before = json("out/summary.json");
  study(requirement("1 arcsec"));
  const Ended ended = call(arguments({}));
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("of them stored already"), HasSubstr("above the limit")));
  EXPECT_EQ(json("out/summary.json")["levels"][0]["value"], before["levels"][0]["value"]);
}

TEST_F(BudgetProgram, LookingAgainWithMoreMembersIsJudgedByWhatHoldsThen) {
  const std::string ensemble =
      "[[budget.requirement]]\ninterpretation = \"ensemble\"\nlimit = \"1 deg\"\nprobability = 0.9\n";
  const std::string asked = requirement("1 arcsec") + ensemble;
  study(asked, "20");
  ASSERT_EQ(call(arguments({"--quiet"})).status, 1);
  EXPECT_FALSE(json("out/summary.json")["requirements"][1].contains("judged"));
  study(asked, "25");
  const Ended again = call(arguments({"--resume"}));
  ASSERT_EQ(again.status, 1) << again.err;
  EXPECT_THAT(again.out, HasSubstr("judged at 20 members before"));
  const auto summary = json("out/summary.json");
  EXPECT_THAT(summary["requirements"][0]["judged"].get<std::string>(), HasSubstr("the bet that the first bound was"));
  // 20 members could not show 90 % with 90 % confidence, so that no risk was taken.
  EXPECT_THAT(summary["requirements"][1]["judged"].get<std::string>(),
              HasSubstr("a confidence sequence with the risk that was left, 10 %"));
  EXPECT_FALSE(summary["requirements"][1]["met"].get<bool>());
  EXPECT_GT(summary["requirements"][1]["fewest_members"], 25);
  // Another limit is another question.
  study(requirement("2 deg") + ensemble, "25");
  ASSERT_EQ(call(arguments({"--quiet", "--resume"})).status, 1);
  EXPECT_FALSE(json("out/summary.json")["requirements"][0].contains("judged"));
  // The first look again is what it was.
  study(asked, "20");
  ASSERT_EQ(call(arguments({"--quiet", "--resume"})).status, 1);
  EXPECT_FALSE(json("out/summary.json")["requirements"][1].contains("judged"));
}

TEST_F(BudgetProgram, GivesTheSameBitsOnAnyNumberOfThreads) {
  study("[[budget.contributor]]\nname = \"noise\"\nclass = \"random\"\nvalue = \"5 arcsec\"\n");
  ASSERT_EQ(call(arguments({"--quiet", "--jobs", "1"})).status, 0);
  const std::string one = text("out/levels.csv");
  std::filesystem::remove_all(folder_ / "out");
  ASSERT_EQ(call(arguments({"--quiet", "--jobs", "3"})).status, 0);
  EXPECT_EQ(text("out/levels.csv"), one);
}

TEST_F(BudgetProgram, GoesOnAfterAKill) {
  study("", "4000");
  std::vector<std::string> moving = arguments({"--quiet", "--jobs", "1"});
  moving[7] = "perturbation";  // slow enough that the log grows by commits alone, four a second
  const pid_t child = start(moving);
  std::error_code none;
  std::uintmax_t size = 0;
  auto last = std::chrono::steady_clock::now();
  // The log grows after a pause of a tenth of a second: now and then for notes on the study, then for runs.
  for (int k = 0, grown = 0; k < 4000 && grown < 4; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto now = std::filesystem::file_size(folder_ / "out/samples.db-wal", none);
    if (none || now == size) continue;
    const auto at = std::chrono::steady_clock::now();
    grown += size > 0 && at - last > std::chrono::milliseconds(100);
    size = now;
    last = at;
  }
  kill(child, SIGKILL);
  ASSERT_EQ(wait_for(child).status, 128 + SIGKILL);
  EXPECT_EQ(json("out/summary.json")["verb"], "budget");
  study("", "20");
  moving = arguments({"--resume"});
  moving[7] = "perturbation";
  const Ended again = call(moving);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("of them stored already"));
}

TEST_F(BudgetProgram, OfACalibratedPosteriorSaysWhichDataItComesFrom) {
  std::filesystem::create_directories(folder_ / "calibration");
  std::ofstream(folder_ / "calibration/posterior.toml") << R"(
[[random]]
parameter = "clearance.F1.radial"
distribution = { lognormal = { median = "0.1 mm", factor = 1.05 } }
[[random]]
parameter = "clearance.F1.contact.restitution"
distribution = { uniform = { min = 0.7, max = 0.9 } }
[[correlation]]
parameters = ["clearance.F1.radial", "clearance.F1.contact.restitution"]
coefficient = 0.4
)";
  const std::string study = "format = 1\nmechanism = \"" + mechanism_ + R"("
[index]
quantity = "boresight_error"
[budget]
members = 4
posterior = "calibration/posterior.toml"
)";
  std::ofstream(folder_ / "study.toml") << study;
  ASSERT_EQ(call(arguments({"--quiet"})).status, 0);
  EXPECT_THAT(json("out/summary.json")["sources"]["P"]["what"].get<std::string>(), HasSubstr("is not known"));
  std::ofstream(folder_ / "calibration/summary.json")
      << R"({"verb": "calibrate", "study": {"file": "rig.toml", "hash": "aa11"}, "data": ["monday.csv", "friday.csv"],
             "identity": {"options": {"data": "bb22"}}})";
  ASSERT_EQ(call(arguments({"--quiet", "--resume"})).status, 0);
  EXPECT_THAT(json("out/summary.json")["sources"]["P"]["what"].get<std::string>(),
              AllOf(HasSubstr("rig.toml (aa11)"), HasSubstr("monday.csv, friday.csv (bb22)")));
  EXPECT_THAT(text("out/report.html"), HasSubstr("monday.csv"));
  EXPECT_EQ(json("out/summary.json")["contributions"][1]["name"], "calibrated parameters");  // correlated: one group
  std::ofstream(folder_ / "study.toml") << study << "[[random]]\nparameter = \"payload.mass\"\n"
                                        << "distribution = { uniform = { min = \"0 kg\", max = \"1 kg\" } }\n";
  const Ended both = call(arguments());
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("and not both"));
}

TEST_F(BudgetProgram, OfASpectrumSaysWhatTheWindowsKeepTwice) {
  const auto with = [&](const std::string& upper) {
    study("[[budget.contributor]]\nname = \"gyro\"\nspectrum = { white = \"1 arcsec^2/Hz\", upper = \"" + upper +
              "\" }\n",
          "60");
    const Ended ended = call(arguments());
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.out;
  };
  EXPECT_THAT(with("1 kHz"), Not(HasSubstr("gyro, ")));
  const auto summary = json("out/summary.json");
  ASSERT_EQ(summary["spectra"].size(), 3u);
  EXPECT_EQ(summary["spectra"][0]["index"], "APE");
  EXPECT_NEAR(summary["spectra"][0]["by_filter"].get<double>(), std::sqrt(1000.0) * M_PI / 180.0 / 3600.0, 1e-12);
  EXPECT_FALSE(summary["spectra"][1]["differs"].get<bool>());
  EXPECT_THAT(text("out/spectra.csv"),
              AllOf(HasSubstr("of,frequency,density\n"), HasSubstr("\ngyro,"), HasSubstr("\n,")));
  EXPECT_THAT(text("out/report.html"),
              AllOf(HasSubstr("Power spectral densities"), HasSubstr("What the windows keep")));
  // Five thousand samples a second hold half of this one, and a window of ten of them keeps another share of the rest.
  EXPECT_THAT(with("5 kHz"), AllOf(HasSubstr("above half the sampling's frequency"), HasSubstr("gyro, MPE: "),
                                   HasSubstr("they differ")));
}

// Twelve joints that follow one motion: their errors add up in time, and are anything but independent.
TEST_F(BudgetProgram, ClearancesThatFollowOneMotionAddUpAndRootSumSquareIsUnsafe) {
  std::ofstream(folder_ / "study.toml")
      << "format = 1\nmechanism = \"" BORESIGHT_EXAMPLES "/3-rrcpr/twelve-joints.toml\"\n"
      << "[index]\nquantity = \"position_error\"\n[budget]\nmembers = 2\nsampling = \"1 ms\"\n";
  const Ended ended = call(
      {"budget", "study.toml", "--set", "motion.duration=20ms", "--rung", "quasistatic", "--out", "out", "--quiet"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const auto summary = json("out/summary.json");
  ASSERT_EQ(summary["contributions"].size(), 13u);
  EXPECT_EQ(summary["contributions"][12]["name"], "together");
  EXPECT_NEAR(summary["contributions"][12]["share"].get<double>(), 0.0, 0.01);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_GT(summary["contributions"][k]["share"].get<double>(), 0.02);
  for (const auto& level : summary["levels"]) {
    if (level["index"] == "APE" && level["axis"] == "total" && level["interpretation"] == "mixed") {
      EXPECT_EQ(level["rule_is"], "unsafe");
    }
  }
}

TEST_F(BudgetProgram, MistakesAreOneLine) {
  study("[[budget.requirement]]\nindex = \"PDE\"\nlimit = \"1 arcsec\"\n");
  const Ended ended = call(arguments());
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("study.toml:"), HasSubstr("a separation, which PDE needs")));
}

// A record at 20 kHz of what happens at 5 kHz, in histories at 5 kHz: every sample is the same.
TEST_F(BudgetProgram, SaysThatItsHistoriesDoNotShowACourse) {
  {
    std::ofstream file(folder_ / "shake.csv");
    file << "t,x\n";
    for (int k = 0; k <= 400; ++k) file << 0.05e-3 * k << ',' << std::sin(std::numbers::pi / 2.0 * k) << '\n';
  }
  study(
      "[[budget.contributor]]\nname = \"shake\"\naxes = [\"x\"]\nmeasured = { file = \"shake.csv\", time = \"t\", "
      "columns = "
      "[\"x\"], unit = \"arcsec\" }\n");
  const Ended ended = call(arguments());
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("shake changes faster than the histories are sampled"));
}

TEST_F(BudgetProgram, SaysWhyParallelAxesLeaveNothingToBudget) {
  study("");
  std::vector<std::string> parallel = arguments();
  parallel[5] = "clearance.F1.axes=parallel";
  const Ended ended = call(parallel);
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("axes = \"free\" lets them tilt"));
}

// Six legs without any play: what is off are lengths, one known, one scattered, one that grows in time.
TEST_F(BudgetProgram, OfAMechanismWithoutPlayRunsOnTheCheapRungsAlsoWhereNothingDeviates) {
  const auto study = [&](const std::string& random) {
    std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" BORESIGHT_EXAMPLES "/hexapod/hexapod.toml\"\n"
                                          << "[index]\nquantity = \"boresight_error\"\n"
                                          << random << R"([budget]
members = 10
attribution = 6
sampling = "10 ms"
[[budget.contributor]]
name = "growing"
error = "leg1a.length"
course = "2e-5*t"
)";
  };
  const std::string random = R"([[random]]
parameter = "error.leg2a.length"
distribution = { normal = { mean = "0 um", sd = "20 um" } }
)";
  const auto levels = [&](const std::string& rung, const std::vector<std::string>& more, const std::string& out) {
    std::vector<std::string> arguments = {"budget", "study.toml", "--rung", rung, "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = call(arguments);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return json(out + "/summary.json");
  };
  study("");
  const auto alone = levels("quasistatic", {}, "alone");
  EXPECT_EQ(alone["contributions"].size(), 1u);
  EXPECT_EQ(alone["contributions"][0]["kind"], "built geometry over time");
  EXPECT_THAT(alone["rung_why"].get<std::string>(), HasSubstr("deviates by nothing"));

  study(random);
  const std::vector<std::string> known = {"--set", "error.leg3a.length=30um"};
  const auto cheap = levels("perturbation", known, "cheap"), exact = levels("multibody", known, "exact");
  ASSERT_EQ(cheap["levels"].size(), exact["levels"].size());
  for (std::size_t k = 0; k < cheap["levels"].size(); ++k)
    EXPECT_NEAR(cheap["levels"][k]["value"].get<double>(), exact["levels"][k]["value"].get<double>(), 2e-7);
  std::map<std::string, std::string> kinds;
  double share = 0.0;
  for (const auto& one : cheap["contributions"]) {
    kinds[one["name"]] = one["kind"].get<std::string>();
    share += one["share"].get<double>();
  }
  EXPECT_EQ(kinds, (std::map<std::string, std::string>{{"error.leg2a.length", "built geometry"},
                                                       {"error.leg3a.length", "known error"},
                                                       {"growing", "built geometry over time"}}));
  EXPECT_NEAR(share, 1.0, 1e-6);
}

}  // namespace budget_program_test
}  // namespace boresight::app
