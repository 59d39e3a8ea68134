// Several processes that are given the same place for their results.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "program.hpp"

namespace boresight::app {
namespace two_at_once_test {

using TwoAtOnceTest = Program;

// Every folder below results/ that has a summary, by the settings that it names.
std::map<std::string, std::string> results_by_setting(const std::filesystem::path& results, const std::string& table) {
  std::map<std::string, std::string> found;
  for (const auto& folder : std::filesystem::directory_iterator(results)) {
    std::ifstream summary(folder.path() / "summary.json"), rows(folder.path() / table);
    const auto json = nlohmann::json::parse(summary);
    found[json["identity"]["settings"].dump()] = std::string(std::istreambuf_iterator<char>(rows), {});
  }
  return found;
}

TEST_F(TwoAtOnceTest, RunsOfOneFileGetAFolderEachAndKeepTheirOwnTables) {
  const std::vector<std::string> radii = {"0.1mm", "0.2mm", "0.3mm"};
  const auto arguments = [&](const std::string& radius) {
    return std::vector<std::string>{
        "run", mechanism_, "--set", "motion.duration=20ms", "--set", "clearance.F1.radial=" + radius, "--quiet"};
  };
  std::vector<pid_t> children;
  for (const std::string& radius : radii) children.push_back(start(arguments(radius)));
  for (const pid_t child : children) EXPECT_EQ(wait_for(child).status, 0);
  const auto together = results_by_setting(folder_ / "results", "timeseries.csv");
  std::filesystem::remove_all(folder_ / "results");
  for (const std::string& radius : radii) EXPECT_EQ(call(arguments(radius)).status, 0);
  EXPECT_EQ(together.size(), 3u);
  EXPECT_EQ(together, results_by_setting(folder_ / "results", "timeseries.csv"));
}

TEST_F(TwoAtOnceTest, TheSecondInOneFolderIsToldAndTheFirstIsWhole) {
  const std::vector<std::string> arguments = {"run",   mechanism_, "--set",  "motion.duration=50ms",
                                              "--out", "out",      "--quiet"};
  const std::vector<pid_t> children = {start(arguments), start(arguments)};
  std::vector<int> statuses;
  for (const pid_t child : children) statuses.push_back(wait_for(child).status);
  std::sort(statuses.begin(), statuses.end());
  EXPECT_THAT(statuses, testing::ElementsAre(0, testing::AnyOf(0, 2)))
      << "0 where one had ended before the other began";
  EXPECT_THAT(files("out"),
              testing::ElementsAre("events.csv", "report.html", "report.json", "summary.json", "timeseries.csv"));
}

TEST_F(TwoAtOnceTest, AStudyWithStoredSamplesIsNotBegunTwice) {
  std::ofstream(folder_ / "study.toml")
      << "format = 1\nmechanism = \"" << mechanism_ << "\"\n[[random]]\n"
      << "parameter = \"clearance.F1.radial\"\ndistribution = { uniform = { min = \"0.05 mm\", max = \"0.15 mm\" } }\n"
      << "[montecarlo]\nsamples = 2000000\nseed = 1\n";
  const std::vector<std::string> arguments = {"montecarlo", "study.toml", "--rung", "envelope", "--resume", "--quiet"};
  const pid_t first = start(arguments);
  while (!std::filesystem::exists(folder_ / "results/study-montecarlo/samples.db")) ::usleep(20'000);
  const Ended second = call(arguments);
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, testing::HasSubstr("another run is writing there"));
  ::kill(first, SIGKILL);
  wait_for(first);
  const pid_t third = start(arguments);
  ::usleep(500'000);
  ::kill(third, SIGINT);
  EXPECT_EQ(wait_for(third).status, 130) << "a kill leaves no claim behind";
  EXPECT_THAT(files("results"), testing::ElementsAre("study-montecarlo"));
}

}  // namespace two_at_once_test
}  // namespace boresight::app
