// Files that hold what they should not: too much, control characters, names that are commands; and the line that is to blame.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

#include "program.hpp"

namespace boresight::app {
namespace untrusted_input_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class UntrustedInputTest : public Program {
 protected:
  // The example's mechanism with one text put in place of another.
  void write_mechanism(const std::string& name, const std::string& from, const std::string& to) const {
    std::string content = text_of(mechanism_);
    const std::size_t at = content.find(from);
    ASSERT_NE(at, std::string::npos);
    write(name, content.replace(at, from.size(), to));
  }
  static std::string text_of(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void expect_fault(const std::vector<std::string>& arguments, const testing::Matcher<const std::string&>& said) const {
    const Ended ended = call(arguments);
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_THAT(ended.err, said);
  }
  std::string study(const std::string& rest) const { return "format = 1\nmechanism = \"" + mechanism_ + "\"\n" + rest; }
};

TEST_F(UntrustedInputTest, AFaultOfTheFileThatAStudyNamesIsToldWithTheStudysLine) {
  write("study.toml", "format = 1\nmechanism = \"gone.toml\"\n");
  expect_fault({"sweep", "study.toml"}, AllOf(HasSubstr("study.toml:2: mechanism: found \"gone.toml\", no such file")));
  write("broken.toml", "format = 1\nname = [\n");
  write("study.toml", "format = 1\nmechanism = \"broken.toml\"\n");
  for (const char* verb : {"sweep", "montecarlo", "calibrate", "chart"})
    expect_fault({verb, "study.toml"},
                 AllOf(HasSubstr("broken.toml:"), HasSubstr("(mechanism in study.toml:2 names this file)")));
}

TEST_F(UntrustedInputTest, EndlessFilesAreRefused) {
  write("study.toml", "format = 1\nmechanism = \"/dev/zero\"\n");
  expect_fault({"sweep", "study.toml"},
               HasSubstr("study.toml:2: mechanism: found \"/dev/zero\", a file of more than 16 MiB"));
  write("study.toml", study("[calibrate]\n[[calibrate.parameter]]\npath = "
                            "\"clearance.F1.radial\"\n[[calibrate.run]]\ndata = \"/dev/zero\"\n"));
  expect_fault({"calibrate", "study.toml"}, AllOf(HasSubstr("/dev/zero:1: found a character zero"),
                                                  HasSubstr("(data in study.toml:7 names this file)")));
  write("study.toml", study("[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { empirical = { file = "
                            "\"/dev/zero\", column = \"x\", unit = "
                            "\"mm\" } }\n[montecarlo]\nsamples = 10\n"));
  expect_fault({"montecarlo", "study.toml"}, AllOf(HasSubstr("study.toml:5"), HasSubstr("a character zero in line 1")));
}

TEST_F(UntrustedInputTest, AnEmptyNameIsTheUsersFault) {
  write_mechanism("m.toml", "name = \"3-RRCPR parallel pointing mechanism\"", "name = \"\"");
  expect_fault({"check", "m.toml"}, AllOf(HasSubstr("m.toml:"), HasSubstr("name: found \"\"")));
  write("study.toml", study("[calibrate]\n[[calibrate.parameter]]\npath = "
                            "\"clearance.F1.radial\"\n[[calibrate.run]]\ndata = \"a.csv\"\nname = \"\"\n"));
  expect_fault({"calibrate", "study.toml"}, HasSubstr("study.toml:8: calibrate.run[1].name: found \"\""));
  // The key that is in the file, and not the one that it stands in for.
  write("study.toml", study("[calibrate]\n[[calibrate.parameter]]\npath = "
                            "\"clearance.F1.radial\"\n[[calibrate.run]]\ndata = \"\"\n"));
  expect_fault({"calibrate", "study.toml"}, HasSubstr("study.toml:7: calibrate.run[1].data: found \"\""));
}

TEST_F(UntrustedInputTest, NoControlCharacterOfAFileReachesTheTerminal) {
  write_mechanism("m.toml", "name = \"3-RRCPR parallel pointing mechanism\"",
                  "name = \"\\u001b]0;owned\\u0007 \\u009b31m\"");
  const Ended ended = call({"run", "m.toml", "--set", "motion.duration=10ms", "--step-error", "off", "--out", "out"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("\\x1b]0;owned\\x07"), Not(HasSubstr("\x1b")), Not(HasSubstr("\xc2\x9b"))));
  EXPECT_THAT(text("out/summary.json"), AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\xc2\x9b"))));
  EXPECT_EQ(json("out/summary.json")["mechanism"]["name"],
            "\x1b]0;owned\x07 \xc2\x9b"
            "31m");
  const Ended fault = call({"run", "\x1b[2Jgone.toml"});
  EXPECT_THAT(fault.err, Not(HasSubstr("\x1b")));
}

TEST_F(UntrustedInputTest, TheReplayCommandIsQuotedForAShell) {
  std::filesystem::create_directory(folder_ / "a b; touch owned");
  write("a b; touch owned/s.toml",
        study("[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { uniform = { min = \"0.05 mm\", max = "
              "\"0.15 mm\" } }\n[montecarlo]\nsamples = 4\nseed = 1\n"));
  EXPECT_EQ(call({"montecarlo", "a b; touch owned/s.toml", "--rung", "quasistatic", "--set", "payload.mass=2 kg",
                  "--out", "out", "--quiet"})
                .status,
            0);
  std::string replay = json("out/summary.json")["replay"];
  EXPECT_THAT(replay, AllOf(HasSubstr("'a b; touch owned/s.toml'"), HasSubstr("'payload.mass=2 kg'")));
  replay.replace(replay.find("boresight"), 9, BORESIGHT_PROGRAM);
  replay.replace(replay.find("NUMBER"), 6, "2 --out replayed --quiet");
  EXPECT_EQ(std::system(("cd '" + folder_.string() + "' && " + replay).c_str()), 0) << replay;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "replayed/summary.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "owned"));
}

TEST_F(UntrustedInputTest, AToleranceMayStandAloneAsANumberOrAShare) {
  for (const char* tolerance : {"1e-2", "0.01", "1 %"}) {
    const Ended ended = call({"run", mechanism_, "--set", "motion.duration=20ms", "--tolerance", tolerance,
                              "--step-error", "off", "--out", tolerance, "--quiet"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(json(std::string(tolerance) + "/summary.json")["integrator"].get<std::string>(),
                HasSubstr("tolerance 0.01"));
  }
  expect_fault({"run", mechanism_, "--tolerance", "2"}, HasSubstr("--tolerance"));
}

TEST_F(UntrustedInputTest, AVerbIsNotBlamedForAnOptionThatItDoesNotHave) {
  write("study.toml", study("[match]\nminimise = \"index\"\nover = \"nominal\"\nevaluations = 2\nmap = "
                            "0\n[[match.variable]]\nparameter = "
                            "\"payload.mass\"\nfrom = \"0 kg\"\nto = \"1 kg\"\n"));
  const pid_t child =
      start({"match", "study.toml", "--set", "motion.duration=3000 s", "--rung", "envelope", "--out", "out"});
  ::usleep(1'000'000);
  ::kill(child, SIGKILL);
  EXPECT_THAT(wait_for(child).err, Not(HasSubstr("--sample")));
}

}  // namespace untrusted_input_test
}  // namespace boresight::app
