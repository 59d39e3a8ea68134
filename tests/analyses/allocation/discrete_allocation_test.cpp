// Branch and bound against every set there is.
#include "boresight_analyses/allocation/discrete_allocation.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "boresight_analyses/allocation/gap_requirements.hpp"

namespace boresight {
namespace discrete_allocation_test {

struct Scene {
  std::vector<std::vector<double>> price;
  std::vector<std::vector<DistributionPtr>> gap;
  LinearDeviation deviation;
  UnitSamples unit;
};

// Random sensitivities in all directions, some working against each other; wider gaps never cost more.
Scene scene(std::size_t joints, std::size_t options, unsigned seed, const std::string& statistic = "max") {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0), price(1.0, 6.0);
  constexpr std::size_t kInstants = 25;
  std::vector<double> time(kInstants), offset(3 * kInstants);
  for (std::size_t i = 0; i < kInstants; ++i) time[i] = static_cast<double>(i);
  for (double& v : offset) v = 1e-6 * any(random);
  std::vector<std::vector<double>> sensitivity(joints);
  for (auto& a : sensitivity) {
    const double x = any(random), y = any(random);
    for (std::size_t i = 0; i < kInstants; ++i)
      for (const double v : {x + 0.3 * any(random), y + 0.3 * any(random), 0.5 * any(random)}) a.push_back(v);
  }
  std::vector<std::vector<double>> prices(joints);
  std::vector<std::vector<DistributionPtr>> gap(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    double dearer = 0.0;
    for (std::size_t o = 0; o < options; ++o) {
      const double width = 40e-6 / static_cast<double>(o + 1);
      prices[j].push_back(dearer += price(random));
      gap[j].push_back(make_uniform(0.25 * width, width));
    }
  }
  return {prices, gap, LinearDeviation(time, offset, sensitivity, statistic), unit_samples(joints, 150, seed)};
}

// The cheapest of all sets, one by one.
double brute_force(const std::vector<std::vector<double>>& price, const AllocationRequirement& requirement,
                   std::int64_t& meeting) {
  double best = std::numeric_limits<double>::infinity();
  std::vector<int> choice(price.size(), 0);
  for (meeting = 0;;) {
    if (requirement.is_met(choice)) {
      ++meeting;
      best = std::min(best, price_of(price, choice));
    }
    std::size_t j = 0;
    while (j < choice.size() && ++choice[j] == static_cast<int>(price[j].size())) choice[j++] = 0;
    if (j == choice.size()) return best;
  }
}

TEST(DiscreteAllocation, NoSetOfFitsIsCheaperByBruteForceOnThreeJoints) {
  int partly = 0;
  for (unsigned seed = 1; seed <= 30; ++seed)
    for (const char* statistic : {"max", "rms", "mean", "p99.73"}) {
      const Scene s = scene(3, 6, seed, statistic);
      const StatisticalRequirement requirement(s.deviation, s.gap, s.unit, 5, 30e-6);
      std::int64_t meeting = 0;
      const double best = brute_force(s.price, requirement, meeting);
      partly += meeting > 0 && meeting < 216;
      const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.gap), requirement);
      ASSERT_TRUE(found.proven);
      ASSERT_EQ(found.feasible, meeting > 0) << seed;
      if (meeting == 0) continue;
      EXPECT_TRUE(requirement.is_met(found.choice));
      EXPECT_NEAR(found.price, best, 1e-9) << seed << ' ' << statistic;
    }
  EXPECT_GT(partly, 45);  // most of the scenes have sets of either kind
}

TEST(DiscreteAllocation, IsExactOnFiveJointsForEveryWayOfJudging) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Scene s = scene(5, 4, 100 + seed);
    const StatisticalRequirement statistical(s.deviation, s.gap, s.unit, 5, 45e-6);
    const WorstCaseRequirement worst(s.deviation, s.gap, 60e-6);
    for (const AllocationRequirement* requirement :
         {static_cast<const AllocationRequirement*>(&statistical), static_cast<const AllocationRequirement*>(&worst)}) {
      std::int64_t meeting = 0;
      const double best = brute_force(s.price, *requirement, meeting);
      const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.gap), *requirement);
      EXPECT_TRUE(found.proven);
      EXPECT_EQ(found.feasible, meeting > 0);
      if (meeting == 0) continue;
      EXPECT_NEAR(found.price, best, 1e-9) << seed;
    }
  }
}

// What must be paid anyhow does not hide what may be saved beside it.
TEST(DiscreteAllocation, IsExactWhereOneJointsPricesAreATrillionTimesThoseOfTheOthers) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Scene s = scene(4, 5, 500 + seed);
    for (std::size_t o = 0; o < s.price[1].size(); ++o) s.price[1][o] += 1e12;
    const StatisticalRequirement requirement(s.deviation, s.gap, s.unit, 5, 40e-6);
    std::int64_t meeting = 0;
    const double best = brute_force(s.price, requirement, meeting);
    if (meeting == 0) continue;
    const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.gap), requirement);
    EXPECT_TRUE(found.proven);
    EXPECT_NEAR(found.price - 1e12, best - 1e12, 0.2) << seed;
    // Where the steps between its options are as dear too.
    for (std::size_t o = 0; o < s.price[1].size(); ++o) s.price[1][o] = 1e12 * static_cast<double>(o + 1);
    const double dear = brute_force(s.price, requirement, meeting);
    const DiscreteAllocation steps = allocate_discrete(s.price, tightest_options(s.gap), requirement);
    EXPECT_TRUE(steps.proven);
    EXPECT_NEAR(steps.price, dear, 0.5) << seed;
  }
}

// Gaps that work against each other: the tightest set keeps no limit that a wider one does not.
TEST(DiscreteAllocation, FindsTheCheapestWhereTheTightestSetKeepsNoLimit) {
  for (const char* statistic : {"max", "p99.73"}) {
    int beyond_the_tightest = 0;
    for (unsigned seed = 1; seed <= 80; ++seed) {
      const Scene s = scene(3, 4, 300 + seed, statistic);
      StatisticalRequirement requirement(s.deviation, s.gap, s.unit, 5, 1.0);
      requirement.set_limit(requirement.reached(tightest_options(s.gap)) * 0.95);
      std::int64_t meeting = 0;
      const double best = brute_force(s.price, requirement, meeting);
      const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.gap), requirement);
      ASSERT_TRUE(found.proven);
      ASSERT_EQ(found.feasible, meeting > 0) << seed << ' ' << statistic;
      if (meeting == 0) continue;
      ++beyond_the_tightest;
      EXPECT_NEAR(found.price, best, 1e-9) << seed << ' ' << statistic;
    }
    EXPECT_GE(beyond_the_tightest, 5) << statistic;
  }
}

TEST(DiscreteAllocation, TheInequalityHoldsForEverySetThatMeetsTheRequirement) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Scene s = scene(3, 6, 200 + seed);
    const StatisticalRequirement requirement(s.deviation, s.gap, s.unit, 5, 30e-6);
    const auto inequalities = requirement.inequalities_near(std::vector<int>{2, 3, 2});
    ASSERT_FALSE(inequalities.empty());
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        for (int c = 0; c < 6; ++c) {
          if (!requirement.is_met(std::vector<int>{a, b, c})) continue;
          for (const AdditiveInequality& i : inequalities)
            EXPECT_LE(i.weight[0][a] + i.weight[1][b] + i.weight[2][c], i.budget * (1 + 1e-12));
        }
  }
}

TEST(DiscreteAllocation, VisitsFarFewerSetsThanThereAre) {
  const Scene s = scene(10, 5, 7);  // 9.8 million sets
  StatisticalRequirement requirement(s.deviation, s.gap, s.unit, 5, 80e-6);
  const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.gap), requirement);
  ASSERT_TRUE(found.feasible);
  EXPECT_TRUE(found.proven);
  EXPECT_LT(found.nodes, 20000);
}

TEST(DiscreteAllocation, SaysThatNothingMeetsALimitBelowTheTightest) {
  const Scene s = scene(3, 6, 3);
  StatisticalRequirement requirement(s.deviation, s.gap, s.unit, 5, 1e-9);
  const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.gap), requirement);
  EXPECT_FALSE(found.feasible);
  EXPECT_TRUE(found.proven);
}

// 59 samples, none above: the least number that shows 95 % with 95 % confidence (Wilks 1941).
TEST(AllowedFailures, AreThoseOfWilks) {
  EXPECT_EQ(allowed_failures(58, 0.95, 0.95), -1);
  EXPECT_EQ(allowed_failures(59, 0.95, 0.95), 0);
  EXPECT_EQ(allowed_failures(92, 0.95, 0.95), 0);
  EXPECT_EQ(allowed_failures(93, 0.95, 0.95), 1);
}

TEST(StatisticalRequirement, ReachesThatLimitAndNoLess) {
  const Scene s = scene(4, 3, 11);
  StatisticalRequirement requirement(s.deviation, s.gap, s.unit, 4, 0.0);
  const std::vector<int> choice = {0, 1, 2, 0};
  const double reached = requirement.reached(choice);
  requirement.set_limit(reached);
  EXPECT_TRUE(requirement.is_met(choice));
  requirement.set_limit(reached * (1 - 1e-12));
  EXPECT_FALSE(requirement.is_met(choice));
}

TEST(StatisticalRequirement, ReachesTheLargestIndexWhereNoneMayExceedAndNothingWhereNoneIsEnough) {
  const Scene s = scene(3, 3, 12);
  const std::vector<int> choice = {1, 0, 2};
  const StatisticalRequirement none_may(s.deviation, s.gap, s.unit, 0, 0.0),
      not_enough(s.deviation, s.gap, s.unit, -1, 0.0);
  const std::vector<double> indices = none_may.indices(choice);
  EXPECT_EQ(none_may.reached(choice), *std::max_element(indices.begin(), indices.end()));
  EXPECT_TRUE(std::isinf(not_enough.reached(choice)));
}

// e = c1 + 2 c2, of gaps that vary alike: variances 1 : 4 of the same width, and 1 : 1 where the second is half as wide.
TEST(StatisticalRequirement, SharesTheVarianceBySensitivityAndWidth) {
  const LinearDeviation deviation({0.0}, {0, 0, 0}, {{1, 0, 0}, {2, 0, 0}}, "max");
  std::vector<double> u;
  for (int k = 0; k < 100; ++k) u.push_back((k + 0.5) / 100.0);
  const std::vector<std::vector<DistributionPtr>> gap = {{make_uniform(1e-5, 3e-5)},
                                                         {make_uniform(1e-5, 3e-5), make_uniform(1e-5, 2e-5)}};
  const StatisticalRequirement requirement(deviation, gap, {u, u}, 0, 1.0);
  const std::vector<double> alike = requirement.error_shares(std::vector<int>{0, 0}),
                            half = requirement.error_shares(std::vector<int>{0, 1});
  EXPECT_NEAR(alike[0], 0.2, 1e-12);
  EXPECT_NEAR(alike[1], 0.8, 1e-12);
  EXPECT_NEAR(half[0], 0.5, 1e-12);
  EXPECT_NEAR(half[1], 0.5, 1e-12);
  // Gaps that do not vary bring nothing.
  const StatisticalRequirement still(deviation, {{make_discrete({1e-5}, {1.0})}, {make_discrete({1e-5}, {1.0})}},
                                     {u, u}, 0, 1.0);
  EXPECT_EQ(still.error_shares(std::vector<int>{0, 0}), (std::vector<double>{0.0, 0.0}));
}

// e = 2 - c1 + c2 (mm): only the wide first gap, which stands first, keeps 1.2 mm, beside the tight second one.
TEST(RootSumSquareRequirement, MayBeMetByAnOptionThatStandsFirstAndIsNotTheTightest) {
  constexpr double kMilli = 1e-3;
  const LinearDeviation opposed({0.0}, {2.0 * kMilli, 0, 0}, {{-1, 0, 0}, {1, 0, 0}}, "max");
  const std::vector<DistributionPtr> options = {make_uniform(0.99 * kMilli, 1.01 * kMilli),
                                                make_uniform(0.09 * kMilli, 0.11 * kMilli)};
  const RootSumSquareRequirement requirement(opposed, {options, options}, 0.95, 1.2 * kMilli);
  EXPECT_TRUE(requirement.is_met(std::vector<int>{0, 1}));
  EXPECT_TRUE(requirement.may_be_met(std::vector<int>{0, -1}));
  EXPECT_FALSE(requirement.may_be_met(std::vector<int>{1, -1}));
}

// Gaps that work against each other, the widest option first: the cheapest is no option that is left out for standing first.
TEST(DiscreteAllocation, IsExactForRootSumSquaresWhateverTheOrderOfOptions) {
  int partly = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Scene s = scene(3, 4, 500 + seed);
    for (auto& options : s.gap) std::reverse(options.begin(), options.end());
    for (auto& prices : s.price) std::reverse(prices.begin(), prices.end());
    for (const double limit : {15e-6, 25e-6, 35e-6}) {
      const RootSumSquareRequirement requirement(s.deviation, s.gap, 0.95, limit);
      std::int64_t meeting = 0;
      const double best = brute_force(s.price, requirement, meeting);
      partly += meeting > 0 && meeting < 64;
      const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.gap), requirement);
      ASSERT_TRUE(found.proven);
      ASSERT_EQ(found.feasible, meeting > 0) << seed << ' ' << limit;
      if (meeting > 0) {
        EXPECT_NEAR(found.price, best, 1e-9) << seed << ' ' << limit;
      }
    }
  }
  EXPECT_GT(partly, 60);
}

}  // namespace discrete_allocation_test
}  // namespace boresight
