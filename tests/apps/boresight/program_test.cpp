#include "program.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

namespace boresight::app {
namespace program_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ProgramTest : public Program {
 protected:
  void expect_refused(const std::vector<std::string>& arguments, const std::string& words) {
    const Ended ended = call(arguments);
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr(words));
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "results"));
  }
  // A motion of 50 ms, so that tests are quick.
  std::vector<std::string> quick(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"run", mechanism_, "--set", "motion.duration=50ms", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(ProgramTest, HelpAndVersion) {
  EXPECT_THAT(call({"--version"}).out, HasSubstr("boresight "));
  EXPECT_THAT(call({"--help"}).out, AllOf(HasSubstr("check"), HasSubstr("run"), HasSubstr("sweep")));
  for (const char* verb : {"check", "run", "sweep", "chart", "stability"}) {
    const Ended ended = call({verb, "--help"});
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.out, AllOf(HasSubstr("Example"), HasSubstr("--set"), HasSubstr("--out"), HasSubstr("--quiet")));
  }
}

TEST_F(ProgramTest, BadInputIsOneLineAndStatusTwo) {
  expect_refused({}, "expected boresight VERB FILE");
  expect_refused({"swep", "x.toml"}, "did you mean sweep?");
  expect_refused({"run"}, "FILE");
  expect_refused({"run", "nothing.toml"}, "nothing.toml");
  expect_refused({"run", mechanism_, "--colour"}, "--colour");
  expect_refused({"run", mechanism_, "--set", "clearance.F1.radiall=1mm"}, "did you mean clearance.F1.radial?");
  expect_refused({"run", mechanism_, "--set", "clearance.F1.radial"}, "PATH=VALUE");
  expect_refused({"run", mechanism_, "--set", "clearance.F1.radial=3kg"}, "clearance.F1.radial");
  expect_refused({"run", mechanism_, "--step", "1 mm"}, "--step");
  expect_refused({"run", mechanism_, "--sample", "1 ns"}, "--sample");
  expect_refused({"run", mechanism_, "--pose", "rod9"}, "did you mean rod");
  expect_refused({"run", mechanism_, "--rung", "multybody"}, "did you mean multibody?");
  expect_refused({"run", mechanism_, "--stabilisation", "baumgart"}, "did you mean baumgarte?");
  expect_refused({"run", mechanism_, "--integrator", "dopri4"}, "did you mean dopri5?");
  expect_refused({"run", mechanism_, "--integrator", "rk4", "--rung", "envelope"}, "takes no steps");
  expect_refused({"run", mechanism_, "--integrator", "generalized-alpha", "--rung", "perturbation"}, "--integrator");
  expect_refused({"run", mechanism_, "--integrator", "rk4", "--tolerance", "1e-4"}, "--tolerance");
  expect_refused({"run", mechanism_, "--integrator", "dopri5", "--tolerance", "1 mm"}, "--tolerance");
  expect_refused({"run", mechanism_, "--jobs", "-1"}, "--jobs");
  expect_refused({"sweep", mechanism_}, "expected a study file");
  expect_refused({"chart", mechanism_, "--index", "position_error.biggest"}, "--index");
  expect_refused({"chart", mechanism_, "--time", "3 kg"}, "--time");
}

TEST_F(ProgramTest, TheTerminalSaysWhatTheRungLeavesOutAndWarnsWhereItIsMuch) {
  const std::string fast = call(quick({"--rung", "perturbation"})).out;
  EXPECT_THAT(fast, AllOf(HasSubstr("what the perturbation rung leaves out is about"),
                          Not(HasSubstr("warning: position error, maximum: what the perturbation rung leaves out"))));
  // 50 ms are a blow, at which a static rung does not look.
  const Ended still =
      call({"run", mechanism_, "--set", "motion.duration=50ms", "--rung", "quasistatic", "--out", "still"});
  EXPECT_THAT(still.out, HasSubstr("warning: position error, maximum: what the quasistatic rung leaves out"));
  const std::string exact =
      call({"run", mechanism_, "--set", "motion.duration=50ms", "--rung", "multibody", "--out", "exact"}).out;
  EXPECT_THAT(exact, Not(HasSubstr("leaves out")));
}

TEST_F(ProgramTest, AnOptionThatAVerbHasNoUseForIsRefusedByItsName) {
  expect_refused({"stability", mechanism_, "--rung", "multibody"}, "--rung is not an option of stability, but of run");
  expect_refused({"check", mechanism_, "--accuracy", "1 %", "--quiet"}, "--accuracy is not an option of check");
  expect_refused({"chart", mechanism_, "--rung", "multibody"}, "--rung is not an option of chart");
  expect_refused({"laws", mechanism_, "--accuracy=1 %"}, "--accuracy is not an option of laws");
  expect_refused({"calibrate", mechanism_, "--rung", "auto"}, "--rung is not an option of calibrate");
  expect_refused({"export", ".", "--set", "payload.mass=1kg"}, "--set is not an option of export");
  expect_refused({"new", "antenna", "--out", "there"}, "--out is not an option of new");
  expect_refused({"run", mechanism_, "--resum"}, "--resum is not an option of run");
  expect_refused({"montecarlo", mechanism_, "--resum"}, "did you mean --resume?");
  expect_refused({"run", mechanism_, "another.toml"}, "found \"another.toml\", expected no further argument");
}

TEST_F(ProgramTest, AnUnknownFormulationIsBadInput) {
  const Ended ended = call(quick({"--formulation", "newspaper"}));
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("newspaper"));
}

TEST_F(ProgramTest, ARunLeavesWhatTheInterfacePromises) {
  const Ended ended = call(quick({"--pose", "rod1"}));
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_THAT(ended.out, AllOf(HasSubstr("position error"), HasSubstr("out/report.html")));
  EXPECT_THAT(files("out"), ElementsAre("events.csv", "report.html", "report.json", "summary.json", "timeseries.csv"));
  EXPECT_THAT(text("out/report.html"), AllOf(HasSubstr("\"kind\":\"view\""), HasSubstr("boresight of ")));
  const auto summary = json("out/summary.json");
  for (const char* key : {"verb", "mechanism", "version", "rung", "seed", "cpu_seconds", "wall_seconds", "warnings",
                          "index", "contact", "platform_acceleration_max", "constraint_drift"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary["verb"], "run");
  EXPECT_FALSE(summary["interrupted"].get<bool>());
  for (const char* quantity : {"position_error", "orientation_error", "boresight_error", "line_of_sight_error"})
    for (const char* statistic : {"max", "rms", "mean", "p99.73"})
      EXPECT_TRUE(summary["index"][quantity][statistic].is_number()) << quantity;
  for (const char* key : {"contact_fraction", "impacts", "max_penetration", "max_force", "impact_speed_above_validity"})
    EXPECT_TRUE(summary["contact"]["F1"][key].is_number()) << key;
  EXPECT_GT(summary["index"]["position_error"]["max"].get<double>(), 1e-5);
  const std::string table = text("out/timeseries.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')).substr(0, 75),
            "t,dx,dy,dz,rx,ry,rz,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,ax,ay,az,F1.offset_");
  EXPECT_NEAR(static_cast<double>(std::count(table.begin(), table.end(), '\n')), 52.0,
              1.0);  // header, 0 to 50 ms
}

TEST_F(ProgramTest, TheSameRunAgainIsFineAndAnotherIsRefused) {
  EXPECT_EQ(call(quick({"--quiet"})).status, 0);
  EXPECT_EQ(call(quick({"--quiet"})).status, 0);
  const Ended other = call(quick({"--quiet", "--set", "payload.mass=5kg"}));
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(is_one_line(other.err)) << other.err;
  EXPECT_EQ(call(quick({"--quiet", "--step", "50 us"})).status, 2);
}

TEST_F(ProgramTest, QuietSaysNothing) {
  const Ended ended = call(quick({"--quiet"}));
  EXPECT_EQ(ended.out + ended.err, "");
}

TEST_F(ProgramTest, QuietStillSaysWhyPointsFailed) {
  write("sweep.toml",
        "format = 1\nmechanism = \"" + mechanism_ +
            "\"\n[sweep]\n[[sweep.axis]]\nparameter = \"clearance.F1.radial\"\nvalues = [\"0.1 mm\", \"0.2 mm\"]\n");
  const Ended ended = call(
      {"sweep", "sweep.toml", "--quiet", "--rung", "multibody", "--step", "1 ms", "--set", "motion.duration=200ms"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_EQ(ended.out, "");
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("2 of 2 points failed, the first: step too large"));
}

TEST_F(ProgramTest, AStepTooLargeNamesContactFrequencyAndLargestStep) {
  const Ended ended = call(quick({"--step", "1 ms"}));
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("F1"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/summary.json"));
}

TEST_F(ProgramTest, CheckPassesTheDefaultMechanism) {
  const Ended ended = call({"check", mechanism_});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const auto summary = json("results/3-rrcpr-check/summary.json");
  EXPECT_EQ(summary["kinematics"]["mobility"], 6);
  EXPECT_TRUE(summary["findings"].empty());
  EXPECT_GT(summary["contacts"]["F1"]["largest_stable_step"].get<double>(), 1e-5);
}

TEST_F(ProgramTest, CheckNamesTheLostMotionOfASingularMechanismAndAnswersNo) {
  // The A axes laid into one plane (eta = 0): at home nothing holds the platform's turn about z.
  std::string file = [this] {
    std::ifstream in(mechanism_);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  const auto replace = [&](const std::string& what, const std::string& with) {
    ASSERT_NE(file.find(what), std::string::npos) << what;
    for (std::size_t at = 0; (at = file.find(what, at)) != std::string::npos; at += with.size())
      file.replace(at, what.size(), with);
  };
  replace("axis = [0.816496580927726, 0, -0.5773502691896258]", "axis = [1, 0, 0]");
  replace("axis = [0.5773502691896258, 0, 0.816496580927726]", "axis = [0, 0, 1]");
  replace("point = [\"100 mm\", \"0 mm\", \"-70.71067811865476 mm\"]", "point = [\"100 mm\", \"0 mm\", \"0 mm\"]");
  replace("axis = [0.352643299482912, 0, 0.9357578230128805]", "axis = [200, 0, 460]");
  write("flat.toml", file);
  const Ended ended = call({"check", "flat.toml"});
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("\"platform\" turns about (0, 0, 1)"));
  const auto summary = json("results/flat-check/summary.json");
  EXPECT_THAT(summary["findings"][0].get<std::string>(), HasSubstr("turns about (0, 0, 1)"));
}

TEST_F(ProgramTest, LawsPrintsTheTableWithAndWithoutAMechanism) {
  const Ended plain = call({"laws", "--out", "plain"});
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_THAT(plain.out, AllOf(HasSubstr("lankarani-nikravesh"), HasSubstr("0.91318"), HasSubstr("lugre")));
  EXPECT_THAT(files("plain"), ElementsAre("force.csv", "friction.csv", "report.html", "report.json", "restitution.csv",
                                          "summary.json"));
  const Ended of_joint = call({"laws", mechanism_, "--out", "joint"});
  EXPECT_EQ(of_joint.status, 0) << of_joint.err;
  const auto summary = json("joint/summary.json");
  EXPECT_NEAR(summary["contact_laws"]["flores"]["returned"]["0.9"].get<double>(), 0.89392, 2e-5);
  EXPECT_THAT(summary["warnings"][0].get<std::string>(), AllOf(HasSubstr("flores"), HasSubstr("johnson fits")));
  expect_refused({"laws", mechanism_, "--joint", "F2", "--out", "other"}, "F1");
  expect_refused({"laws", "--set", "gravity.z=0m/s^2", "--out", "other"}, "boresight laws MECHANISM");
}

TEST_F(ProgramTest, RunWarnsOfALawOutsideOfItsRangeAndNamesOneThatFits) {
  const Ended ended =
      call({"run", mechanism_, "--rung", "quasistatic", "--set", "clearance.F1.radial=20um", "--out", "tight"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("outside of its range"), HasSubstr("fits")));
}

TEST_F(ProgramTest, NonlinearToolsAreInTheReportTheSummaryAndATable) {
  const Ended ended =
      call({"run", BORESIGHT_EXAMPLES "/spatial-double-crank/spatial-double-crank.toml", "--rung", "perturbation",
            "--set", "motion.duration=5s", "--nonlinear", "0.5 s", "--sample", "5 ms", "--out", "map"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const auto nonlinear = json("map/summary.json")["nonlinear"];
  EXPECT_EQ(nonlinear["periods"], 10);
  EXPECT_TRUE(nonlinear["joints"]["D"]["lyapunov"].contains("value"));
  EXPECT_THAT(text("map/report.html"), HasSubstr("Phase portrait"));
  const std::string table = text("map/poincare.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 9);  // two of ten periods left out, both ends counted
  expect_refused({"run", mechanism_, "--nonlinear", "0.5 s", "--out", "short"}, "ten or more");
}

TEST_F(ProgramTest, OtherMechanismsRun) {
  for (const std::string name :
       {"crank-slider", "four-bar", "3-rrr", "spatial-slider-crank", "spatial-double-crank", "2-us-pointing"}) {
    const Ended ended = call({"run", BORESIGHT_EXAMPLES "/" + name + "/" + name + ".toml", "--quiet"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_GT(json("results/" + name + "-run/summary.json")["index"]["position_error"]["max"].get<double>(), 0.0);
  }
}

TEST_F(ProgramTest, ASweepHasARowPerPointWhateverTheJobs) {
  write("study.toml", "format = 1\nmechanism = \"" + mechanism_ +
                          "\"\n[sweep]\nfindings = \"sun-3-rrcpr\"\n[[sweep.axis]]\n"
                          "parameter = [\"clearance.F1.radial\", \"clearance.F1.axial\"]\nvalues = [\"0.1 "
                          "mm\", \"0.2 mm\", \"0.3 mm\"]\n");
  const Ended ended = call({"sweep", "study.toml", "--set", "motion.duration=50ms", "--jobs", "2"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(files("results/study-sweep"), ElementsAre("report.html", "report.json", "summary.json", "sweep.csv"));
  std::istringstream table(text("results/study-sweep/sweep.csv"));
  std::vector<std::string> rows;
  for (std::string row; std::getline(table, row);) rows.push_back(row);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_THAT(rows[0], testing::StartsWith("point,clearance.F1.radial,clearance.F1.axial,position_error.max,"));
  EXPECT_THAT(rows[3], testing::EndsWith(",done,0"));
  const auto summary = json("results/study-sweep/summary.json");
  EXPECT_EQ(summary["points"].size(), 3u);
  EXPECT_EQ(summary["points"][1]["index"]["position_error"]["max"], summary["index"]["values"][1]);
  EXPECT_THAT(text("results/study-sweep/report.html"), HasSubstr("What the paper found"));
}

TEST_F(ProgramTest, StabilityLeavesMapsAndCasesWithTheLimitsOfTheory) {
  const Ended ended = call({"stability", mechanism_, "--set", "motion.duration=50ms", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("step limit 2.8284 measured"), HasSubstr("Grazing and chatter"),
                               HasSubstr("out/report.html")));
  EXPECT_THAT(files("out"), ElementsAre("baumgarte.csv", "cases.csv", "growth.csv", "horizon.csv", "limits.csv",
                                        "report.html", "report.json", "steps.csv", "summary.json"));
  const auto summary = json("out/summary.json");
  EXPECT_EQ(summary["cases"].size(), 11u);
  EXPECT_LT(summary["largest_difference_from_theory"].get<double>(), 0.02);
  EXPECT_EQ(summary["baumgarte"]["limits"].size(), 14u);
  // The reader's own refusal of a restitution of zero stands in the case.
  EXPECT_THAT(text("out/cases.csv"), HasSubstr("laws that take 0: hunt-crossley"));
  EXPECT_THAT(text("out/report.html"), HasSubstr("Where methods and models fail"));
}

TEST_F(ProgramTest, AChartOfAStudyTakesItsIndexAndItsAccuracy) {
  write("study.toml", "format = 1\nmechanism = \"" + mechanism_ +
                          "\"\naccuracy = \"20 %\"\n[index]\nquantity = \"position_error\"\nstatistic = \"rms\"\n");
  const Ended ended = call({"chart", "study.toml", "--set", "motion.duration=50ms", "--time", "1 s", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("position error, RMS"), HasSubstr("Pareto front"),
                               HasSubstr("the setting of Sun, Song and Wang"), HasSubstr("cheapest within 20 %")));
  EXPECT_THAT(files("out"), ElementsAre("chart.csv", "flight.csv", "report.html", "report.json", "summary.json"));
  const auto summary = json("out/summary.json");
  EXPECT_EQ(summary["papers"]["way"], "multibody, paper, baumgarte, rk4");
  EXPECT_GT(summary["reference"]["uncertainty"].get<double>(), 0.0);
  EXPECT_FALSE(summary["machine"]["processor"].get<std::string>().empty());
  EXPECT_FALSE(summary["cheapest_within_accuracy"].is_null());
  EXPECT_THAT(text("out/report.html"), HasSubstr("Trajectory error before the first impact"));
  EXPECT_THAT(ended.out, HasSubstr("next: boresight run " + mechanism_));  // which `run` takes, and no study
  expect_refused({"chart", "study.toml", "--index", "boresight_error.rms"}, "a study says itself what is asked");
}

TEST_F(ProgramTest, NamesThatNoFileSystemTakesAreTheUsersMistake) {
  const std::string longer(300, 'a');
  expect_refused({"new", longer}, "cannot make this folder");
  expect_refused({"export", longer}, "a folder of results");
}

TEST_F(ProgramTest, LawsWithoutAMechanismNamesACommandThatCanBeTyped) {
  const Ended ended = call({"laws", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("next: boresight run MECHANISM.toml --set"));
}

TEST_F(ProgramTest, TwoStartsOfTheProgramGiveTheSameBytes) {
  const auto started = [&](const std::string& out) {
    EXPECT_EQ(call({"run", mechanism_, "--set", "motion.duration=50ms", "--out", out, "--quiet"}).status, 0);
    return text(out + "/timeseries.csv") + text(out + "/events.csv");
  };
  const std::string first = started("first");
  for (const char* again : {"second", "third", "fourth"}) EXPECT_TRUE(started(again) == first);
}

}  // namespace program_test
}  // namespace boresight::app
