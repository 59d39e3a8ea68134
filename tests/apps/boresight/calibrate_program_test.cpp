// boresight calibrate, as a user calls it.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

namespace boresight::app {
namespace calibrate_program_test {

const std::string kExample = BORESIGHT_EXAMPLES "/calibration/";

class CalibrateProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    for (const char* file : {"calibrate.toml", "rig.toml", "slow.csv", "middle.csv", "fast.csv"})
      std::filesystem::copy_file(kExample + file, folder_ / file);
  }
};

TEST_F(CalibrateProgram, LongRecoversTheExamplesTruthAndItsPosteriorFeedsMonteCarlo) {
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out", "--quiet", "--jobs", "2"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const nlohmann::json summary = json("out/summary.json");
  EXPECT_TRUE(summary["converged"].get<bool>());
  EXPECT_NEAR(summary["optimum"]["clearance.D.radial"].get<double>(), 2e-4, 2e-6);
  EXPECT_NEAR(summary["optimum"]["clearance.D.friction.coefficient"].get<double>(), 0.1, 0.01);
  EXPECT_NEAR(summary["optimum"]["bias.dx"].get<double>(), 5e-6, 5e-7);
  for (const char* path : {"clearance.D.radial", "clearance.D.contact.restitution"}) {
    EXPECT_TRUE(summary["identifiable"][path]["value"].get<bool>());
    EXPECT_GT(summary["standard_error"][path].get<double>(), 0.0);
    EXPECT_LT(summary["interval"][path]["low"].get<double>(), summary["interval"][path]["high"].get<double>());
    EXPECT_NEAR(summary["correlation"][path][path].get<double>(), 1.0, 1e-9);
  }
  std::ofstream(folder_ / "scatter.toml") << "format = 1\nmechanism = \"rig.toml\"\n"
                                          << text("out/posterior.toml") << "\n[montecarlo]\nsamples = 20\n";
  const Ended scatter = call({"montecarlo", "scatter.toml", "--rung", "perturbation", "--out", "mc", "--quiet"});
  EXPECT_EQ(scatter.status, 0) << scatter.err;
}

TEST_F(CalibrateProgram, RefusesAPlayThatAnotherBearingHolds) {
  std::string rig = text("rig.toml");
  rig.insert(rig.find("[initial]"),
             "[[joint]]\nname = \"D2\"\ntype = \"revolute\"\nconnects = [\"ground\", \"rocker\"]\n"
             "point = [\"190 mm\", \"100 mm\", \"0 mm\"]\naxis = [1, 0, 0]\n\n");
  std::ofstream(folder_ / "rig.toml") << rig;
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("\"D\" cannot move: \"D2\" holds"), std::string::npos) << ended.err;
}

TEST_F(CalibrateProgram, NamesTheLineOfABadRow) {
  std::ofstream(folder_ / "middle.csv") << "t [s], dx [um]\n0, 1\n0.001, l.5\n";
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("middle.csv:3: dx"), std::string::npos) << ended.err;
}

// One parameter, one run: a second or two.
const char* const kSmall = R"(format = 1
mechanism = "rig.toml"
[calibrate]
starts = 1
mounting_bias = true
corrections = 1
profile = false
[[calibrate.parameter]]
path = "clearance.D.radial"
start = "0.24 mm"
[[calibrate.run]]
data = "slow.csv"
set = ["motion.drives.A=2*pi*2*t"]
)";

TEST_F(CalibrateProgram, AnImpossibleReadingIsNamedAndMovesNothing) {
  std::ofstream(folder_ / "small.toml") << kSmall;
  ASSERT_EQ(call({"calibrate", "small.toml", "--out", "clean", "--quiet"}).status, 0);
  EXPECT_EQ(json("clean/summary.json")["warnings"].size(), 0u) << "good data get no word";
  std::string rows = text("slow.csv"), changed;
  std::istringstream lines(rows);
  int number = 0;
  for (std::string line; std::getline(lines, line);)
    changed +=
        (++number == 60 ? line.substr(0, line.find(',')) + ",1e8" + line.substr(line.find(',', line.find(',') + 1))
                        : line) +
        "\n";
  std::ofstream(folder_ / "slow.csv") << changed;
  ASSERT_EQ(call({"calibrate", "small.toml", "--out", "spoilt", "--quiet"}).status, 0);
  const nlohmann::json clean = json("clean/summary.json"), spoilt = json("spoilt/summary.json");
  ASSERT_EQ(spoilt["warnings"].size(), 1u) << spoilt["warnings"];
  const std::string warning = spoilt["warnings"][0];
  EXPECT_NE(warning.find("slow.csv:60: dx is "), std::string::npos) << warning;
  EXPECT_NE(warning.find("robust standard deviations off: it is left out of the fit"), std::string::npos) << warning;
  for (const auto& [name, error] : clean["standard_error"].items()) {
    const double sd = error.get<double>();
    // What is fitted along by what is known of it, the clock, takes its error from how far the motion jumps, which each reading has a part in.
    if (name.starts_with("clearance.")) {
      EXPECT_NEAR(spoilt["standard_error"][name].get<double>(), sd, 0.05 * sd) << name;
    }
    // A mass that is fitted beside: its optimum is one of several that jumps of the motion leave, about half its error apart; a reading that changes
    // by a ten-thousandth of itself leads to another one too.
    const double share = name.starts_with("body.") ? 1.0 : 0.5;
    EXPECT_NEAR(spoilt["optimum"][name].get<double>(), clean["optimum"][name].get<double>(), share * sd) << name;
  }
}

TEST_F(CalibrateProgram, AnInterruptionAnnouncesOnlyWhatIsThere) {
  for (const int milliseconds : {300, 900, 2000}) {
    const std::string out = "out-" + std::to_string(milliseconds);
    const pid_t child = start({"calibrate", "calibrate.toml", "--out", out});
    ::usleep(static_cast<useconds_t>(1000 * milliseconds));
    ::kill(child, SIGINT);
    const Ended ended = wait_for(child);
    EXPECT_EQ(ended.status, 130) << ended.err;
    for (const char* file : {"posterior.toml", "report.html"})
      EXPECT_EQ(ended.out.find(file) != std::string::npos, std::filesystem::exists(folder_ / out / file))
          << file << ended.out;
    if (std::filesystem::exists(folder_ / out / "posterior.toml")) {
      EXPECT_NE(text(out + "/posterior.toml").find("\ninterrupted = true\n"), std::string::npos);
    }
    if (!std::filesystem::exists(folder_ / out / "summary.json")) continue;
    const auto summary = json(out + "/summary.json");
    if (!summary.contains("files")) continue;  // nothing was fitted yet
    for (const auto& file : summary["files"])
      EXPECT_TRUE(std::filesystem::exists(folder_ / out / file.get<std::string>())) << file;
  }
}

TEST_F(CalibrateProgram, SyntheticDataOverwriteSyntheticDataAlone) {
  std::ofstream(folder_ / "small.toml") << kSmall;
  const auto made = [&](const char* seed) {
    return call({"calibrate", "small.toml", "--make-data", "1 %", "--make-seed", seed});
  };
  // The example's are synthetic, and known as such.
  ASSERT_EQ(made("1").status, 0);
  const std::string first = text("slow.csv");
  ASSERT_EQ(made("2").status, 0);
  EXPECT_NE(text("slow.csv"), first);
  // What somebody changed is no longer what it wrote, and nor is what somebody measured.
  const std::string measured = "t [s], dx [um]\n0, 1\n0.001, 2\n";
  for (const std::string& there :
       {first + "# of Monday\n", first.substr(0, 200) + "9" + first.substr(201), measured, std::string()}) {
    std::ofstream(folder_ / "slow.csv") << there;
    const Ended refused = made("2");
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(is_one_line(refused.err)) << refused.err;
    EXPECT_NE(refused.err.find("slow.csv: is there already, and not as --make-data wrote it"), std::string::npos)
        << refused.err;
    EXPECT_EQ(text("slow.csv"), there);
  }
  std::filesystem::remove(folder_ / "slow.csv");
  ASSERT_EQ(made("1").status, 0);
  EXPECT_EQ(text("slow.csv"), first);
  EXPECT_EQ(call({"calibrate", "small.toml", "--out", "out", "--quiet"}).status, 0);
}

// None of three files is written where one of them may not be.
TEST_F(CalibrateProgram, SyntheticDataAreWrittenForAllRunsOrForNone) {
  const std::string slow = text("slow.csv");
  std::ofstream(folder_ / "fast.csv") << "t [s], dx [um]\n0, 1\n0.001, 2\n";
  EXPECT_EQ(call({"calibrate", "calibrate.toml", "--make-data", "1 %", "--make-seed", "3"}).status, 2);
  EXPECT_EQ(text("slow.csv"), slow);
}

// The altitude-azimuth mount of the examples.
class CalibrateErrorsProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    for (const char* file : {"altaz-gimbal.toml", "calibrate.toml", "stars.csv"})
      std::filesystem::copy_file(std::string(BORESIGHT_EXAMPLES "/altaz-gimbal/") + file, folder_ / file);
  }
  // The study with other words in it.
  void change(const std::string& from, const std::string& to) {
    std::string study = text("calibrate.toml");
    const std::size_t at = study.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(folder_ / "calibrate.toml") << study.replace(at, from.size(), to);
  }
};

TEST_F(CalibrateErrorsProgram, FindsTheExamplesErrorsAndShowsThemAsTyped) {
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const nlohmann::json summary = json("out/summary.json");
  const double arcsec = M_PI / 648000.0;
  const std::pair<const char*, double> made[] = {{"IA", 60.0},
                                                 {"IE", -40.0},
                                                 {"CA", 25.0},
                                                 {"NPAE", -15.0},
                                                 {"AN", 20.0},
                                                 {"AW", -30.0},
                                                 {"azimuth.eccentricity_sine", 4.0},
                                                 {"azimuth.eccentricity_cosine", -2.0}};
  for (const auto& [name, value] : made) {
    const std::string path = std::string("error.") + name;
    const double error = summary["standard_error"][path].get<double>();
    EXPECT_NEAR(summary["optimum"][path].get<double>(), value * arcsec, 3.0 * error) << path;
    EXPECT_LT(error, 3.0 * arcsec) << path;
  }
  EXPECT_EQ(summary["rung"], "multibody");
  EXPECT_EQ(summary["combinations"].size(), 0u);
  EXPECT_NE(ended.out.find("error.IE: -40.2 arcsec ± 0.16"), std::string::npos) << ended.out;
  EXPECT_EQ(summary["next_tests"].size(), 2u);
  std::ofstream(folder_ / "scatter.toml") << "format = 1\nmechanism = \"altaz-gimbal.toml\"\n"
                                          << text("out/posterior.toml") << "\n[montecarlo]\nsamples = 5\n";
  EXPECT_EQ(call({"montecarlo", "scatter.toml", "--rung", "quasistatic", "--out", "mc", "--quiet"}).status, 0);
}

TEST_F(CalibrateErrorsProgram, NamesCombinationsThatTheDataKnow) {
  const std::vector<std::string> level = {"--set", "motion.drives.elevation=pi/4"};
  std::vector<std::string> make = {"calibrate", "calibrate.toml", "--make-data", "1 arcsec", "--make-samples", "40"};
  make.insert(make.end(), level.begin(), level.end());
  ASSERT_EQ(call(make).status, 0);
  std::vector<std::string> fit = {"calibrate", "calibrate.toml", "--out", "out"};
  fit.insert(fit.end(), level.begin(), level.end());
  const Ended ended = call(fit);
  EXPECT_EQ(ended.status, 1) << ended.err;
  const nlohmann::json summary = json("out/summary.json");
  ASSERT_GE(summary["combinations"].size(), 1u) << ended.out;
  const nlohmann::json group = summary["combinations"][0];
  EXPECT_GE(group["errors"].size(), 3u);
  EXPECT_EQ(group["known"][0]["unit"], "rad");
  EXPECT_NE(ended.out.find("move the boresight alike in these data"), std::string::npos) << ended.out;
  EXPECT_TRUE(summary["optimum"]["error.IA"].is_null());
  EXPECT_FALSE(summary["optimum"]["error.IE"].is_null());
  EXPECT_NE(text("out/report.html").find("What is known of errors that cannot be told apart"), std::string::npos);
}

TEST_F(CalibrateErrorsProgram, MakesTheExamplesDataAnew) {
  const std::string stars = text("stars.csv");
  const auto made = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"calibrate", "calibrate.toml", "--make-data", "1 arcsec", "--make-seed", "3"};
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  };
  ASSERT_EQ(made({"--make-samples", "50"}).status, 0);
  EXPECT_EQ(text("stars.csv"), stars);
  ASSERT_EQ(made({"--make-samples", "50", "--make-channels", "rx,rz"}).status, 0);
  EXPECT_EQ(text("stars.csv").substr(0, 30), "t [s], rx [urad], rz [urad]\n0.");
  for (const auto& [channels, word] : {std::pair{"dx", "--make-data"}, {"bq", "--make-channels"}, {"bx,bx", "twice"}}) {
    const Ended refused = made({"--make-samples", "50", "--make-channels", channels});
    EXPECT_EQ(refused.status, 2) << channels;
    EXPECT_TRUE(is_one_line(refused.err)) << refused.err;
    EXPECT_NE(refused.err.find(word), std::string::npos) << refused.err;
  }
}

TEST_F(CalibrateErrorsProgram, RefusesWhatMakesNoSenseOfErrors) {
  const auto refused = [&](const std::string& word) {
    const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find(word), std::string::npos) << ended.err;
  };
  const std::string study = text("calibrate.toml");
  change("start = \"0 arcsec\"", "start = \"0 arcsec\"\nprior = \"-1 arcsec\"");
  refused("prior");
  std::ofstream(folder_ / "calibrate.toml") << study;
  change("path = \"error.IA\"", "path = \"error.IAA\"");
  refused("error.IA");
  std::ofstream(folder_ / "calibrate.toml") << study;
  change("path = \"error.IA\"", "path = \"gravity.z\"");
  refused("a standing error");
  std::ofstream(folder_ / "calibrate.toml") << study;
  change("loss = \"huber\"", "laws = [\"hertz\"]\nloss = \"huber\"");
  refused("laws");
  std::ofstream(folder_ / "calibrate.toml") << study;
  std::ofstream(folder_ / "stars.csv") << "t [s], boresight_error [arcsec]\n1, 60\n2, 61\n3, 70\n";
  refused("sign");
}

TEST_F(CalibrateProgram, NamesTheNearestChannel) {
  std::ofstream(folder_ / "middle.csv") << "t [s], boresigth_error [urad]\n0, 1\n";
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("boresight_error"), std::string::npos) << ended.err;
}

}  // namespace calibrate_program_test
}  // namespace boresight::app
