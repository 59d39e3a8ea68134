// Paired samples tell what ways of computing differ by, in the mean and far out.
#include "boresight_analyses/study/scatter_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace boresight {
namespace scatter_comparison_test {

struct Pairs {
  std::vector<double> x, y;
};

// What the samples scatter by is shared, what impacts do is not.
Pairs draw(std::mt19937_64& engine, std::size_t n, double shift, double noise) {
  std::normal_distribution<double> normal;
  Pairs p;
  for (std::size_t k = 0; k < n; ++k) {
    const double shared = 1.0 + 0.1 * normal(engine);
    p.x.push_back(shared * (1.0 + shift) + noise * normal(engine));
    p.y.push_back(shared + noise * normal(engine));
  }
  return p;
}

TEST(ScatterComparison, FindsTheDifferenceWithinItsInterval) {
  std::mt19937_64 engine(1);
  for (const double p : {0.0, 0.95, 0.9973}) {
    int covered = 0;
    double width = 0.0;
    constexpr int kRepetitions = 400;
    for (int k = 0; k < kRepetitions; ++k) {
      const Pairs pairs = draw(engine, 24, 0.02, 0.01);
      const ScatterDifference d = compare_scatter(pairs.x, pairs.y, {}, {p});
      covered += std::abs(d.difference - 0.02) <= d.half_width;
      width += d.half_width / kRepetitions;
    }
    EXPECT_GE(covered, static_cast<int>(0.91 * kRepetitions)) << p;
    // Unpaired, the mean alone would be uncertain by 0.1 * sqrt(2 / 24) * 2.
    EXPECT_LE(width, p == 0.0 ? 0.008 : 0.02) << p;
  }
}

TEST(ScatterComparison, SeesWhatOnlyOneWayScattersBy) {
  // A way without impacts has the same mean and too small a quantile far out.
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  std::vector<double> calm, rough;
  for (int k = 0; k < 4000; ++k) {
    calm.push_back(1.0 + 0.05 * normal(engine));
    rough.push_back(calm.back() + 0.05 * normal(engine));
  }
  EXPECT_NEAR(compare_scatter(calm, rough, {}, {}).difference, 0.0, 0.004);
  const double expected = (1.0 + 1.645 * 0.05) / (1.0 + 1.645 * 0.05 * std::sqrt(2.0)) - 1.0;
  EXPECT_NEAR(compare_scatter(calm, rough, {}, {0.95}).difference, expected, 0.006);
}

TEST(ScatterComparison, PairsFromTheTailSayMoreAboutItAndNothingElse) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  double plain_width = 0.0, chosen_width = 0.0, chosen_mean = 0.0;
  constexpr int kRepetitions = 200;
  for (int r = 0; r < kRepetitions; ++r) {
    const Pairs pairs = draw(engine, 256, 0.02, 0.01);
    // The cheap way that ranks the samples is one of those that are compared: chance has brought its best ones there.
    const ChosenSamples chosen = choose_samples(pairs.x, 256, 24, {0.9973});
    ASSERT_EQ(chosen.sample.size(), 24u);
    ASSERT_EQ(chosen.score.size(), 24u);
    std::vector<double> x, y;
    for (std::size_t k : chosen.sample) x.push_back(pairs.x[k]), y.push_back(pairs.y[k]);
    const ScatterDifference from_tail = compare_scatter(x, y, chosen.score, {0.9973});
    chosen_width += from_tail.half_width / kRepetitions;
    chosen_mean += from_tail.difference / kRepetitions;
    plain_width +=
        compare_scatter(std::span(pairs.x).first(24), std::span(pairs.y).first(24), {}, {0.9973}).half_width /
        kRepetitions;
  }
  EXPECT_LT(chosen_width, plain_width);
  EXPECT_NEAR(chosen_mean, 0.02, 0.002);
}

TEST(ScatterComparison, SaysNothingOfThreePairs) {
  const std::vector<double> x = {1.0, 1.1, 0.9};
  EXPECT_TRUE(std::isinf(compare_scatter(x, x, {}, {}).half_width));
}

TEST(ScatterComparison, AgreesWhereBothAreNothingButRounding) {
  const std::vector<double> x = {1e-12, 2e-12, 1e-12, 0.0, 3e-12}, y = {0.0, 0.0, 1e-12, 2e-12, 0.0};
  EXPECT_EQ(compare_scatter(x, y, {}, {0.95}).bound(), 0.0);
}

TEST(ChosenSamples, ComeAsTheyAreWhereNothingRanksThem) {
  const ChosenSamples chosen = choose_samples({}, 100, 5, {0.99});
  EXPECT_EQ(chosen.sample, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(chosen.score.empty());
}

TEST(ChosenSamples, AreTakenOnceEach) {
  std::vector<double> ranked_by;
  for (int k = 0; k < 256; ++k) ranked_by.push_back(std::sin(7.0 * k));
  const ChosenSamples chosen = choose_samples(ranked_by, 256, 96, {0.95});
  std::vector<std::size_t> sorted = chosen.sample;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
  EXPECT_EQ(sorted.size(), 96u);
}

// Every second one from the tail, as they come in it; the farthest out belongs to it.
TEST(ChosenSamples, TakeTheTailFromItsVeryEnd) {
  for (const bool high : {true, false}) {
    std::vector<double> ranked_by;
    for (int k = 0; k < 256; ++k) ranked_by.push_back(high ? k : -k);
    ranked_by[10] = high ? 1000.0 : -1000.0;
    const ChosenSamples chosen = choose_samples(ranked_by, 256, 24, {high ? 0.95 : 0.05});
    ASSERT_EQ(chosen.sample.size(), 24u);
    // 3 * 5 % of 256 are 38: number 10 and the last 37.
    EXPECT_EQ(chosen.sample[0], 0u);
    EXPECT_EQ(chosen.sample[1], 10u);
    EXPECT_EQ(chosen.sample[2], 1u);
    EXPECT_EQ(chosen.sample[3], 219u);
    for (std::size_t k = 1; k < chosen.sample.size(); ++k) EXPECT_EQ(chosen.score[k] > chosen.score[0], high) << k;
  }
}

}  // namespace scatter_comparison_test
}  // namespace boresight
