// Every verb killed with kill -9 at random times, again and again: what is in its folder then is a whole result or none, nothing stands
// in the way of the next start, and in the end all is as if nobody had killed it. Each third time there are two processes at once in one
// folder, and both are killed.
//
// BORESIGHT_KILLS in the environment sets how often each verb is killed; 3 otherwise, and 54 are more than a thousand kills.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>

#include "killed_program.hpp"

namespace boresight::app {
namespace kill_test {

int kills_of_each() {
  const char* asked = std::getenv("BORESIGHT_KILLS");
  return asked != nullptr ? std::atoi(asked) : 3;
}

std::vector<StudyToKill> cases() {
  const std::string scatter = kScatter;
  return {
      {.verb = "check"},
      {.verb = "laws"},
      {.verb = "run", .options = {"--step-error", "off"}},
      {.verb = "sweep",
       .study = "[[sweep.axis]]\nparameter = \"payload.mass\"\nfrom = \"0 kg\"\nto = \"100 kg\"\ncount = 4\n"},
      {.verb = "montecarlo",
       .study = scatter + "[montecarlo]\nsamples = 600\nseed = 1\n",
       .options = {"--rung", "perturbation"},
       .resumes = true},
      {.verb = "montecarlo",
       .study = scatter + "[montecarlo]\nsamples = 60\nseed = 1\n",
       .what = "pilot",
       .options = {"--accuracy", "90 %"},
       .resumes = true,
       .duration = "20ms"},
      {.verb = "montecarlo",
       .study = scatter + "[montecarlo]\nseed = 1\nfidelities = { models = [\"perturbation\", \"quasistatic\"], budget "
                          "= \"1 s\", pilot = 12 }\n",
       .what = "fidelities",
       .resumes = true,
       .not_compared = {"rungs.csv"},
       .duration = "20ms",
       .measured = {"gain"}},
      {.verb = "montecarlo",
       .study = "[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { uniform = { min = \"0.08 mm\", max "
                "= \"0.13 mm\" } }\n"
                "[montecarlo]\nseed = 1\nrequirement = { limit = \"0.25 mm\", probability = 0.9, confidence = 0.9 }\n"
                "tail = { cheap = \"perturbation\", exact = \"quasistatic\", budget = \"0.3 s\", pilot = 10 }\n",
       .what = "tail",
       .resumes = true,
       .statuses = {0, 1},
       .duration = "20ms"},
      {.verb = "sensitivity",
       .study = scatter + "[sensitivity]\nsamples = 32\nseed = 1\ndesign = \"random\"\n",
       .options = {"--rung", "quasistatic"},
       .resumes = true},
      {.verb = "match",
       .study = "[match]\nminimise = \"index\"\nover = \"nominal\"\nevaluations = 8\nmap = "
                "0\n[[match.variable]]\nparameter = \"payload.mass\"\n"
                "from = \"0 kg\"\nto = \"100 kg\"\n",
       .options = {"--rung", "quasistatic"},
       .statuses = {0, 1}},
      {.verb = "match",
       .study = "[match]\nminimise = \"index\"\nover = \"nominal\"\nevaluations = 8\nmap = "
                "5\n[[match.variable]]\nparameter = \"payload.mass\"\n"
                "from = \"0 kg\"\nto = \"100 kg\"\n[[match.variable]]\nparameter = \"clearance.F1.radial\"\nfrom = "
                "\"0.05 mm\"\nto = \"0.15 mm\"\n",
       .what = "map",
       .options = {"--rung", "quasistatic"},
       .statuses = {0, 1}},
      {.verb = "allocate",
       .study = "[allocate]\nrequirement = { limit = \"0.5 mm\", probability = 0.9, confidence = 0.9 }\nsamples = "
                "200\nconfirm = 40\nseed = 1\n"
                "fits = [ { fit = \"20 H9/d9\", price = 4 }, { fit = \"20 H7/g6\", price = 12 } "
                "]\n[[allocate.joint]]\nparameter = \"clearance.F1.radial\"\n",
       .options = {"--rung", "quasistatic"},
       .statuses = {0, 1}},
      {.verb = "budget",
       .study =
           scatter + "[budget]\nmembers = 40\nattribution = 8\nseed = 1\nsampling = \"1 ms\"\nwindow = \"10 ms\"\n",
       .options = {"--rung", "quasistatic"},
       .resumes = true,
       .statuses = {0, 1}},
      {.verb = "calibrate",
       .study = "[calibrate]\nstarts = 1\ncorrections = 1\nprofile = false\n[[calibrate.parameter]]\npath = "
                "\"clearance.D.radial\"\nstart = \"0.24 mm\"\n"
                "[[calibrate.run]]\ndata = \"" BORESIGHT_EXAMPLES
                "/calibration/slow.csv\"\nset = [\"motion.drives.A=2*pi*2*t\"]\n",
       .mechanism = BORESIGHT_EXAMPLES "/calibration/rig.toml",
       .duration = ""},
      {.verb = "calibrate",
       .study = "[calibrate]\nstarts = 2\ncorrections = 1\nlaws = [\"flores\", "
                "\"hertz\"]\n[[calibrate.parameter]]\npath = \"clearance.D.radial\"\nstart = \"0.24 mm\"\n"
                "[[calibrate.run]]\ndata = \"" BORESIGHT_EXAMPLES
                "/calibration/slow.csv\"\nset = [\"motion.drives.A=2*pi*2*t\"]\n",
       .what = "posterior",
       .mechanism = BORESIGHT_EXAMPLES "/calibration/rig.toml",
       .duration = ""},
      {.verb = "stability"},
      {.verb = "chart", .options = {"--time", "1 s"}, .not_compared = {"chart.csv", "flight.csv"}},
  };
}

class KillTest : public KilledProgram {};

TEST_P(KillTest, LeavesAWholeResultOrNoneAndTheEndIsThatOfAnUninterruptedOne) {
  const StudyToKill& c = GetParam();
  const auto [whole, seconds] = run_whole();
  if (HasFailure()) return;

  std::mt19937_64 random(std::hash<std::string>{}(c.name()));
  const auto a_while = [&] {
    return static_cast<useconds_t>(1e6 * seconds * std::uniform_real_distribution<double>(0.0, 1.05)(random));
  };
  int killed = 0, pairs = 0, refused = 0, ends = 0;
  for (int round = 0; killed < kills_of_each() && round < 3 * kills_of_each(); ++round) {
    const bool two = round % 3 == 2;
    std::vector<pid_t> children = {start(arguments("killed"))};
    if (two) children.push_back(start(arguments("killed")));
    int refusals = 0;
    bool ended = false;
    for (const pid_t child : children) {
      ::usleep(two ? a_while() / 2 : a_while());
      ::kill(child, SIGKILL);
      const int status = wait_for(child).status;
      killed += status == 128 + SIGKILL;
      ended = ended || c.statuses.contains(status);
      refusals += status == 2;
      EXPECT_TRUE(status == 128 + SIGKILL || c.statuses.contains(status) || (two && status == 2))
          << "blocked: " << status << text("stderr");
    }
    EXPECT_LE(refusals, 1) << "one of two may have the folder";
    pairs += two;
    refused += refusals;
    expect_whole_or_none("killed");
    if (ended) {  // and is begun anew, so that there is something to kill
      expect_as_uninterrupted();
      std::filesystem::remove_all(folder_ / "killed");
      ++ends;
    }
  }
  EXPECT_GE(killed, kills_of_each() / 2) << "it ended before it was killed";
  const Ended last = call(arguments("killed"));
  EXPECT_EQ(last.status, whole.status) << last.err;
  expect_as_uninterrupted();
  std::printf(
      "%s: %d kills; %d times two at once, one refused %d times; %d ends as an uninterrupted one; %.2f s a run\n",
      c.name().c_str(), killed, pairs, refused, ends + 1, seconds);
}

// Verbs that read or make folders instead: the same, with folders of their own.
class ShortKillTest : public Program {
 protected:
  // Kills `arguments` at random times within what they take, and looks at what is there each time.
  int kill_at_random(const std::vector<std::string>& arguments, const std::function<void()>& look) const {
    const auto begin = Clock::now();
    const Ended whole = call(arguments);
    EXPECT_EQ(whole.status, 0) << whole.err;
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    std::mt19937_64 random(7);
    int killed = 0;
    for (int round = 0; killed < kills_of_each() && round < 10 * kills_of_each(); ++round) {
      forget_result();
      const pid_t child = start(arguments);
      ::usleep(static_cast<useconds_t>(1e6 * seconds * std::uniform_real_distribution<double>(0.0, 1.0)(random)));
      ::kill(child, SIGKILL);
      killed += wait_for(child).status == 128 + SIGKILL;
      look();
    }
    return killed;
  }
  virtual void forget_result() const = 0;
};

class LongExportKillTest : public ShortKillTest {
 protected:
  void forget_result() const override { std::filesystem::remove(folder_ / "out/samples.csv"); }
};

TEST_F(LongExportKillTest, LeavesAllSamplesInTheTableOrNoTable) {
  std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" << mechanism_ << "\"\n"
                                        << kScatter << "[montecarlo]\nsamples = 3000\nseed = 1\n";
  ASSERT_EQ(call({"montecarlo", "study.toml", "--rung", "quasistatic", "--set", "motion.duration=5ms", "--out", "out",
                  "--quiet"})
                .status,
            0);
  ASSERT_EQ(call({"export", "out", "--quiet"}).status, 0);
  const std::string whole = text("out/samples.csv");
  const auto files_of_study = files("out");
  const int killed = kill_at_random({"export", "out", "--quiet"}, [&] {
    if (std::filesystem::exists(folder_ / "out/samples.csv")) {
      EXPECT_EQ(text("out/samples.csv"), whole);
    }
  });
  ASSERT_EQ(call({"export", "out", "--quiet"}).status, 0);
  EXPECT_EQ(text("out/samples.csv"), whole);
  EXPECT_EQ(files("out"), files_of_study) << "no litter";
  EXPECT_GE(killed, kills_of_each() / 2);
  std::printf("export: %d kills\n", killed);
}

class LongNewKillTest : public ShortKillTest {
 protected:
  void forget_result() const override {
    if (files("antenna") == files("whole")) std::filesystem::remove_all(folder_ / "antenna");
  }
};

TEST_F(LongNewKillTest, LeavesWholeFilesAndTheNextStartCompletesThem) {
  ASSERT_EQ(call({"new", "whole"}).status, 0);
  const int killed = kill_at_random({"new", "antenna"}, [&] {
    std::filesystem::create_directories(folder_ / "antenna");
    for (const std::string name : {"mechanism.toml", "montecarlo.toml"})
      if (std::filesystem::exists(folder_ / "antenna" / name)) {
        EXPECT_EQ(text("antenna/" + name), text("whole/" + name)) << name;
      }
    if (files("antenna").size() ==
        1) {  // cut short between the two: the moment that is hard to meet, and played here below
      EXPECT_EQ(call({"new", "antenna"}).status, 0);
    }
  });
  std::filesystem::remove_all(folder_ / "antenna");
  ASSERT_EQ(call({"new", "antenna"}).status, 0);
  std::filesystem::remove(folder_ / "antenna/montecarlo.toml");
  std::filesystem::create_directories(folder_ / "antenna/.being-written");
  std::ofstream(folder_ / "antenna/.being-written/montecarlo.toml") << "half";
  EXPECT_EQ(call({"new", "antenna"}).status, 0);
  EXPECT_EQ(files("antenna"), files("whole"));
  EXPECT_EQ(text("antenna/montecarlo.toml"), text("whole/montecarlo.toml"));
  EXPECT_EQ(call({"new", "antenna"}).status, 2) << "nothing is missing";
  std::filesystem::remove(folder_ / "antenna/montecarlo.toml");
  std::ofstream(folder_ / "antenna/mechanism.toml", std::ios::app) << "# mine\n";
  EXPECT_EQ(call({"new", "antenna"}).status, 2) << "it is the user's by now";
  EXPECT_GE(killed, kills_of_each() / 2);
  std::printf("new: %d kills\n", killed);
}

INSTANTIATE_TEST_SUITE_P(Long, KillTest, testing::ValuesIn(cases()), [](const auto& one) { return one.param.name(); });

}  // namespace kill_test
}  // namespace boresight::app
