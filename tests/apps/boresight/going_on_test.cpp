// Verbs that keep what they have while they are not whole: each start is killed after a part of what a whole one takes, so that the
// study ends only if a start goes on from the ones before it.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "killed_program.hpp"

namespace boresight::app {
namespace going_on_test {

class GoingOnTest : public KilledProgram {
 protected:
  static bool has_ended(pid_t child) {
    siginfo_t found = {};
    return ::waitid(P_PID, static_cast<id_t>(child), &found, WEXITED | WNOHANG | WNOWAIT) == 0 && found.si_pid == child;
  }
};

TEST_P(GoingOnTest, EndsThoughNoStartLastsLongEnough) {
  const StudyToKill& c = GetParam();
  const auto [whole, seconds] = run_whole();
  if (HasFailure()) return;

  constexpr int kMostStarts = 20;
  constexpr double kShare = 0.4;
  int starts = 0, status = 128 + SIGKILL;
  for (; starts < kMostStarts && status == 128 + SIGKILL; ++starts) {
    const pid_t child = start(arguments("killed"));
    const auto begun = Clock::now();
    while (std::chrono::duration<double>(Clock::now() - begun).count() < kShare * seconds && !has_ended(child))
      ::usleep(10'000);
    ::kill(child, SIGKILL);
    status = wait_for(child).status;
    if (status == 128 + SIGKILL && starts == 0) {
      EXPECT_FALSE(files("killed").empty()) << "nothing was kept";
    }
  }
  EXPECT_EQ(status, whole.status) << text("stderr");
  expect_as_uninterrupted();
  std::printf("%s: %d starts of %.2f s each, %.2f s a run\n", c.name().c_str(), starts, kShare * seconds, seconds);
}

std::vector<StudyToKill> cases_that_go_on() {
  const std::string rig = BORESIGHT_EXAMPLES "/calibration/rig.toml";
  return {
      {.verb = "sweep",
       .study = "[[sweep.axis]]\nparameter = \"payload.mass\"\nfrom = \"0 kg\"\nto = \"100 kg\"\ncount = 24\n",
       .options = {"--rung", "multibody"}},
      {.verb = "montecarlo",
       .study =
           kScatter + std::string("[montecarlo]\nseed = 1\nrequirement = { limit = \"0.25 mm\", probability = 0.9, "
                                  "confidence = 0.9 }\n"
                                  "tail = { cheap = \"quasistatic\", exact = \"perturbation\", budget = \"1 s\", "
                                  "pilot = 50 }\n"),
       .what = "tail",
       .statuses = {0, 1}},
      {.verb = "calibrate",
       .study = "[calibrate]\nstarts = 4\ncorrections = 2\nprofile = true\nlaws = [\"flores\", "
                "\"hertz\"]\n[[calibrate.parameter]]\npath = \"clearance.D.radial\"\nstart = \"0.24 mm\"\n"
                "[[calibrate.run]]\ndata = \"" BORESIGHT_EXAMPLES
                "/calibration/slow.csv\"\nset = [\"motion.drives.A=2*pi*2*t\"]\n",
       .mechanism = rig,
       .duration = ""},
      {.verb = "chart", .options = {"--time", "4 s"}, .not_compared = {"chart.csv", "flight.csv"}},
  };
}

INSTANTIATE_TEST_SUITE_P(Long, GoingOnTest, testing::ValuesIn(cases_that_go_on()),
                         [](const auto& one) { return one.param.name(); });

}  // namespace going_on_test
}  // namespace boresight::app
