// What a sweep says of its points: its rung holds between the ends too, and what a point warns of is heard.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "slider_in_guide_file.hpp"

namespace boresight::app {
namespace sweep_program_test {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class SweepProgram : public Program {};

// At both ends the bound is next to the truth: heavy loads lie at it, and next to none lets journals stand anywhere. Between them it is 11 % above.
TEST_F(SweepProgram, ChoosesARungThatHoldsBetweenTheEndsToo) {
  ASSERT_EQ(call({"new", "antenna"}).status, 0);
  write("antenna/study.toml",
        "format = 1\nmechanism = \"mechanism.toml\"\naccuracy = \"2 %\"\n[index]\nquantity = \"boresight_error\"\n"
        "statistic = \"max\"\n[[sweep.axis]]\nparameter = \"gravity.z\"\n"
        "values = [\"-9.81 m/s^2\", \"-1 m/s^2\", \"-0.05 m/s^2\"]\n");
  ASSERT_EQ(call({"sweep", "antenna/study.toml", "--out", "auto", "--quiet"}).status, 0);
  ASSERT_EQ(call({"sweep", "antenna/study.toml", "--out", "exact", "--quiet", "--rung", "multibody"}).status, 0);
  const auto chosen = json("auto/summary.json")["index"]["values"],
             exact = json("exact/summary.json")["index"]["values"];
  ASSERT_EQ(chosen.size(), 3u);
  // All three were tried.
  EXPECT_THAT(json("auto/summary.json")["rung_why"].get<std::string>(), Not(HasSubstr("; tried at")));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(chosen[k].get<double>() / exact[k].get<double>(), 1.0, 0.02) << k;
}

TEST_F(SweepProgram, SaysAtHowManyOfItsPointsRungsWereTried) {
  ASSERT_EQ(call({"new", "antenna"}).status, 0);
  write("antenna/study.toml",
        "format = 1\nmechanism = \"mechanism.toml\"\naccuracy = \"5 %\"\n[[sweep.axis]]\nparameter = \"payload.mass\"\n"
        "from = \"1 kg\"\nto = \"2 kg\"\ncount = 9\n");
  const Ended ended = call({"sweep", "antenna/study.toml", "--out", "out", "--quiet"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(json("out/summary.json")["rung_why"].get<std::string>(), HasSubstr("; tried at 5 of 9 points"));
}

TEST_F(SweepProgram, TellsWhatItsPointsWarnOfOnce) {
  write("wide.toml", scenes::slider_in_guide("200 mm", "20 mm"));
  write("study.toml",
        "format = 1\nmechanism = \"wide.toml\"\n[[sweep.axis]]\nparameter = \"clearance.G.width_gap\"\n"
        "values = [\"0.1 mm\", \"0.12 mm\"]\n");
  const Ended ended = call({"sweep", "study.toml", "--out", "out", "--rung", "quasistatic"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out + ended.err, HasSubstr("to first order in its gaps"));
  EXPECT_THAT(ended.out + ended.err, HasSubstr("(at 2 of 2 points)"));
  const auto summary = json("out/summary.json");
  EXPECT_THAT(summary["warnings"], Contains(HasSubstr("(at 2 of 2 points)")));
  for (const auto& point : summary["points"]) EXPECT_THAT(point["warnings"], Contains(HasSubstr("about")));
  const Ended checked = call({"check", "wide.toml", "--set", "clearance.G.width_gap=0.1mm"});
  EXPECT_THAT(checked.out, HasSubstr("to first order in its gaps"));
}

// Where a rung leaves out much of a point, the point says so as a run of it does.
TEST_F(SweepProgram, WarnsOfWhatItsRungLeavesOutOfAPoint) {
  const std::string crank = std::string(BORESIGHT_EXAMPLES) + "/flores-slider-crank/flores-slider-crank.toml";
  write("study.toml",
        "format = 1\nmechanism = \"" + crank +
            "\"\n[[sweep.axis]]\nparameter = \"clearance.B.radial\"\nvalues = [\"0.4 mm\", \"0.5 mm\"]\n");
  const Ended ended =
      call({"sweep", "study.toml", "--out", "out", "--rung", "quasistatic", "--set", "motion.duration=20ms"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Ended run = call({"run", crank, "--rung", "quasistatic", "--set", "motion.duration=20ms", "--set",
                          "clearance.B.radial=0.4mm", "--out", "run"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto point = json("out/summary.json")["points"][0], alone = json("run/summary.json");
  EXPECT_GT(point["error_estimate"]["model"].get<double>(), 0.1);
  // Points are held against the dynamics at values that stand for them, within a factor of two: not to the same figure as a run of its own.
  EXPECT_GT(alone["error_estimate"]["model"].get<double>(), 0.1);
  EXPECT_EQ(point["error_estimate"]["of"], alone["error_estimate"]["of"]);
  EXPECT_THAT(point["warnings"], Contains(HasSubstr("by its own estimate")));
  EXPECT_THAT(ended.out + ended.err, HasSubstr("by its own estimate"));
  EXPECT_THAT(text("out/sweep.csv"), HasSubstr(",status,model_error\n"));
}

}  // namespace sweep_program_test
}  // namespace boresight::app
