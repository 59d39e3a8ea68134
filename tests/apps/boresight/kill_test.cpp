// Every verb killed with kill -9 at random times, again and again: what is in its folder then is a whole result or none, nothing stands
// in the way of the next start, and in the end all is as if nobody had killed it.
//
// BORESIGHT_KILLS in the environment sets how often each verb is killed; 8 otherwise.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>
#include <set>

#include "program.hpp"

namespace boresight::app {
namespace {

using Clock = std::chrono::steady_clock;

int kills_of_each() {
  const char* asked = std::getenv("BORESIGHT_KILLS");
  return asked != nullptr ? std::atoi(asked) : 8;
}

struct Case {
  std::string verb = {}, study = {};        // study: its text after the head; "" where the verb takes the mechanism
  std::string what = {};                    // where a verb has several kinds of study
  std::vector<std::string> options = {};    // beside --out
  bool resumes = false;                     // with --resume
  std::set<std::string> not_compared = {};  // tables with times in them
  std::set<int> statuses = {0};
  std::string mechanism = BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml", duration = "100ms";  // "": as the file says
  std::set<std::string> measured = {};      // keys of the summary that hang on times without saying so
  std::string name() const { return what.empty() ? verb : what; }
};

const char* const kScatter = R"(
[index]
quantity = "position_error"
statistic = "max"
[[random]]
parameter = "clearance.F1.radial"
distribution = { normal = { mean = "0.1 mm", sd = "0.01 mm" }, truncate = ["0.05 mm", "0.15 mm"] }
[[random]]
parameter = "clearance.F1.contact.restitution"
distribution = { uniform = { min = 0.7, max = 0.95 } }
)";

std::vector<Case> cases() {
  const std::string scatter = kScatter;
  return {
      {.verb = "check"},
      {.verb = "laws"},
      {.verb = "run", .options = {"--step-error", "off"}},
      {.verb = "sweep", .study = "[[sweep.axis]]\nparameter = \"payload.mass\"\nfrom = \"0 kg\"\nto = \"100 kg\"\ncount = 4\n"},
      {.verb = "montecarlo", .study = scatter + "[montecarlo]\nsamples = 600\nseed = 1\n", .options = {"--rung", "perturbation"}, .resumes = true},
      {.verb = "montecarlo",
       .study = scatter + "[montecarlo]\nseed = 1\nfidelities = { models = [\"perturbation\", \"quasistatic\"], budget = \"1 s\", pilot = 12 }\n",
       .what = "fidelities",
       .resumes = true,
       .not_compared = {"rungs.csv"},
       .duration = "20ms",
       .measured = {"gain"}},
      {.verb = "montecarlo",
       .study = "[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { uniform = { min = \"0.08 mm\", max = \"0.13 mm\" } }\n"
                "[montecarlo]\nseed = 1\nrequirement = { limit = \"0.25 mm\", probability = 0.9, confidence = 0.9 }\n"
                          "tail = { cheap = \"perturbation\", exact = \"quasistatic\", budget = \"0.3 s\", pilot = 10 }\n",
       .what = "tail",
       .resumes = true,
       .statuses = {0, 1},
       .duration = "20ms"},
      {.verb = "sensitivity", .study = scatter + "[sensitivity]\nsamples = 32\nseed = 1\ndesign = \"random\"\n", .options = {"--rung", "quasistatic"}, .resumes = true},
      {.verb = "match",
       .study = "[match]\nminimise = \"index\"\nover = \"nominal\"\nevaluations = 8\nmap = 0\n[[match.variable]]\nparameter = \"payload.mass\"\n"
                "from = \"0 kg\"\nto = \"100 kg\"\n",
       .options = {"--rung", "quasistatic"},
       .statuses = {0, 1}},
      {.verb = "allocate",
       .study = "[allocate]\nrequirement = { limit = \"0.5 mm\", probability = 0.9, confidence = 0.9 }\nsamples = 200\nconfirm = 40\nseed = 1\n"
                "fits = [ { fit = \"20 H9/d9\", price = 4 }, { fit = \"20 H7/g6\", price = 12 } ]\n[[allocate.joint]]\nparameter = \"clearance.F1.radial\"\n",
       .options = {"--rung", "quasistatic"},
       .statuses = {0, 1}},
      {.verb = "budget",
       .study = scatter + "[budget]\nmembers = 40\nattribution = 8\nseed = 1\nsampling = \"1 ms\"\nwindow = \"10 ms\"\n",
       .options = {"--rung", "quasistatic"},
       .resumes = true,
       .statuses = {0, 1}},
      {.verb = "calibrate",
       .study = "[calibrate]\nstarts = 1\ncorrections = 0\nprofile = false\n[[calibrate.parameter]]\npath = \"clearance.D.radial\"\nstart = \"0.24 mm\"\n"
                "[[calibrate.run]]\ndata = \"" BORESIGHT_EXAMPLES "/calibration/slow.csv\"\nset = [\"motion.drives.A=2*pi*2*t\"]\n",
       .mechanism = BORESIGHT_EXAMPLES "/calibration/rig.toml",
       .duration = ""},
      {.verb = "stability"},
      {.verb = "chart", .options = {"--time", "1 s"}, .not_compared = {"chart.csv", "flight.csv"}},
  };
}

// What may differ between two starts of one study: times, and what is told of where the results are.
nlohmann::json without_times(nlohmann::json summary, const std::set<std::string>& measured) {
  std::function<void(nlohmann::json&)> clean = [&](nlohmann::json& node) {
    if (node.is_object())
      for (auto it = node.begin(); it != node.end();)
        if (it.key().find("seconds") != std::string::npos || it.key() == "machine" || measured.contains(it.key())) {
          it = node.erase(it);
        } else {
          clean(it.value());
          ++it;
        }
    else if (node.is_array())
      for (auto& item : node) clean(item);
  };
  clean(summary);
  return summary;
}

class KillTest : public Program, public testing::WithParamInterface<Case> {
 protected:
  std::vector<std::string> arguments(const std::string& out) const {
    const Case& c = GetParam();
    std::vector<std::string> words = {c.verb, c.study.empty() ? c.mechanism : "study.toml", "--jobs", "1", "--quiet", "--out", out};
    if (!c.duration.empty()) words.insert(words.end(), {"--set", "motion.duration=" + c.duration});
    words.insert(words.end(), c.options.begin(), c.options.end());
    if (c.resumes) words.push_back("--resume");
    return words;
  }

  // A folder after a kill: no summary, one of a study that has begun, or a whole result.
  void expect_whole_or_none(const std::string& out) const {
    if (!std::filesystem::exists(folder_ / out / "summary.json")) return;
    nlohmann::json summary;
    ASSERT_NO_THROW(summary = json(out + "/summary.json"));
    if (!summary.contains("files")) return;
    for (const auto& name : summary["files"]) EXPECT_TRUE(std::filesystem::exists(folder_ / out / name.get<std::string>())) << name;
  }
};

TEST_P(KillTest, LeavesAWholeResultOrNoneAndTheEndIsThatOfAnUninterruptedOne) {
  const Case& c = GetParam();
  if (!c.study.empty()) std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" << c.mechanism << "\"\n" << c.study;
  const auto begin = Clock::now();
  const Ended whole = call(arguments("whole"));
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  ASSERT_TRUE(c.statuses.contains(whole.status)) << whole.status << whole.err;

  std::mt19937_64 random(std::hash<std::string>{}(c.name()));
  int killed = 0;
  for (int k = 0; k < kills_of_each(); ++k) {
    const pid_t child = start(arguments("killed"));
    ::usleep(static_cast<useconds_t>(1e6 * seconds * std::uniform_real_distribution<double>(0.0, 1.05)(random)));
    ::kill(child, SIGKILL);
    const int status = wait_for(child).status;
    killed += status == 128 + SIGKILL;
    EXPECT_TRUE(status == 128 + SIGKILL || c.statuses.contains(status)) << "blocked: " << status << text("stderr");
    expect_whole_or_none("killed");
  }
  const Ended last = call(arguments("killed"));
  EXPECT_EQ(last.status, whole.status) << last.err;
  EXPECT_EQ(files("killed"), files("whole")) << "no litter";
  for (const std::string& name : files("whole"))
    if (name.ends_with(".csv") && !c.not_compared.contains(name)) {
      EXPECT_EQ(text("killed/" + name), text("whole/" + name)) << name;
    }
  auto mine = without_times(json("killed/summary.json"), c.measured), theirs = without_times(json("whole/summary.json"), c.measured);
  if (c.verb != "chart") {
    for (const char* key : {"evaluations", "evaluations_reused", "reused"}) mine.erase(key), theirs.erase(key);  // what was known already is not computed again
    EXPECT_EQ(mine, theirs);
  }
  if (c.name() == "montecarlo") {
    for (const char* out : {"killed", "whole"}) ASSERT_EQ(call({"export", out, "--quiet"}).status, 0);
    EXPECT_EQ(text("killed/samples.csv"), text("whole/samples.csv"));
  }
  std::printf("%s: %d kills, %.2f s a run\n", c.name().c_str(), killed, seconds);
}

INSTANTIATE_TEST_SUITE_P(Long, KillTest, testing::ValuesIn(cases()), [](const auto& one) { return one.param.name(); });

}  // namespace
}  // namespace boresight::app
