#include "boresight_analyses/statistics/betting_mean.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/bounded_mean.hpp"
#include "repetition.hpp"

namespace boresight {
namespace betting_mean_test {

constexpr double kConfidence = 0.95, kRisk = 1.0 - kConfidence;

double allowed(int repetitions) { return kRisk + 2.0 * std::sqrt(kRisk * (1.0 - kRisk) / repetitions); }

// Weights of a proposal that misses a region: mostly small ones, and with a small chance a large one.
TEST(BettingMean, ExcludesTheTruthNoMoreOftenThanItsRisk) {
  constexpr double kRare = 0.01, kMean = kRare * 0.9 + (1.0 - kRare) * 0.001;
  for (const int n : {20, 100, 300}) {
    int below = 0, above = 0;
    constexpr int kRepetitions = 500;
    std::mt19937_64 engine(11);
    for (int r = 0; r < kRepetitions; ++r) {
      std::vector<double> values(static_cast<std::size_t>(n));
      for (double& v : values) v = repetition::uniform(engine) < kRare ? 0.9 : 0.002 * repetition::uniform(engine);
      above += betting_lower(values, 0, kConfidence) > kMean;
      below += betting_upper(values, 0, kConfidence) < kMean;
    }
    EXPECT_LE(double(below) / kRepetitions, allowed(kRepetitions)) << n;
    EXPECT_LE(double(above) / kRepetitions, allowed(kRepetitions)) << n;
  }
}

// Looking at every sample and stopping as soon as the bound says what one hoped for. Clopper and Pearson's, which holds
// for a number of samples fixed beforehand, is misled a third of the time.
TEST(BettingMean, HoldsHoweverOftenOneLooks) {
  constexpr double kTruth = 0.1;
  constexpr int kRepetitions = 400, kMost = 2000;
  int misled = 0, misled_when_fixed = 0;
  std::mt19937_64 engine(12);
  for (int r = 0; r < kRepetitions; ++r) {
    std::int64_t hits = 0;
    bool here = false, fixed = false;
    for (int n = 1; n <= kMost; ++n) {
      hits += repetition::uniform(engine) < kTruth;
      if (n < 20 || n % 10 != 0) continue;
      here = here || betting_share_upper(hits, n, kConfidence) < kTruth;
      fixed = fixed || clopper_pearson_upper(hits, n, kConfidence) < kTruth;
    }
    misled += here;
    misled_when_fixed += fixed;
  }
  EXPECT_LE(double(misled) / kRepetitions, allowed(kRepetitions));
  EXPECT_GT(double(misled_when_fixed) / kRepetitions, 0.2);
}

// With no hit among n, half of the capital at stake: ln(2 / risk) / n, where Clopper and Pearson have ln(1 / risk) / n.
TEST(BettingMean, WithoutAHitCostsAFactorOfTwoInTheRisk) {
  for (const int n : {60, 1000, 100000}) {
    const double alone = -std::expm1(std::log(0.5 * kRisk) / n), upper = betting_share_upper(0, n, kConfidence);
    EXPECT_LE(upper, alone);  // the smaller stakes gain too
    EXPECT_GE(upper, 0.98 * alone);
    EXPECT_LT(clopper_pearson_upper(0, n, kConfidence), upper);
  }
  EXPECT_EQ(betting_share_lower(0, 50, kConfidence), 0.0);
}

TEST(BettingMean, NarrowsWithTheScatterAndTheNumber) {
  const std::vector<double> narrow(400, 0.5);
  EXPECT_LT(betting_upper(narrow, 0, kConfidence) - betting_lower(narrow, 0, kConfidence), 0.02);
  double last = 1.0;
  for (const int n : {100, 1000, 10000}) {
    const double upper = betting_share_upper(n / 10, n, kConfidence);
    EXPECT_LT(upper, last);
    EXPECT_LT(upper - 0.1, 3.0 * (clopper_pearson_upper(n / 10, n, kConfidence) - 0.1));
    last = upper;
  }
}

TEST(BettingMean, TakesValuesOneByOneOrCounted) {
  std::vector<double> values(50, 0.0);
  values[0] = values[1] = 1.0;
  EXPECT_NEAR(betting_upper(values, 0, 0.9), betting_share_upper(2, 50, 0.9), 1e-9);
  EXPECT_NEAR(betting_upper({values.data(), 2}, 48, 0.9), betting_share_upper(2, 50, 0.9), 1e-9);
  EXPECT_NEAR(betting_lower(values, 0, 0.9), betting_share_lower(2, 50, 0.9), 1e-9);
  EXPECT_THROW(betting_lower(std::vector<double>{1.5}, 0, 0.9), std::invalid_argument);
  EXPECT_THROW(betting_lower({}, 0, 0.9), std::invalid_argument);
}

// Of as many values as Hoeffding's bound was for it is no worse than that, and equal where every value is 0 or 1.
TEST(FirstBet, IsHoeffdingsBoundWhereItBegins) {
  for (const std::int64_t n : {60, 200}) {
    for (const std::int64_t zeros : {0, 1, 5}) {
      const double mean = double(n - zeros) / double(n);
      EXPECT_NEAR(first_bet_lower(n, {}, n - zeros, zeros, kConfidence),
                  bounded_mean_lower(mean, double(n), kConfidence), 1e-6);
      const std::vector<double> level(static_cast<std::size_t>(n), mean);
      EXPECT_GE(first_bet_lower(n, level, 0, 0, kConfidence), bounded_mean_lower(mean, double(n), kConfidence) - 1e-9);
    }
  }
  EXPECT_THROW(first_bet_lower(0, {}, 5, 0, kConfidence), std::invalid_argument);
  EXPECT_THROW(first_bet_lower(5, {}, 0, 0, kConfidence), std::invalid_argument);
}

// The first look by Hoeffding's bound at 60 values, the later ones by its bet: of means that are just the truth, hit or miss or
// spread evenly.
TEST(FirstBet, KeepsTheRiskTogetherWithTheFirstLookHoweverOftenOneLooks) {
  constexpr double kTruth = 0.9;
  constexpr int kRepetitions = 500, kFirst = 60;
  for (const bool spread : {false, true}) {
    int misled = 0, misled_by_hoeffding = 0;
    std::mt19937_64 engine(13);
    for (int r = 0; r < kRepetitions; ++r) {
      std::vector<double> values;
      bool here = false, hoeffding = false;
      double sum = 0.0;
      for (int n = kFirst; n <= 1500; n += n / 4) {
        while (static_cast<int>(values.size()) < n) {
          const double u = repetition::uniform(engine);
          values.push_back(spread ? 0.8 + 0.2 * u : (u < kTruth ? 1.0 : 0.0));
          sum += values.back();
        }
        const bool fixed = bounded_mean_lower(sum / n, n, kConfidence) > kTruth;
        hoeffding = hoeffding || fixed;
        here = here || (n == kFirst ? fixed : first_bet_lower(kFirst, values, 0, 0, kConfidence) > kTruth);
      }
      misled += here;
      misled_by_hoeffding += hoeffding;
    }
    std::printf("%s: misled %.3f (by Hoeffding's bound each time: %.3f), nominal %.3f\n",
                spread ? "spread" : "hit or miss", double(misled) / kRepetitions,
                double(misled_by_hoeffding) / kRepetitions, kRisk);
    EXPECT_LE(double(misled) / kRepetitions, allowed(kRepetitions)) << spread;
  }
}

}  // namespace betting_mean_test
}  // namespace boresight
