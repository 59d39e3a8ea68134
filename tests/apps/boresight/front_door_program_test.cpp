// What a newcomer meets first: files to start from, completion, machine-readable answers, plain text in pipes.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "program.hpp"

namespace boresight::app {
namespace front_door_program_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using FrontDoor = Program;

TEST_F(FrontDoor, NewFilesCheckRunAndScatterAsTheyStand) {
  const Ended made = call({"new", "mine"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("boresight check mine/mechanism.toml"), HasSubstr("montecarlo.toml")));
  EXPECT_EQ(call({"check", "mine/mechanism.toml"}).status, 0);
  EXPECT_EQ(call({"run", "mine/mechanism.toml", "--out", "run"}).status, 0);
  EXPECT_GT(json("run/summary.json")["index"]["boresight_error"]["max"].get<double>(), 1e-5);
  const Ended scattered = call({"montecarlo", "mine/montecarlo.toml", "--rung", "perturbation", "--out", "scatter"});
  EXPECT_EQ(scattered.status, 0) << scattered.err;
  EXPECT_EQ(json("scatter/summary.json")["failed"], 0);
  // The study writes its limit in arcsec, and reads its answer in arcsec.
  EXPECT_THAT(scattered.out,
              AllOf(HasSubstr("at or below 30 arcsec in 95 %"), HasSubstr("p95 "), Not(HasSubstr("rad "))));
}

// What run says of a material that nobody gave, every verb says that computes with it, and once.
TEST_F(FrontDoor, EveryVerbSaysWhichMaterialItTookForGranted) {
  std::string mechanism;
  {
    std::ifstream in(mechanism_);
    for (std::string line; std::getline(in, line);)
      if (line.find("young = ") == std::string::npos) mechanism += line + "\n";
  }
  std::ofstream(folder_ / "bare.toml") << mechanism;
  std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"bare.toml\"\n[[sweep.axis]]\n"
                                           "parameter = \"clearance.F1.radial\"\nvalues = [\"0.1 mm\", \"0.2 mm\"]\n";
  for (const char* verb : {"run", "sweep"}) {
    const Ended ended = call({verb, std::string(verb) == "run" ? "bare.toml" : "study.toml", "--rung", "quasistatic",
                              "--set", "motion.duration=20ms", "--out", verb});
    EXPECT_EQ(ended.status, 0) << ended.err;
    const std::size_t first = ended.out.find("not given, so assumed");
    EXPECT_NE(first, std::string::npos) << verb << ": " << ended.out;
    EXPECT_EQ(ended.out.find("not given, so assumed", first + 1), std::string::npos) << verb;
  }
}

TEST_F(FrontDoor, NewOverwritesNothing) {
  std::filesystem::create_directory(folder_ / "mine");
  std::ofstream(folder_ / "mine/montecarlo.toml") << "precious";
  const Ended refused = call({"new", "mine"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(is_one_line(refused.err)) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("mine/montecarlo.toml"));
  EXPECT_EQ(text("mine/montecarlo.toml"), "precious");
  EXPECT_EQ(files("mine").size(), 1u);
}

TEST_F(FrontDoor, JsonIsTheSummaryAndNothingElse) {
  const Ended ended = call({"check", mechanism_, "--json", "--out", "out"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(nlohmann::json::parse(ended.out), json("out/summary.json"));
  EXPECT_EQ(ended.err, "");
}

TEST_F(FrontDoor, CheckOfASoundMechanismCallsNothingSingular) {
  ASSERT_EQ(call({"new", "mine"}).status, 0);
  ASSERT_EQ(call({"check", "mine/mechanism.toml", "--out", "out"}).status, 0);
  const std::string report = text("out/report.html");
  EXPECT_THAT(report, AllOf(HasSubstr("Nothing stands in the way"), HasSubstr("Distance from losing a motion"),
                            Not(HasSubstr("0 singular")), Not(HasSubstr("Worst conditioning"))));
}

TEST_F(FrontDoor, PipesGetNoColourAndNoCarriageReturns) {
  const Ended ended = call({"run", "missing.toml"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, AllOf(Not(HasSubstr("\033")), Not(HasSubstr("\r"))));
}

TEST_F(FrontDoor, CompletionInBashOffersVerbsOptionsAndRungs) {
  const Ended script = call({"completion", "bash"});
  ASSERT_EQ(script.status, 0) << script.err;
  std::ofstream(folder_ / "completion.sh") << script.out << R"(
COMP_WORDS=(boresight mon); COMP_CWORD=1; _boresight; echo "${COMPREPLY[@]}"
COMP_WORDS=(boresight run --comp); COMP_CWORD=2; _boresight; echo "${COMPREPLY[@]}"
COMP_WORDS=(boresight run --rung per); COMP_CWORD=3; _boresight; echo "${COMPREPLY[@]}"
)";
  ASSERT_EQ(std::system(("cd '" + folder_.string() + "' && bash completion.sh > offered.txt 2>&1").c_str()), 0);
  EXPECT_EQ(text("offered.txt"), "montecarlo\n--compare\nperturbation\n");
}

TEST_F(FrontDoor, CompletionForAnUnknownShellNamesTheKnownOnes) {
  const Ended refused = call({"completion", "zhs"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("bash, zsh or fish"), HasSubstr("zsh?")));
}

}  // namespace front_door_program_test
}  // namespace boresight::app
