// How noisy a channel is taken to be by its own readings.
#include "boresight_analyses/calibration/channel_noise.hpp"

#include <gtest/gtest.h>

#include <random>

#include "four_bar_rig.hpp"

namespace boresight {
namespace channel_noise_test {

CalibrationProblem of_one_channel(const std::vector<double>& readings) {
  MeasuredData data;
  data.channels = {0};
  data.value.resize(static_cast<Eigen::Index>(readings.size()), 1);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // Within the motion, which lasts 0.05 s.
    data.time.push_back(0.05 * static_cast<double>(i) / static_cast<double>(readings.size()));
    data.line.push_back(static_cast<int>(i) + 2);
    data.value(static_cast<Eigen::Index>(i), 0) = readings[i];
  }
  CalibrationProblem problem;
  problem.runs.emplace_back("run", four_bar::mechanism(2.0, 0.05), data);
  problem.prepare(10.0, true);
  return problem;
}

TEST(NoiseFromDifferences, IsTheDeviationOfWhiteNoiseOnAMotion) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  std::vector<double> readings;
  for (int i = 0; i < 4000; ++i) readings.push_back(1e-3 * std::sin(0.01 * i) + 3e-6 * normal(engine));
  // The median of 4000 sizes of which three neighbours share readings scatters by some 2 %.
  EXPECT_NEAR(noise_from_differences(of_one_channel(readings))[0], 3e-6, 0.2e-6);
}

// Without any noise, a millionth of what nine tenths of the readings stay within: a wrong one among them says
// nothing.
TEST(NoiseFromDifferences, OfExactDataIsAMillionthOfTheirSize) {
  std::vector<double> readings;
  for (int i = 0; i < 22; ++i) readings.push_back(1e-3 * i);
  // Of 1 to 20, which have a neighbour on either side, the 18th of 20.
  EXPECT_NEAR(noise_from_differences(of_one_channel(readings))[0], 18e-9, 1e-15);
  readings[10] = 1e3;
  EXPECT_NEAR(noise_from_differences(of_one_channel(readings))[0], 19e-9, 1e-15);
}

// Of a slow sensor in the table of a fast one, no three rows in a row have a reading.
TEST(NoiseFromDifferences, OfAChannelThatIsReadEverySecondRowIsThatOfItsReadings) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  std::vector<double> readings;
  for (int i = 0; i < 8000; ++i)
    readings.push_back(i % 2 == 0 ? 1e-3 * std::sin(0.005 * i) + 3e-6 * normal(engine)
                                  : std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(noise_from_differences(of_one_channel(readings))[0], 3e-6, 0.2e-6);
}

TEST(NoiseFromDifferences, IsNoLessThanTheLastDigitOfReadingsLeaves) {
  std::vector<double> readings;
  for (int i = 0; i < 8000; ++i) readings.push_back(1e-6 * std::round(1e6 * 1e-5 * std::sin(0.001 * i)));
  EXPECT_NEAR(noise_from_differences(of_one_channel(readings))[0], 1e-6 / std::sqrt(12.0), 1e-12);
}

}  // namespace channel_noise_test
}  // namespace boresight
