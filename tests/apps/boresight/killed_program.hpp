// A study that is killed while it is computed: what it is, and what has to be in its folder then and in the end.
#pragma once

#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "program.hpp"

namespace boresight::app {

using Clock = std::chrono::steady_clock;

struct StudyToKill {
  std::string verb = {}, study = {};        // study: its text after the head; "" where the verb takes the mechanism
  std::string what = {};                    // where a verb has several kinds of study
  std::vector<std::string> options = {};    // beside --out
  bool resumes = false;                     // with --resume
  std::set<std::string> not_compared = {};  // tables with times in them
  std::set<int> statuses = {0};
  std::string mechanism = BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml", duration = "100ms";  // "": as the file says
  std::set<std::string> measured = {};  // keys of the summary that hang on times without saying so
  std::string name() const { return what.empty() ? verb : what; }
};
inline void PrintTo(const StudyToKill& study, std::ostream* out) { *out << study.name(); }

inline const char* const kScatter = R"(
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

// What may differ between two starts of one study: times, and what is told of where the results are.
inline nlohmann::json without_times(nlohmann::json summary, const std::set<std::string>& measured) {
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

class KilledProgram : public Program, public testing::WithParamInterface<StudyToKill> {
 protected:
  std::vector<std::string> arguments(const std::string& out) const {
    const StudyToKill& c = GetParam();
    std::vector<std::string> words = {
        c.verb, c.study.empty() ? c.mechanism : "study.toml", "--jobs", "1", "--quiet", "--out", out};
    if (!c.duration.empty()) words.insert(words.end(), {"--set", "motion.duration=" + c.duration});
    words.insert(words.end(), c.options.begin(), c.options.end());
    if (c.resumes) words.push_back("--resume");
    return words;
  }

  struct WholeRun {
    Ended ended;
    double seconds = 0.0;
  };
  // The study without a kill, into whole/: how it ends, and how long it takes.
  WholeRun run_whole() {
    const StudyToKill& c = GetParam();
    if (!c.study.empty())
      std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" << c.mechanism << "\"\n" << c.study;
    const auto begin = Clock::now();
    WholeRun whole{call(arguments("whole"))};
    whole.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    EXPECT_TRUE(c.statuses.contains(whole.ended.status)) << whole.ended.status << whole.ended.err;
    return whole;
  }

  // A folder after a kill: no summary, one of a study that has begun, or a whole result.
  void expect_whole_or_none(const std::string& out) const {
    if (!std::filesystem::exists(folder_ / out / "summary.json")) return;
    nlohmann::json summary;
    ASSERT_NO_THROW(summary = json(out + "/summary.json"));
    if (!summary.contains("files")) return;
    for (const auto& name : summary["files"])
      EXPECT_TRUE(std::filesystem::exists(folder_ / out / name.get<std::string>())) << name;
  }

  // What is in killed/ against what is in whole/, but for times.
  void expect_as_uninterrupted() const {
    const StudyToKill& c = GetParam();
    EXPECT_EQ(files("killed"), files("whole")) << "no litter";
    for (const std::string& name : files("whole"))
      if (name.ends_with(".csv") && !c.not_compared.contains(name)) {
        EXPECT_EQ(text("killed/" + name), text("whole/" + name)) << name;
      }
    auto mine = without_times(json("killed/summary.json"), c.measured),
         theirs = without_times(json("whole/summary.json"), c.measured);
    if (c.verb != "chart") {
      for (const char* key : {"evaluations", "evaluations_reused", "reused"})
        mine.erase(key), theirs.erase(key);  // what was known already is not computed again
      EXPECT_EQ(mine, theirs) << nlohmann::json::diff(theirs, mine).dump(1);
    }
    if (c.name() == "montecarlo") {
      for (const char* out : {"killed", "whole"}) ASSERT_EQ(call({"export", out, "--quiet"}).status, 0);
      EXPECT_EQ(text("killed/samples.csv"), text("whole/samples.csv"));
      for (const char* out : {"killed", "whole"}) std::filesystem::remove(folder_ / out / "samples.csv");
    }
  }
};

}  // namespace boresight::app
