#include "boresight_analyses/statistics/running.hpp"

#include <gmock/gmock.h>
#include <gsl/gsl_cdf.h>

#include "boresight_analyses/statistics/independent_samples.hpp"
#include "repetition.hpp"

namespace boresight {
namespace running_test {

std::vector<double> exponentials(int n) {
  std::mt19937_64 engine(3);
  std::vector<double> values(n);
  for (double& v : values) v = -1e-4 * std::log(repetition::uniform(engine));
  return values;
}

TEST(RunningMoments, MeetTheSamplesTheySaw) {
  RunningMoments running, first, second;
  const std::vector<double> values = exponentials(5000);
  for (std::size_t k = 0; k < values.size(); ++k) {
    running.add(values[k]);
    (k < 1234 ? first : second).add(values[k]);
  }
  const IndependentSamples all(values);
  first.merge(second);
  for (const RunningMoments& m : {running, first}) {
    EXPECT_NEAR(m.mean(), all.mean(0.95).value, 1e-12 * m.mean());
    EXPECT_NEAR(m.sd(), all.sd(0.95).value, 1e-12 * m.sd());
    // Student's alone: what is drawn while samples come knows no skewness.
    const double half = gsl_cdf_tdist_Pinv(0.95, 4999.0) * m.sd() / std::sqrt(5000.0);
    EXPECT_NEAR(m.mean_interval(0.9).high, m.mean() + half, 1e-12 * m.mean());
    EXPECT_NEAR(m.mean_interval(0.9).high, all.mean(0.9).high, 1e-3 * m.mean());
  }
}

TEST(RunningQuantiles, MeetTheOrderStatisticsToTheirAccuracy) {
  RunningQuantiles running(1e-3), first(1e-3), second(1e-3);
  std::vector<double> values = exponentials(5000);
  values[17] = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    running.add(values[k]);
    (k % 3 ? first : second).add(values[k]);
  }
  for (int k = 0; k < 3; ++k) {
    running.add_failed();
    second.add_failed();
  }
  first.merge(second);
  const IndependentSamples all(values, 3);
  for (const double p : {0.5, 0.95, 0.9973}) {
    const IndependentInterval exact = all.quantile(p, 0.95), one = running.quantile(p, 0.95),
                              two = first.quantile(p, 0.95);
    EXPECT_NEAR(one.value, exact.value, 0.01 * exact.value);
    EXPECT_LE(one.low, exact.low);
    EXPECT_GE(one.low, exact.low * (1.0 - 2.1e-3));
    EXPECT_GE(one.high, exact.high);
    EXPECT_LE(one.high, exact.high * (1.0 + 2.1e-3));
    EXPECT_EQ(one.coverage, exact.coverage);
    EXPECT_EQ(one.value, two.value);
    EXPECT_EQ(one.low, two.low);
    EXPECT_EQ(one.high, two.high);
  }
}

TEST(RunningQuantiles, RefuseWhatIsNoSample) {
  RunningQuantiles running;
  EXPECT_THROW(running.add(-1.0), std::invalid_argument);
  EXPECT_THROW(running.add(std::nan("")), std::invalid_argument);
  EXPECT_THROW(running.merge(RunningQuantiles(1e-2)), std::invalid_argument);
  EXPECT_THROW(running.quantile(0.5, 0.95), std::invalid_argument);
}

}  // namespace running_test
}  // namespace boresight
