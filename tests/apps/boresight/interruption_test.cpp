#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

#include "program.hpp"

namespace boresight::app {
namespace interruption_test {

class InterruptionTest : public Program {
 protected:
  // Starts a computation of minutes, lets it come to its work, and sends the signal.
  Ended interrupted(const std::vector<std::string>& arguments, int signal, unsigned seconds = 2) const {
    const pid_t child = start(arguments);
    ::sleep(seconds);
    ::kill(child, signal);
    const auto sent = std::chrono::steady_clock::now();
    const Ended ended = wait_for(child);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - sent).count(), 20.0);
    return ended;
  }
  // Interrupts a sweep into `out` of which at least so many points are done. A busy machine may not come to one in two seconds: then it gets twice as many.
  void interrupt_with_points_done(const std::vector<std::string>& sweep, std::size_t least) const {
    for (unsigned seconds = 2; seconds <= 32; seconds *= 2) {
      const Ended ended = interrupted(sweep, SIGINT, seconds);
      ASSERT_EQ(ended.status, 130) << ended.err;
      std::size_t done = 0;
      const auto summary = json("out/summary.json");
      for (const auto& point : summary["points"]) done += point["status"] == "done" ? 1 : 0;
      if (done >= least) return;
    }
    FAIL() << "no point done in half a minute";
  }
};

TEST_F(InterruptionTest, CtrlCLeavesWholeFilesOfWhatWasReached) {
  const Ended ended = interrupted({"run", mechanism_, "--step", "0.2 us", "--out", "out"}, SIGINT);
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_THAT(files("out"),
              testing::ElementsAre("events.csv", "report.html", "report.json", "summary.json", "timeseries.csv"));
  const auto summary = json("out/summary.json");
  EXPECT_TRUE(summary["interrupted"].get<bool>());
  EXPECT_GT(summary["end_time"].get<double>(), 0.0);
  EXPECT_LT(summary["end_time"].get<double>(), 1.0);
  EXPECT_EQ(text("out/timeseries.csv").back(), '\n');
  EXPECT_THAT(text("out/report.html"), testing::HasSubstr("</html>"));
}

TEST_F(InterruptionTest, APoliteKillIsTheSame) {
  EXPECT_EQ(interrupted({"run", mechanism_, "--step", "0.2 us", "--out", "out", "--quiet"}, SIGTERM).status, 130);
  EXPECT_TRUE(json("out/summary.json")["interrupted"].get<bool>());
}

TEST_F(InterruptionTest, ASweepKeepsThePointsThatWereDone) {
  constexpr std::size_t kPoints = 5000;  // of some milliseconds each
  const auto write = [&](const std::string& values) {
    std::ofstream(folder_ / "study.toml")
        << "format = 1\nmechanism = \"" << mechanism_ << "\"\n[[sweep.axis]]\nparameter = \"payload.mass\"\n"
        << values << "\n";
  };
  write("from = \"0 kg\"\nto = \"500 kg\"\ncount = " + std::to_string(kPoints));
  ASSERT_NO_FATAL_FAILURE(interrupt_with_points_done(
      {"sweep", "study.toml", "--rung", "perturbation", "--step", "50 us", "--out", "out", "--jobs", "2"}, 2));
  const auto summary = json("out/summary.json");
  EXPECT_TRUE(summary["interrupted"].get<bool>());
  const auto& points = summary["points"];
  ASSERT_EQ(points.size(), kPoints);
  std::vector<std::size_t> done;
  int halfway = 0;
  for (std::size_t k = 0; k < kPoints; ++k) {
    if (points[k]["status"] == "done") {
      done.push_back(k);
    } else if (points[k]["status"] == "interrupted") {
      ++halfway;
    } else {
      EXPECT_EQ(points[k]["status"], "not reached") << k;
      EXPECT_FALSE(points[k].contains("index")) << k;
    }
  }
  EXPECT_LE(halfway, 2) << "one a thread";
  ASSERT_GE(done.size(), 2u);
  ASSERT_LT(done.size(), kPoints);
  const std::string table = text("out/sweep.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), 1 + kPoints);
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = table.find(",done,", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, done.size());
  // What was done is what a sweep of these points alone gives, with the same step (a sweep takes one for all its points).
  const auto mass = [&](std::size_t k) { return "\"" + points[k]["parameters"]["payload.mass"].dump() + " kg\""; };
  write("values = [" + mass(done.front()) + ", " + mass(done.back()) + "]");
  ASSERT_EQ(
      call({"sweep", "study.toml", "--rung", "perturbation", "--step", "50 us", "--out", "alone", "--quiet"}).status,
      0);
  const auto alone = json("alone/summary.json")["points"];
  EXPECT_EQ(points[done.front()]["index"], alone[0]["index"]);
  EXPECT_EQ(points[done.back()]["index"], alone[1]["index"]);
}

TEST_F(InterruptionTest, ASweepGoesOnWithThePointsThatWereDone) {
  std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" << mechanism_
                                        << "\"\n[[sweep.axis]]\nparameter = \"payload.mass\"\n"
                                        << "from = \"0 kg\"\nto = \"500 kg\"\ncount = 24\n";
  const auto sweep = [](const std::string& out) {
    return std::vector<std::string>{"sweep", "study.toml", "--rung", "perturbation", "--step",
                                    "10 us", "--out",      out,      "--jobs",       "2"};
  };
  ASSERT_NO_FATAL_FAILURE(interrupt_with_points_done(sweep("out"), 1));
  EXPECT_THAT(files("out"), testing::UnorderedElementsAre("report.html", "report.json", "summary.json", "sweep.csv",
                                                          "unfinished.db"));
  const auto before = json("out/summary.json")["points"];
  const Ended ended = call(sweep("out"));
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(files("out"), testing::UnorderedElementsAre("report.html", "report.json", "summary.json", "sweep.csv"));
  const auto after = json("out/summary.json")["points"];
  int done = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k]["status"] != "done") continue;
    ++done;
    EXPECT_EQ(before[k], after[k]) << "its CPU time too: it was not computed again";
  }
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 24);
  ASSERT_EQ(call(sweep("whole")).status, 0);
  EXPECT_EQ(text("out/sweep.csv"), text("whole/sweep.csv"));
  EXPECT_TRUE(text("out/report.html") == text("whole/report.html"));
}

TEST_F(InterruptionTest, AChartGoesOnWithWhatWasMeasured) {
  const std::vector<std::string> chart = {"chart",  mechanism_, "--set", "motion.duration=50ms",
                                          "--time", "4 s",      "--out", "out"};
  const auto rows = [&] {
    std::vector<std::string> found;
    std::istringstream table(text("out/chart.csv"));
    for (std::string line; std::getline(table, line);)
      found.push_back(line.substr(0, line.rfind(',', line.rfind(',') - 1)));
    return found;
  };
  // On a busy machine the first start may not come beyond the reference: the next one goes on from there.
  std::vector<std::string> before;
  for (int start = 0; start < 10 && before.size() < 2; ++start) {
    ASSERT_EQ(interrupted(chart, SIGINT).status, 130);
    before = rows();
  }
  EXPECT_THAT(files("out"), testing::Contains("unfinished.db"));
  ASSERT_EQ(call(chart).status, 0);
  EXPECT_THAT(files("out"), testing::Not(testing::Contains("unfinished.db")));
  const std::vector<std::string> after = rows();
  ASSERT_GT(before.size(), 1u);
  ASSERT_GT(after.size(), before.size());
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(before[k], after[k]) << "with the time that it took";
}

}  // namespace interruption_test
}  // namespace boresight::app
