#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "program.hpp"

namespace boresight::app {
namespace {

class InterruptionTest : public Program {
 protected:
  // Starts a computation of minutes, lets it come to its work, and sends the signal.
  Ended interrupted(const std::vector<std::string>& arguments, int signal) const {
    const pid_t child = start(arguments);
    ::usleep(2'000'000);
    ::kill(child, signal);
    const auto sent = std::chrono::steady_clock::now();
    const Ended ended = wait_for(child);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - sent).count(), 20.0);
    return ended;
  }
};

TEST_F(InterruptionTest, CtrlCLeavesWholeFilesOfWhatWasReached) {
  const Ended ended = interrupted({"run", mechanism_, "--step", "0.2 us", "--out", "out"}, SIGINT);
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_THAT(files("out"),
              testing::ElementsAre("events.csv", "report.html", "summary.json", "timeseries.csv"));
  const auto summary = json("out/summary.json");
  EXPECT_TRUE(summary["interrupted"].get<bool>());
  EXPECT_GT(summary["end_time"].get<double>(), 0.0);
  EXPECT_LT(summary["end_time"].get<double>(), 1.0);
  EXPECT_EQ(text("out/timeseries.csv").back(), '\n');
  EXPECT_THAT(text("out/report.html"), testing::HasSubstr("</html>"));
}

TEST_F(InterruptionTest, APoliteKillIsTheSame) {
  EXPECT_EQ(interrupted({"run", mechanism_, "--step", "0.2 us", "--out", "out", "--quiet"}, SIGTERM).status,
            130);
  EXPECT_TRUE(json("out/summary.json")["interrupted"].get<bool>());
}

TEST_F(InterruptionTest, ASweepKeepsThePointsThatWereDone) {
  std::ofstream(folder_ / "study.toml")
      << "format = 1\nmechanism = \"" << mechanism_ << "\"\n[[sweep.axis]]\nparameter = \"payload.mass\"\n"
      << "from = \"0 kg\"\nto = \"500 kg\"\ncount = 500\n";
  const Ended ended = interrupted({"sweep", "study.toml", "--out", "out", "--jobs", "2"}, SIGINT);
  EXPECT_EQ(ended.status, 130) << ended.err;
  const auto summary = json("out/summary.json");
  EXPECT_TRUE(summary["interrupted"].get<bool>());
  EXPECT_EQ(summary["points"].size(), 500u);
  EXPECT_EQ(summary["points"][499]["status"], "not reached");
}

}  // namespace
}  // namespace boresight::app
