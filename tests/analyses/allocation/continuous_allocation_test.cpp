// Allocations over cost curves, against Chase's closed form.
//
// Chase (1999), "Minimum-cost tolerance allocation", ADCATS report 99-5: for costs A_j + B_j / t_j^k the
// Lagrange conditions give, with sensitivities s_j,
//   worst case:       t_j = (k B_j / (lambda s_j))^(1/(k+1)),       sum s_j t_j = T
//   root-sum-square:  t_j = (k B_j / (2 lambda s_j^2))^(1/(k+2)),   sqrt(sum (s_j t_j)^2) = T
#include "boresight_analyses/allocation/continuous_allocation.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight_analyses/allocation/gap_requirements.hpp"

namespace boresight {
namespace continuous_allocation_test {

const std::vector<double> kSensitivity = {1.0, 1.9, 0.6, 2.4};
const std::vector<double> kB = {0.5, 0.2, 1.0, 0.35};

std::vector<ContinuousTolerance> joints(double exponent) {
  std::vector<ContinuousTolerance> all;
  for (const double b : kB) all.push_back({make_cost_curve("reciprocal-power", 1.0, b, exponent, 1e-3), 1e-7, 1e-2});
  return all;
}

double worst(std::span<const double> t, std::span<double> g) {
  double sum = 0.0;
  for (std::size_t j = 0; j < t.size(); ++j) sum += kSensitivity[j] * t[j];
  for (std::size_t j = 0; j < g.size(); ++j) g[j] = kSensitivity[j];
  return sum;
}

double root_sum_square(std::span<const double> t, std::span<double> g) {
  double squares = 0.0;
  for (std::size_t j = 0; j < t.size(); ++j) squares += std::pow(kSensitivity[j] * t[j], 2);
  const double root = std::sqrt(squares);
  for (std::size_t j = 0; j < g.size(); ++j) g[j] = kSensitivity[j] * kSensitivity[j] * t[j] / root;
  return root;
}

TEST(ContinuousAllocation, IsChasesClosedFormForTheWorstCase) {
  constexpr double kLimit = 2e-4;
  for (const double k : {1.0, 2.0, 0.7}) {
    double sum = 0.0;
    std::vector<double> expected;
    for (std::size_t j = 0; j < kB.size(); ++j) {
      expected.push_back(std::pow(kB[j] / kSensitivity[j], 1.0 / (k + 1.0)));
      sum += kSensitivity[j] * expected.back();
    }
    const ContinuousAllocation found = allocate_continuous(joints(k), worst, kLimit);
    ASSERT_TRUE(found.feasible);
    EXPECT_TRUE(found.converged);
    for (std::size_t j = 0; j < kB.size(); ++j)
      EXPECT_NEAR(found.tolerance[j] / (expected[j] * kLimit / sum), 1.0, 1e-6) << found.why;
    EXPECT_NEAR(found.reached / kLimit, 1.0, 1e-9);
  }
}

TEST(ContinuousAllocation, IsChasesClosedFormForTheRootSumSquare) {
  constexpr double kLimit = 2e-4;
  for (const double k : {1.0, 2.0}) {
    double squares = 0.0;
    std::vector<double> expected;
    for (std::size_t j = 0; j < kB.size(); ++j) {
      expected.push_back(std::pow(kB[j] / std::pow(kSensitivity[j], 2), 1.0 / (k + 2.0)));
      squares += std::pow(kSensitivity[j] * expected.back(), 2);
    }
    const ContinuousAllocation found = allocate_continuous(joints(k), root_sum_square, kLimit);
    for (std::size_t j = 0; j < kB.size(); ++j)
      EXPECT_NEAR(found.tolerance[j] / (expected[j] * kLimit / std::sqrt(squares)), 1.0, 1e-6) << found.why;
  }
}

TEST(ContinuousAllocation, KeepsATightToleranceAtItsBoundAndSharesOutTheRest) {
  std::vector<ContinuousTolerance> all = joints(1.0);
  all[0].upper = 1e-6;
  const ContinuousAllocation found = allocate_continuous(all, worst, 2e-4);
  EXPECT_NEAR(found.tolerance[0], 1e-6, 1e-12);
  EXPECT_NEAR(found.reached / 2e-4, 1.0, 1e-9);
  // The others keep Chase's proportion.
  EXPECT_NEAR(found.tolerance[1] / found.tolerance[2],
              std::sqrt(kB[1] / kSensitivity[1]) / std::sqrt(kB[2] / kSensitivity[2]), 1e-6);
}

// What has to be paid anyhow says nothing of how the rest is shared out.
TEST(ContinuousAllocation, SharesOutSmallPricesBesideALargeOneThatIsPaidAnyhow) {
  constexpr double kLimit = 2e-4, kDear = 1e12;
  std::vector<ContinuousTolerance> all = joints(1.0);
  all[1].cost = make_cost_curve("reciprocal", kDear, kB[1], 1.0, 1e-3);
  double sum = 0.0;
  for (std::size_t j = 0; j < kB.size(); ++j) sum += std::sqrt(kB[j] * kSensitivity[j]);
  const ContinuousAllocation found = allocate_continuous(all, worst, kLimit);
  ASSERT_TRUE(found.feasible);
  for (std::size_t j = 0; j < kB.size(); ++j)
    EXPECT_NEAR(found.tolerance[j] / (std::sqrt(kB[j] / kSensitivity[j]) * kLimit / sum), 1.0, 1e-5) << j;
}

// A joint so dear that it is as wide as it may be: the others keep Chase's proportion.
TEST(ContinuousAllocation, SharesOutSmallPricesBesideADearJointAtItsBound) {
  std::vector<ContinuousTolerance> all = joints(1.0);
  all[0].cost = make_cost_curve("reciprocal", 1.0, 1e12, 1.0, 1e-3);
  all[0].upper = 1e-5;
  const ContinuousAllocation found = allocate_continuous(all, worst, 2e-4);
  EXPECT_NEAR(found.tolerance[0], 1e-5, 1e-11);
  EXPECT_NEAR(found.reached / 2e-4, 1.0, 1e-6);
  for (const std::size_t j : {std::size_t{1}, std::size_t{3}})
    EXPECT_NEAR(found.tolerance[j] / found.tolerance[2] /
                    (std::sqrt(kB[j] / kSensitivity[j]) / std::sqrt(kB[2] / kSensitivity[2])),
                1.0, 1e-4)
        << j;
}

TEST(ContinuousAllocation, SaysWhatTheTightestReachWhereTheLimitIsBelowIt) {
  const ContinuousAllocation found = allocate_continuous(joints(1.0), worst, 1e-8);
  EXPECT_FALSE(found.feasible);
  EXPECT_NEAR(found.reached, 1e-7 * (1.0 + 1.9 + 0.6 + 2.4), 1e-12);
}

// One joint: the index is s (least + t z), so the tolerance follows from the order statistic of z itself.
TEST(ContinuousAllocation, WithSamplesPutsTheRequiredOrderStatisticOnTheLimit) {
  const LinearDeviation deviation({0.0, 1.0}, {0, 0, 0, 0, 0, 0}, {{1.5, 0, 0, 2.0, 0, 0}}, "max");
  std::vector<double> z(200);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = (static_cast<double>(k) + 0.5) / 200.0;
  const auto requirement = statistical_tolerances(deviation, {1e-5}, {z}, 9);  // the tenth largest: z = 190.5 / 200
  const ContinuousAllocation found =
      allocate_continuous({{make_cost_curve("reciprocal", 0, 1, 1, 1e-3), 1e-7, 1e-2}}, requirement, 1e-4);
  EXPECT_NEAR(found.tolerance[0], (1e-4 / 2.0 - 1e-5) / (190.5 / 200.0), 1e-11);
}

// Where gaps work against each other the least is inside: here at 30 um and 2 mm, in the logarithms of both.
TEST(ContinuousAllocation, FindsTheToleranceBetweenItsEndsThatPointsBest) {
  const std::vector<double> best = {3e-5, 2e-3};
  const ToleranceRequirement valley = [&](std::span<const double> t, std::span<double> g) {
    const double a = std::log(t[0] / best[0]), b = std::log(t[1] / best[1]);
    if (!g.empty()) {
      g[0] = 1e-4 * (2.0 * a + b) / t[0];
      g[1] = 1e-4 * (a + 4.0 * b) / t[1];
    }
    return 1e-4 * (1.0 + a * a + a * b + 2.0 * b * b);
  };
  std::vector<ContinuousTolerance> all = joints(1.0);
  all.resize(2);
  const std::vector<double> found = least_tolerances(all, valley);
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(found[j] / best[j], 1.0, 1e-3) << j;
}

TEST(CostCurve, HasTheSlopeOfItsPrice) {
  for (const std::string& law : cost_law_names()) {
    const CostCurve curve = make_cost_curve(law, 2.0, 0.3, 1.7, 1e-3);
    const double t = 4e-4, h = 1e-9;
    EXPECT_NEAR(curve.slope(t), (curve.price(t + h) - curve.price(t - h)) / (2 * h), 1e-5 * std::abs(curve.slope(t)))
        << law;
  }
}

TEST(CostCurve, TakesItsNumbersInTheUnitGiven) {
  EXPECT_DOUBLE_EQ(make_cost_curve("reciprocal-squared", 3.0, 0.02, 0, 1e-3).price(1e-4), 3.0 + 0.02 / 0.01);
  EXPECT_DOUBLE_EQ(make_cost_curve("exponential", 8.0, 2.0, 0, 1e-3).price(5e-4), 8.0 * std::exp(-1.0));
}

// Two gaps in one direction, beside an error that is there without them: by hand.
TEST(RootSumSquare, AddsTheMiddlesAndAThirdOfEachHalfWidthAsItsDeviation) {
  const LinearDeviation deviation({0.0}, {3e-4, 0, 0}, {{1, 0, 0}, {2, 0, 0}}, "max");
  const std::vector<double> middle = {1e-4, 1e-4}, half = {3e-5, 6e-5};
  EXPECT_NEAR(root_sum_square_index(deviation, middle, half, 2.0), 6e-4 + 2.0 * std::hypot(1e-5, 4e-5), 1e-15);
  // Gaps of at least 70 and 40 um whose tolerances are 60 and 120 um are these.
  const ToleranceRequirement requirement = root_sum_square_tolerances(deviation, {{1e-4 - 3e-5, 1e-4 - 6e-5}}, 0.95);
  std::vector<double> gradient(2);
  const double one_sided = 1.6448536269514722;
  EXPECT_NEAR(requirement(std::vector<double>{6e-5, 1.2e-4}, gradient), 6e-4 + one_sided * std::hypot(1e-5, 4e-5),
              1e-12);
  EXPECT_NEAR(gradient[0], 0.5 * 1.0 + one_sided / 6.0 * 1e-5 / std::hypot(1e-5, 4e-5), 1e-4);
  EXPECT_NEAR(gradient[1], 0.5 * 2.0 + one_sided / 3.0 * 4e-5 / std::hypot(1e-5, 4e-5), 1e-4);
}

TEST(LinearDeviation, ThatStandsStillHasOneValueForEveryStatistic) {
  for (const char* statistic : {"max", "rms", "mean"}) {
    const LinearDeviation deviation({0.0, 0.1, 0.5, 0.6, 2.0}, {3, 4, 0, 4, 3, 0, 0, 5, 0, 0, 0, 5, 5, 0, 0},
                                    {std::vector<double>(15, 0.0)}, statistic);
    EXPECT_NEAR(deviation.index(std::vector<double>{1e-4}), 5.0, 1e-12) << statistic;
  }
}

}  // namespace continuous_allocation_test
}  // namespace boresight
