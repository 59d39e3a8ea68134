// Hoeffding's bound of a bounded mean: its known limits, and that it holds.
#include "boresight_analyses/statistics/bounded_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "boresight_analyses/random/counter_stream.hpp"
#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {
namespace bounded_mean_test {

TEST(BoundedMean, WithEveryValueAtOneIsWilksAndClopperPearson) {
  for (const int n : {10, 59, 852}) {
    EXPECT_NEAR(bounded_mean_lower(1.0, n, 0.9), clopper_pearson_lower(n, n, 0.9), 1e-12);
    EXPECT_NEAR(bounded_mean_upper(0.0, n, 0.9), clopper_pearson_upper(0, n, 0.9), 1e-12);
  }
  EXPECT_EQ(mean_that_shows(0.95, 58, 0.95), 2.0);  // 95/95 takes 59
  EXPECT_LE(mean_that_shows(0.95, 59, 0.95), 1.0);
}

TEST(BoundedMean, IsNeverTighterThanTheExactBoundOfSharesOfHits) {
  for (const int hits : {3, 50, 97}) {
    EXPECT_LE(bounded_mean_lower(hits / 100.0, 100, 0.95), clopper_pearson_lower(hits, 100, 0.95));
    EXPECT_GE(bounded_mean_upper(hits / 100.0, 100, 0.95), clopper_pearson_upper(hits, 100, 0.95));
  }
}

TEST(BoundedMean, IsInvertedByTheMeanThatShowsATarget) {
  const double mean = mean_that_shows(0.9, 200, 0.95);
  EXPECT_NEAR(bounded_mean_lower(mean, 200, 0.95), 0.9, 1e-10);
  EXPECT_NEAR(bounded_mean_upper(mean_that_denies(0.9, 200, 0.95), 200, 0.95), 0.9, 1e-10);
}

TEST(BoundedMean, HoldsAtLeastAsOftenAsItsConfidence) {
  constexpr int kTrials = 2000, kSamples = 40;
  const CounterStream stream(11, StreamPurpose::sample);
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    double sum = 0.0;  // of sqrt(u), whose mean is 2/3
    for (int k = 0; k < kSamples; ++k)
      sum += std::sqrt(stream.uniform(static_cast<std::uint64_t>(trial), static_cast<std::uint64_t>(k)));
    held += bounded_mean_lower(sum / kSamples, kSamples, 0.9) <= 2.0 / 3.0;
  }
  EXPECT_GE(held, 0.9 * kTrials);
}

TEST(BoundedMean, RefusesWhatIsNoShare) {
  EXPECT_THROW(bounded_mean_lower(1.1, 10, 0.9), std::invalid_argument);
  EXPECT_THROW(bounded_mean_lower(0.5, 0, 0.9), std::invalid_argument);
  EXPECT_THROW(bounded_mean_lower(0.5, 10, 1.0), std::invalid_argument);
}

// A handful of hits in two hundred thousand: nothing is shown, and nothing fails.
TEST(BoundedMean, OfNextToNothingShowsNothing) {
  for (const double mean : {1e-300, 1e-12, 5e-6, 3e-5})
    for (const double samples : {1.0, 10.0, 100.0}) {
      const double low = bounded_mean_lower(mean, samples, 0.9);
      EXPECT_GE(low, 0.0);
      EXPECT_LT(low, mean);
      const double high = bounded_mean_upper(1.0 - mean, samples, 0.9);
      EXPECT_GE(high, 1.0 - mean);
      EXPECT_LE(high, 1.0);
    }
}

}  // namespace bounded_mean_test
}  // namespace boresight
