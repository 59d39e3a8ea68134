#include "boresight_analyses/sensitivity/sobol_indices.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>

#include "repetition.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace sobol_indices_test {

using std::numbers::pi;

BatchModel pointwise(double (*f)(const Point&)) {
  return [f](const Points& points) {
    std::vector<double> values;
    for (const Point& p : points) values.push_back(f(p));
    return values;
  };
}

// Ishigami and Homma (1990), a = 7, b = 0.1, x in (-pi, pi).
double ishigami(const Point& u) {
  const double x = pi * (2.0 * u[0] - 1.0), y = pi * (2.0 * u[1] - 1.0), z = pi * (2.0 * u[2] - 1.0);
  return std::sin(x) + 7.0 * std::sin(y) * std::sin(y) + 0.1 * z * z * z * z * std::sin(x);
}
// In closed form: V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2, V_1 = (1 + b pi^4/5)^2 / 2, V_2 = a^2/8, V_13 = 8 b^2 pi^8/225.
struct Ishigami {
  double p4 = std::pow(pi, 4), v1 = 0.5 * std::pow(1.0 + 0.02 * p4, 2), v2 = 49.0 / 8.0, v13 = 0.08 * p4 * p4 / 225.0;
  double v = v1 + v2 + v13;
  std::vector<double> first = {v1 / v, v2 / v, 0.0}, total = {(v1 + v13) / v, v2 / v, v13 / v};
};

// Saltelli and Sobol' (1995): product of (|4 x_i - 2| + a_i) / (1 + a_i); V_i = 1 / (3 (1 + a_i)^2).
const std::vector<double> kG = {0.0, 1.0, 4.5, 9.0, 99.0, 99.0};
double g_function(const Point& u) {
  double y = 1.0;
  for (std::size_t i = 0; i < kG.size(); ++i) y *= (std::abs(4.0 * u[i] - 2.0) + kG[i]) / (1.0 + kG[i]);
  return y;
}
double g_part(std::size_t i) { return 1.0 / (3.0 * std::pow(1.0 + kG[i], 2)); }
double g_variance() {
  double product = 1.0;
  for (std::size_t i = 0; i < kG.size(); ++i) product *= 1.0 + g_part(i);
  return product - 1.0;
}

Points independent_points(std::mt19937_64& engine, int n, int d) {
  Points x(n, Point(d));
  for (Point& p : x)
    for (double& u : p) u = repetition::uniform(engine);
  return x;
}

std::vector<std::vector<SobolRow>> net_rows(const BatchModel& model, int d, const ParameterGroups& groups,
                                            int replicates, int n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::vector<SobolRow>> rows;
  for (int r = 0; r < replicates; ++r)
    rows.push_back(sobol_rows(model, repetition::scrambled_sobol(engine, n, 2 * d), groups));
  return rows;
}

// Published: S1 = 0.3139, 0.4424, 0; ST = 0.5576, 0.4424, 0.2437 (Saltelli et al. 2008, section 4.6).
TEST(SobolIndices, MeetIshigami) {
  const Ishigami truth;
  EXPECT_NEAR(truth.first[0], 0.3139, 5e-5);
  EXPECT_NEAR(truth.total[0], 0.5576, 5e-5);
  EXPECT_NEAR(truth.total[2], 0.2437, 5e-5);
  validation::PrintedTable table("Saltelli and others 2008, section 4.6",
                                 "indices of the function of Ishigami and Homma, by 16 x 1,024 points", 0.01);
  const auto i = sobol_indices(net_rows(pointwise(ishigami), 3, single_parameters(3), 16, 1024, 1), 0.95);
  EXPECT_NEAR(i.variance, truth.v, 0.01 * truth.v);
  EXPECT_NEAR(i.mean, 3.5, 0.01);
  for (int g = 0; g < 3; ++g) {
    table.expect("first order of x_" + std::to_string(g + 1), truth.first[g], i.groups[g].first.value);
    table.expect("total of x_" + std::to_string(g + 1), truth.total[g], i.groups[g].total.value);
    EXPECT_LT(i.groups[g].total.high - i.groups[g].total.low, 0.03) << g;
  }
  EXPECT_NEAR(i.interactions.value, truth.v13 / truth.v, 0.02);
}

TEST(SobolIndices, MeetTheGFunction) {
  const auto i = sobol_indices(net_rows(pointwise(g_function), 6, single_parameters(6), 16, 1024, 2), 0.95);
  const double v = g_variance();
  validation::PrintedTable table("closed form, Saltelli and Sobol' 1995",
                                 "indices of the g-function, by 16 x 1,024 points", 0.01);
  for (std::size_t g = 0; g < 6; ++g) {
    table.expect("first order of x_" + std::to_string(g + 1), g_part(g) / v, i.groups[g].first.value);
    table.expect("total of x_" + std::to_string(g + 1), g_part(g) * (v + 1.0) / (1.0 + g_part(g)) / v,
                 i.groups[g].total.value);
  }
}

// A group's first-order index is the closed one of its parameters together, its total that of the rest.
TEST(SobolIndices, OfGroupsTakeInWhatTheirParametersDoTogether) {
  const Ishigami truth;
  const auto i = sobol_indices(net_rows(pointwise(ishigami), 3, {{0, 2}, {1}}, 16, 1024, 3), 0.95);
  EXPECT_NEAR(i.groups[0].first.value, (truth.v1 + truth.v13) / truth.v, 0.01);
  EXPECT_NEAR(i.groups[0].total.value, (truth.v1 + truth.v13) / truth.v, 0.01);
  EXPECT_NEAR(i.groups[1].first.value, truth.v2 / truth.v, 0.01);
}

TEST(SobolIndices, DoNotMindALargeConstant) {
  const BatchModel lifted = pointwise([](const Point& u) { return 1e9 + ishigami(u); });
  const auto plain = sobol_indices(net_rows(pointwise(ishigami), 3, single_parameters(3), 4, 256, 4), 0.95);
  const auto with = sobol_indices(net_rows(lifted, 3, single_parameters(3), 4, 256, 4), 0.95);
  for (int g = 0; g < 3; ++g) EXPECT_NEAR(with.groups[g].first.value, plain.groups[g].first.value, 1e-5);
}

TEST(SobolIndices, LeaveOutRowsWithAFailedEvaluationAndCountThem) {
  std::mt19937_64 engine(5);
  std::vector<SobolRow> rows =
      sobol_rows(pointwise(ishigami), independent_points(engine, 200, 6), single_parameters(3));
  std::vector<SobolRow> fewer(rows.begin() + 2, rows.end());
  rows[0].b = std::numeric_limits<double>::quiet_NaN();
  rows[1].exchanged[2] = std::numeric_limits<double>::infinity();
  const auto with = sobol_indices(rows, BootstrapOptions{}), without = sobol_indices(fewer, BootstrapOptions{});
  EXPECT_EQ(with.failed_rows, 2);
  EXPECT_EQ(with.rows, 198);
  EXPECT_EQ(with.groups[0].total.low, without.groups[0].total.low);
}

TEST(SobolIndices, SayWhenTheSampleDoesNotSettleThem) {
  std::mt19937_64 engine(6);
  const auto few =
      sobol_indices(sobol_rows(pointwise(ishigami), independent_points(engine, 30, 6), single_parameters(3)), {});
  EXPECT_TRUE(few.groups[0].undersampled());
  const auto many = sobol_indices(net_rows(pointwise(ishigami), 3, single_parameters(3), 16, 1024, 1), 0.95);
  EXPECT_FALSE(many.groups[0].undersampled());
}

// What is zero comes out a little below as often as above.
TEST(SobolIndices, AreSettledWhereTheIntervalHoldsZero) {
  SobolIndices<Independent>::Group group;
  group.first.value = -0.0003;
  group.first.low = -0.001;
  group.first.high = 0.0004;
  group.total.value = group.total.low = group.total.high = 0.0;
  EXPECT_FALSE(group.undersampled());
  group.first.high = -0.0001;
  EXPECT_TRUE(group.undersampled());
}

TEST(SobolIndices, OfAConstantAreZero) {
  std::mt19937_64 engine(7);
  const auto i = sobol_indices(
      sobol_rows(pointwise([](const Point&) { return 2.0; }), independent_points(engine, 30, 4), single_parameters(2)),
      {});
  EXPECT_EQ(i.variance, 0.0);
  EXPECT_EQ(i.groups[1].total.value, 0.0);
  EXPECT_EQ(i.interactions.value, 0.0);
}

template <typename F>
void expect_intervals_hold(F&& indices, double fewest) {
  const Ishigami truth;
  std::vector<int> held(6);
  constexpr int kRepetitions = 300;
  for (unsigned k = 0; k < kRepetitions; ++k) {
    const auto groups = indices(k);
    for (int g = 0; g < 3; ++g) {
      held[g] += groups[g].first.low <= truth.first[g] && truth.first[g] <= groups[g].first.high;
      held[3 + g] += groups[g].total.low <= truth.total[g] && truth.total[g] <= groups[g].total.high;
    }
  }
  for (int g = 0; g < 6; ++g) EXPECT_GE(double(held[g]) / kRepetitions, fewest) << g;
}

// 0.92: three binomial standard errors of 300 repetitions below 95 % would be 0.912.
TEST(SobolIndices, BootstrapIntervalsHoldTheTruth) {
  expect_intervals_hold(
      [](unsigned k) {
        std::mt19937_64 engine(100 + k);
        return sobol_indices(sobol_rows(pointwise(ishigami), independent_points(engine, 400, 6), single_parameters(3)),
                             {0.95, 300, k})
            .groups;
      },
      0.92);
}
TEST(SobolIndices, ReplicatedIntervalsHoldTheTruth) {
  expect_intervals_hold(
      [](unsigned k) {
        return sobol_indices(net_rows(pointwise(ishigami), 3, single_parameters(3), 16, 32, 100 + k), 0.95).groups;
      },
      0.92);
}

}  // namespace sobol_indices_test
}  // namespace boresight
