// What a user may get wrong on the command line and in a file: refused in words, or said.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <regex>

#include "program.hpp"

namespace boresight::app {
namespace input_program_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class InputProgram : public Program {
 protected:
  const std::string four_bar_ = BORESIGHT_EXAMPLES "/four-bar/four-bar.toml";

  void expect_refused(const std::vector<std::string>& arguments, const std::string& part) const {
    const Ended ended = call(arguments);
    EXPECT_EQ(ended.status, 2) << part;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr(part));
  }
  // The example without its [clearance.contact] and [clearance.friction].
  void write_bare(const std::string& name) const {
    std::ifstream in(four_bar_);
    std::ofstream out(folder_ / name);
    bool left_out = false;
    for (std::string line; std::getline(in, line);) {
      const std::size_t first = line.find_first_not_of(' ');
      if (first != std::string::npos && line[first] == '[')
        left_out = line.find("[clearance.contact]") != std::string::npos ||
                   line.find("[clearance.friction]") != std::string::npos;
      if (!left_out) out << line << '\n';
    }
  }
};

// A number without bounds as a word of its own.
bool says_infinity(const std::string& text) {
  return std::regex_search(text, std::regex("(^|[^a-zA-Z])-?(inf|nan)([^a-zA-Z]|$)"));
}

TEST_F(InputProgram, OptionsOutOfAllProportionAreRefusedByName) {
  const auto run = [&](const std::string& option, const std::string& value) {
    return std::vector<std::string>{"run", four_bar_, option, value, "--rung", "perturbation"};
  };
  for (const char* value : {"0 s", "-1 ms", "1e-300 s", "1e300 s", "1 fs", "2 s"})
    expect_refused(run("--step", value), "--step");
  for (const char* value : {"0 s", "-1 ms", "1e-300 s", "1e300 s", "1 ns", "3 s"})
    expect_refused(run("--sample", value), "--sample");
  expect_refused(run("--sample", "1e3 s"), "found \"1e3 s\", expected at most the motion's duration");
  for (const char* value : {"0.01", "0 %", "-1 %", "1e-300 %", "1e300 %", "1 mm"})
    expect_refused(run("--accuracy", value), "--accuracy");
  for (const char* value : {"-1", "0", "5000", "1.5", "two"})
    expect_refused(run("--jobs", value),
                   "--jobs: found \"" + std::string(value) + "\", expected a whole number from 1 to 4096");
  for (const char* value : {"0 %", "-1 %", "1e-300 %", "1e300 %"})
    expect_refused({"run", four_bar_, "--integrator", "dopri5", "--tolerance", value}, "--tolerance");
  expect_refused(run("--tolerance", "-1"), "--tolerance: found \"-1\"");
  for (const char* value : {"0 s", "1e-300 s", "1e300 s"})
    expect_refused({"chart", four_bar_, "--time", value}, "--time");
}

TEST_F(InputProgram, AnOptionThatTheNamedRungDoesNotReadIsRefused) {
  std::ofstream(folder_ / "sweep.toml")
      << "format = 1\nmechanism = \"" << four_bar_
      << "\"\n[[sweep.axis]]\nparameter = \"clearance.D.radial\"\nvalues = [\"0.1 mm\"]\n";
  for (const std::vector<std::string>& head :
       {std::vector<std::string>{"run", four_bar_}, std::vector<std::string>{"sweep", "sweep.toml"}}) {
    const auto refused = [&](const char* rung, const char* option, const char* value, const std::string& why) {
      std::vector<std::string> arguments = head;
      arguments.insert(arguments.end(), {"--rung", rung, option, value});
      expect_refused(arguments, std::string(option) + ": found \"" + value + "\", expected none: the " + rung + why);
    };
    for (const char* rung : {"quasistatic", "envelope"}) {
      refused(rung, "--step", "1 us", " rung takes no steps");
      refused(rung, "--tolerance", "1e-3", " rung takes no steps");
      refused(rung, "--formulation", "paper", " rung takes no steps");
    }
    refused("perturbation", "--formulation", "paper", " rung has equations of its own");
    refused("perturbation", "--stabilisation", "projection", " rung has equations of its own");
  }
  // Those that are compared read them.
  const Ended compared = call({"run", four_bar_, "--rung", "quasistatic", "--step", "10 us", "--formulation", "paper",
                               "--compare", "--set", "motion.duration=5ms", "--step-error", "off", "--out", "out"});
  EXPECT_EQ(compared.status, 0) << compared.err;
}

// As an unset variable of a shell leaves it.
TEST_F(InputProgram, AByteThatIsNoUtf8IsRefusedByTheNameOfItsOption) {
  const std::string urdf = std::string(BORESIGHT_EXAMPLES) + "/from-urdf/gimbal.urdf";
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--drive", "pan=\xff*t; tilt"},
                                      {"--duration", "1 \xe4s"},
                                      {"--boresight", "\xc3"}}) {
    const Ended ended = call({"import", urdf, "--to", "made.toml", option, value});
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find(option + ": found the byte 0x"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("expected a text in UTF-8"), std::string::npos) << ended.err;
  }
  const Ended set = call({"check", mechanism_, "--set", "clearance.F1.radial=0.1 \xb5m", "--out", "out"});
  EXPECT_EQ(set.status, 2) << set.err;
  EXPECT_NE(set.err.find("--set: found the byte 0xB5"), std::string::npos) << set.err;
}

TEST_F(InputProgram, AnEmptyValueIsRefusedAndNotTakenForNone) {
  for (const char* option : {"--step", "--sample", "--integrator", "--tolerance", "--formulation", "--stabilisation",
                             "--pose", "--set", "--out", "--rung", "--accuracy", "--jobs", "--sample-number",
                             "--nonlinear", "--start", "--step-error", "--index"})
    expect_refused({"run", four_bar_, option, ""}, std::string(option) + ": found \"\", expected a value");
  expect_refused({"check", ""}, "FILE: found \"\", expected the mechanism file");
  expect_refused({"calibrate", "study.toml", "--make-data", ""}, "--make-data: found \"\"");
  expect_refused({"montecarlo", "study.toml", "--from", ""}, "--from: found \"\"");
}

TEST_F(InputProgram, ServeSaysWhichInputItRefuses) {
  const auto serve = [&](const std::string& first, const std::string& second) {
    return std::vector<std::string>{"serve", four_bar_, "--input", first, "--input", second, "--port", "0"};
  };
  const std::string radial = "clearance.D.radial";
  expect_refused(serve(radial, radial), "--input " + radial + ": found it a second time, expected each input once");
  expect_refused(serve(radial, "clearance.D.radical"),
                 "--input clearance.D.radical: found no number that studies vary, expected ");
}

TEST_F(InputProgram, AnUnknownOptionBeforeAnyVerbIsNamed) {
  expect_refused({"--hlep"}, "--hlep is not an option of boresight; did you mean --help?");
  expect_refused({"--rung", "multibody", "run", four_bar_}, "found --rung before a verb");
}

// A wildcard names a parameter as its own path does: which of two values would hold would hang on their order.
TEST_F(InputProgram, AParameterGivenTwiceThroughAWildcardIsRefusedByEveryVerb) {
  const std::string head =
      "format = 1\nmechanism = \"" + mechanism_ + "\"\n[index]\nquantity = \"position_error\"\nstatistic = \"max\"\n";
  const auto twice = [&](const std::string& verb, const std::string& before, const std::string& entry,
                         const std::string& key, const std::string& rest) {
    for (const bool turned : {false, true}) {
      std::string study = head + before;
      for (const bool wild : {turned, !turned})
        study += "[[" + entry + "]]\n" + key + " = \"clearance." + (wild ? "*" : "F1") + ".radial\"\n" + rest;
      std::ofstream(folder_ / "study.toml") << study;
      expect_refused({verb, "study.toml"}, "found \"clearance.F1.radial\" a second time");
    }
  };
  twice("sweep", "", "sweep.axis", "parameter", "values = [\"0.1 mm\", \"0.2 mm\"]\n");
  twice("match", "", "match.variable", "parameter", "from = \"0.1 mm\"\nto = \"0.3 mm\"\n");
  twice("allocate", "[allocate]\nrequirement = { limit = \"0.3 mm\", probability = 0.95, confidence = 0.9 }\n",
        "allocate.joint", "parameter",
        "least = \"2 um\"\nprocesses = [{ name = \"p\", tolerance = \"0.05 mm\", price = 1 }]\n");
  twice("calibrate", "", "calibrate.parameter", "path", "");
  twice("montecarlo", "[montecarlo]\nsamples = 10\n", "random", "parameter",
        "distribution = { normal = { mean = \"0.2 mm\", sd = \"0.01 mm\" } }\n");
}

// What the study gives in place of the mechanism's own value makes that of --set one that nothing reads.
TEST_F(InputProgram, ASettingOfWhatTheStudyVariesIsRefusedByEveryVerb) {
  const std::string head =
      "format = 1\nmechanism = \"" + mechanism_ + "\"\n[index]\nquantity = \"position_error\"\nstatistic = \"max\"\n";
  const std::string scatter =
      "[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { normal = { mean = \"0.2 mm\", sd = \"0.01 "
      "mm\" } "
      "}\n";
  const auto varied = [&](const std::string& verb, const std::string& rest) {
    std::ofstream(folder_ / "study.toml") << head << rest;
    expect_refused({verb, "study.toml", "--set", "clearance.F1.radial=0.1mm"},
                   "--set clearance.F1.radial=0.1mm: clearance.F1.radial: found a value that would have no effect: the "
                   "study varies it (study.toml:");
  };
  varied("sweep", "[[sweep.axis]]\nparameter = \"clearance.F1.radial\"\nvalues = [\"0.1 mm\", \"0.2 mm\"]\n");
  varied("match", "[[match.variable]]\nparameter = \"clearance.F1.radial\"\nfrom = \"0.1 mm\"\nto = \"0.3 mm\"\n");
  varied("allocate",
         "[allocate]\nrequirement = { limit = \"0.3 mm\", probability = 0.95, confidence = 0.9 }\n[[allocate.joint]]\n"
         "parameter = \"clearance.F1.radial\"\nleast = \"2 um\"\nprocesses = [{ name = \"p\", tolerance = \"0.05 mm\", "
         "price = 1 }]\n");
  varied("montecarlo", "[montecarlo]\nsamples = 10\n" + scatter);
  varied("sensitivity", "[sensitivity]\nsamples = 64\nreplicates = 4\n" + scatter);
  varied("budget", "[budget]\nmembers = 10\n" + scatter);
  varied("serve", scatter);
}

TEST_F(InputProgram, HistoriesThatMemoryCannotHoldAreRefusedWithTheirSize) {
  std::vector<std::string> arguments = {"run", mechanism_, "--sample", "0.6 us", "--rung", "perturbation"};
  for (const char* body : {"rod1", "rod2", "rod3", "tube1", "tube2", "crank1"})
    arguments.insert(arguments.end(), {"--pose", body});
  expect_refused(arguments, "GB of histories");
}

TEST_F(InputProgram, AbsurdNumbersAreRefusedByEveryVerbThatReadsThem) {
  for (const char* verb : {"check", "run"}) {
    expect_refused({verb, four_bar_, "--set", "clearance.D.contact.young=1e-308 GPa"}, "from 1 kPa to 10 TPa");
    expect_refused({verb, four_bar_, "--set", "clearance.D.cap_radius=1e300 mm"}, "from 1 pm to 10000 km");
    expect_refused({verb, four_bar_, "--set", "gravity.z=-1e300 m/s^2"}, "at most 1e7 m/s^2");
  }
  std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" << four_bar_ << "\"\n[[random]]\n"
                                        << "parameter = \"clearance.D.contact.young\"\n"
                                        << "distribution = { lognormal = { median = \"72 GPa\", factor = 1000 } }\n"
                                        << "[montecarlo]\nsamples = 10\n";
  expect_refused({"montecarlo", "study.toml"}, "from 1 kPa to 10 TPa");
}

// Forces within their ranges and beyond what the joint can bear.
TEST_F(InputProgram, CheckFindsAJournalThatWouldBePressedThroughItsSleeve) {
  const Ended ended = call({"check", four_bar_, "--set", "gravity.z=-1e7 m/s^2", "--set", "payload.mass=1e6 kg",
                            "--set", "clearance.D.contact.young=1 MPa", "--out", "out"});
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("problem: D: its largest load"), Not(HasSubstr("nothing stands in the way"))));
  EXPECT_FALSE(says_infinity(ended.out)) << ended.out;
  EXPECT_FALSE(says_infinity(text("out/conditioning.csv")));
}

TEST_F(InputProgram, ARunOfAJournalThatIsPressedThroughItsSleeveIsRefused) {
  const Ended ended = call({"run", four_bar_, "--set", "gravity.z=-1e7 m/s^2", "--set",
                            "clearance.D.contact.young=1 MPa", "--rung", "quasistatic", "--out", "out"});
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("no contact law holds there"));
}

TEST_F(InputProgram, AccuracyIsHeldAgainstWhatARungAskedForByNameStatesOfItself) {
  const auto run = [&](const char* accuracy) {
    return call({"run", four_bar_, "--set", "motion.duration=0.1 s", "--rung", "quasistatic", "--accuracy", accuracy,
                 "--out", std::string("out-") + accuracy});
  };
  const Ended loose = run("100 %"), tight = run("0.0001 %");
  EXPECT_EQ(loose.status, 0) << loose.err;
  EXPECT_THAT(loose.out, HasSubstr("position error, maximum: within 100 %; the run states"));
  EXPECT_EQ(tight.status, 1) << tight.err;
  EXPECT_THAT(tight.out, HasSubstr("position error, maximum: not shown to be within 0.0001 %; the run states"));
}

TEST_F(InputProgram, CheckOfAMotionThatMemoryCannotHoldSaysSo) {
  for (const char* duration : {"1e4 s", "1e6 s"}) {
    const Ended ended = call({"check", mechanism_, "--set", std::string("motion.duration=") + duration, "--out",
                              std::string("out-") + duration});
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.out, AllOf(HasSubstr("GB of memory; shorten motion.duration"), Not(HasSubstr("beyond t = 0"))));
  }
}

TEST_F(InputProgram, CtrlCIsHeardWhileTheIdealMotionIsFollowed) {
  for (const char* verb : {"check", "run"}) {
    const pid_t child =
        start({verb, mechanism_, "--set", "motion.duration=300 s", "--out", std::string("out-") + verb});
    ::usleep(1'000'000);
    ::kill(child, SIGINT);
    const Ended ended = wait_for(child);
    EXPECT_EQ(ended.status, 130) << verb << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("interrupted")) << verb;
  }
}

TEST_F(InputProgram, WhatAFileLeavesOutIsSaidAndKept) {
  write_bare("bare.toml");
  const Ended checked = call({"check", "bare.toml", "--out", "check"});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out,
              AllOf(HasSubstr("D: not given, so assumed:"), HasSubstr("contact.young = 72 GPa (aluminium)"),
                    HasSubstr("friction.coefficient = 0 (none)")));
  const Ended ran = call({"run", "bare.toml", "--rung", "quasistatic", "--out", "run"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("warning: D: not given, so assumed: contact.law"));
  const auto summary = json("run/summary.json");
  EXPECT_EQ(summary["assumed"]["clearance.D.contact.young"], "72 GPa");
  EXPECT_THAT(summary["warnings"].dump(), HasSubstr("contact.restitution = 0.9"));
  EXPECT_THAT(text("run/report.html"), HasSubstr("contact.young = 72 GPa (aluminium)"));
  // Given on the command line, it is not assumed.
  const Ended given = call(
      {"run", "bare.toml", "--rung", "quasistatic", "--set", "clearance.D.contact.young=210 GPa", "--out", "given"});
  EXPECT_EQ(given.status, 0) << given.err;
  EXPECT_FALSE(json("given/summary.json")["assumed"].contains("clearance.D.contact.young"));
}

TEST_F(InputProgram, RestitutionZeroRunsWithALawThatTakesIt) {
  expect_refused({"run", four_bar_, "--set", "clearance.D.contact.restitution=0"}, "laws that take 0: hunt-crossley");
  const Ended ended =
      call({"run", four_bar_, "--rung", "perturbation", "--set", "clearance.D.contact.law=lankarani-nikravesh", "--set",
            "clearance.D.contact.restitution=0", "--set", "motion.duration=0.1 s", "--out", "out"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(json("out/summary.json")["index"]["position_error"]["max"].is_number());
}

}  // namespace input_program_test
}  // namespace boresight::app
