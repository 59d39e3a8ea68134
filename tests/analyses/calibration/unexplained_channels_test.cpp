// What is said of channels whose readings the fitted model does not explain.
#include "boresight_analyses/calibration/unexplained_channels.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace boresight {
namespace unexplained_channels_test {

using testing::HasSubstr;

// Two rotations of one run: what the model foretells of them, by pose.
const std::vector<int> kBxAndBy = {6, 7};

struct Readings {
  CalibrationProblem problem;
  Inference inference;
  std::mt19937_64 engine{7};

  Readings() {
    problem.channels = kBxAndBy;
    problem.runs.resize(1);
  }
  // A motion of `moves`, read `factor` times and with so much noise.
  void add(int channel, double moves, double factor, double noise, int count = 40) {
    std::normal_distribution<double> normal;
    ResidualSeries series{0, channel, {}, {}, {}, {}};
    for (int i = 0; i < count; ++i) {
      const double model = moves * std::sin(0.7 * i + channel);
      series.time.push_back(i);
      series.model.push_back(model);
      series.measured.push_back(factor * model + 3e-5 + noise * normal(engine));
    }
    inference.residuals.push_back(series);
  }
  std::vector<UnexplainedChannel> found() const { return unexplained_channels(problem, inference); }
};

TEST(UnexplainedChannels, AreNoneWhereTheModelLeavesNoise) {
  Readings readings;
  readings.add(0, 1e-4, 1.0, 5e-6);
  readings.add(1, 1e-4, 1.0, 1e-6);
  EXPECT_TRUE(readings.found().empty());
}

TEST(UnexplainedChannels, AreNoneWhereNothingMovesAndNoiseIsRead) {
  Readings readings;
  readings.add(0, 1e-4, 1.0, 5e-6);
  readings.add(1, 0.0, 1.0, 5e-6);
  EXPECT_TRUE(readings.found().empty());
}

TEST(UnexplainedChannels, AreNoneWhereExactReadingsLeaveRounding) {
  Readings readings;
  readings.add(0, 1e-4, 1.0 + 1e-12, 0.0);
  readings.add(1, 1e-16, 0.0, 0.0);
  EXPECT_TRUE(readings.found().empty());
}

TEST(UnexplainedChannels, AreASensorThatStandsStillAndOneWithTheOtherSign) {
  for (const double factor : {0.0, -1.0}) {
    Readings readings;
    readings.add(0, 1e-4, 1.0, 5e-6);
    readings.add(1, 1e-4, factor, 0.0);
    const std::vector<UnexplainedChannel> found = readings.found();
    ASSERT_EQ(found.size(), 1u) << factor;
    EXPECT_EQ(found[0].channel, 7);
    EXPECT_THAT(found[0].says,
                HasSubstr(factor == 0.0 ? "by: these readings show 0 times" : "by: these readings show -1 times"))
        << factor;
  }
}

TEST(UnexplainedChannels, AreReadingsWhoseHeaderHasAnotherUnit) {
  for (const double factor : {3600.0, 1000.0, 1.0 / 3600.0}) {
    Readings readings;
    readings.add(0, 1e-4, factor, 5e-6 * factor);
    readings.add(1, 1e-4, 1.0, 5e-6);
    const std::vector<UnexplainedChannel> found = readings.found();
    ASSERT_EQ(found.size(), 1u) << factor;
    EXPECT_EQ(found[0].channel, 6);
    EXPECT_THAT(found[0].says, HasSubstr("another unit than the header says")) << factor;
  }
}

// As few readings as hold a calibration, in noise as large as the motion.
TEST(UnexplainedChannels, AreNoneWhereNoiseHidesTheMotion) {
  int named = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Readings readings;
    readings.engine.seed(static_cast<unsigned>(seed));
    readings.add(0, 1e-4, 1.0, 1e-4, 20);
    readings.add(1, 1e-4, 1.0, 1e-4, 20);
    named += static_cast<int>(readings.found().size());
  }
  EXPECT_LE(named, 4) << "of 400";
}

}  // namespace unexplained_channels_test
}  // namespace boresight
