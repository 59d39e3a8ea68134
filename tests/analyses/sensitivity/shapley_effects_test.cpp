#include "boresight_analyses/sensitivity/shapley_effects.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "boresight_analyses/sensitivity/sobol_rows.hpp"
#include "repetition.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace shapley_effects_test {

double score(double u) { return boost::math::quantile(boost::math::normal(), u); }

// y = sum of slope_i x_i, x normal with these sds.
BatchModel linear(const std::vector<double>& slopes) {
  return [slopes](const Points& points) {
    std::vector<double> values;
    for (const Point& p : points) {
      values.push_back(0.0);
      for (std::size_t i = 0; i < slopes.size(); ++i) values.back() += slopes[i] * score(p[i]);
    }
    return values;
  };
}

BatchModel ishigami() {
  return [](const Points& points) {
    std::vector<double> values;
    for (const Point& u : points) {
      const auto x = [&](std::size_t i) { return std::numbers::pi * (2.0 * u[i] - 1.0); };
      values.push_back(std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0)));
    }
    return values;
  };
}

Eigen::MatrixXd three_with(double r) {
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(3, 3);
  correlation(1, 2) = correlation(2, 1) = r;
  return correlation;
}

// Iooss and Prieur (2019): y = b_1 x_1 + b_2 x_2 + b_3 x_3, x_2 and x_3 correlated by r. Here b_i is b_i sigma_i.
std::vector<double> of_iooss_and_prieur(const std::vector<double>& b, double r) {
  const double v = b[0] * b[0] + b[1] * b[1] + b[2] * b[2] + 2.0 * r * b[1] * b[2];
  const double apart = 0.5 * r * r * (b[2] * b[2] - b[1] * b[1]);
  return {b[0] * b[0] / v, (b[1] * b[1] + r * b[1] * b[2] + apart) / v, (b[2] * b[2] + r * b[1] * b[2] - apart) / v};
}

// Any linear Gaussian model, from the definition: c(J) = b_J^T (R_JJ - R_JK R_KK^-1 R_KJ) b_J.
std::vector<double> by_definition(const std::vector<double>& slopes, const Eigen::MatrixXd& r) {
  const auto g = static_cast<int>(slopes.size());
  std::vector<double> c(std::size_t{1} << g, 0.0);
  for (std::size_t set = 1; set < c.size(); ++set) {
    std::vector<int> in, out;
    for (int i = 0; i < g; ++i) (set >> i & 1U ? in : out).push_back(i);
    Eigen::MatrixXd left = r(in, in);
    if (!out.empty()) left -= r(in, out) * r(out, out).inverse() * r(out, in);
    Eigen::VectorXd b(static_cast<Eigen::Index>(in.size()));
    for (std::size_t k = 0; k < in.size(); ++k)
      b[static_cast<Eigen::Index>(k)] = slopes[static_cast<std::size_t>(in[k])];
    c[set] = b.dot(left * b);
  }
  std::vector<double> effects(slopes.size(), 0.0);
  for (std::size_t set = 0; set < c.size(); ++set)
    for (int i = 0; i < g; ++i) {
      if (set >> i & 1U) continue;
      const int taken = std::popcount(set);
      effects[static_cast<std::size_t>(i)] += std::tgamma(taken + 1) * std::tgamma(g - taken) / std::tgamma(g + 1) *
                                              (c[set | std::size_t{1} << i] - c[set]) / c.back();
    }
  return effects;
}

ShapleyEffects<Replicated> by_nets(const BatchModel& model, const GaussianCopula& copula, const ShapleyRows& rows,
                                   int d, int n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::vector<ShapleyRow>> replicates;
  for (int r = 0; r < 16; ++r)
    replicates.push_back(shapley_rows(model, repetition::scrambled_sobol(engine, n, 2 * d), copula, rows,
                                      static_cast<std::uint64_t>(r * n)));
  return shapley_effects(replicates, 0.95);
}

TEST(ShapleyEffects, MeetTheClosedFormOfCorrelatedNormalInputs) {
  const std::vector<double> b = {1.0, 1.0, 2.0};
  validation::PrintedTable table("closed form, Iooss and Prieur 2019",
                                 "Shapley effects of three normal inputs, two of them correlated, by 16 x 1,024 rows",
                                 0.02);
  for (const double r : {-0.8, 0.0, 0.5, 0.9})
    for (const ShapleyOrders orders : {ShapleyOrders::all, ShapleyOrders::random}) {
      const ShapleyRows rows(single_parameters(3), orders, 1);
      const auto found = by_nets(linear(b), GaussianCopula(three_with(r)), rows, 3, 1024, 2);
      const std::vector<double> truth = of_iooss_and_prieur(b, r);
      const std::vector<double> defined = by_definition(b, three_with(r));
      double sum = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(defined[i], truth[i], 1e-12);
        table.expect("input " + std::to_string(i + 1) + ", r = " + std::to_string(r), truth[i], found.groups[i].value);
        sum += found.groups[i].value;
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      EXPECT_NEAR(found.variance / (6.0 + 4.0 * r), 1.0, 0.02);
      EXPECT_NEAR(found.mean, 0.0, 0.02);
    }
}

TEST(ShapleyEffects, OfIndependentInputsShareInteractionsEqually) {
  const double p4 = std::pow(std::numbers::pi, 4), v1 = 0.5 * std::pow(1.0 + 0.02 * p4, 2), v2 = 49.0 / 8.0,
               v13 = 0.08 * p4 * p4 / 225.0, v = v1 + v2 + v13;
  validation::PrintedTable table("closed form: half of an interaction to each of two inputs",
                                 "Shapley effects of the function of Ishigami and Homma, by 16 x 1,024 rows", 0.02);
  for (const ShapleyOrders orders : {ShapleyOrders::all, ShapleyOrders::random}) {
    const auto found = by_nets(ishigami(), {}, ShapleyRows(single_parameters(3), orders, 1), 3, 1024, 3);
    table.expect("x_1", (v1 + 0.5 * v13) / v, found.groups[0].value);
    table.expect("x_2", v2 / v, found.groups[1].value);
    table.expect("x_3", 0.5 * v13 / v, found.groups[2].value);
  }
}

TEST(ShapleyEffects, OfManyCorrelatedInputsMeetTheirDefinition) {
  const std::vector<double> b = {1.0, -2.0, 0.5, 3.0, 1.5, 0.0, 1.0};
  Eigen::MatrixXd r = Eigen::MatrixXd::Identity(7, 7);
  r(0, 1) = r(1, 0) = 0.6;
  r(1, 4) = r(4, 1) = -0.5;
  r(3, 5) = r(5, 3) = 0.9;
  const std::vector<double> truth = by_definition(b, r);
  const auto found =
      by_nets(linear(b), GaussianCopula(r), ShapleyRows(single_parameters(7), ShapleyOrders::random, 5), 7, 2048, 4);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(found.groups[i].value, truth[i], 0.02) << i;
  EXPECT_GT(truth[5], 0.1);  // it does nothing by itself, and tells about what does
}

TEST(ShapleyEffects, OfGroupsAreThoseOfTheirParametersTogether) {
  const std::vector<double> b = {1.0, 1.0, 2.0};
  const auto found = by_nets(linear(b), GaussianCopula(three_with(0.5)),
                             ShapleyRows({{0}, {1, 2}}, ShapleyOrders::all, 1), 3, 1024, 6);
  EXPECT_NEAR(found.groups[0].value, 1.0 / 8.0, 0.01);
  EXPECT_NEAR(found.groups[1].value, 7.0 / 8.0, 0.01);
}

TEST(ShapleyEffects, CountTheRunsOfARow) {
  EXPECT_EQ(ShapleyRows(single_parameters(3), ShapleyOrders::all, 1).points(), 8u);
  EXPECT_EQ(ShapleyRows(single_parameters(3), ShapleyOrders::random, 1).points(), 4u);
  EXPECT_THROW(ShapleyRows(single_parameters(13), ShapleyOrders::all, 1), std::invalid_argument);
}

TEST(ShapleyEffects, LeaveOutRowsWithAFailedRunAndCountThem) {
  std::mt19937_64 engine(7);
  const ShapleyRows kind(single_parameters(3), ShapleyOrders::random, 1);
  auto rows = shapley_rows(linear({1.0, 2.0, 3.0}), repetition::scrambled_sobol(engine, 64, 6), {}, kind);
  const std::vector<ShapleyRow> fewer(rows.begin() + 1, rows.end());
  rows[0].shares[1] = std::numeric_limits<double>::quiet_NaN();
  const auto with = shapley_effects(rows, BootstrapOptions{}), without = shapley_effects(fewer, BootstrapOptions{});
  EXPECT_EQ(with.failed_rows, 1);
  EXPECT_EQ(with.groups[0].low, without.groups[0].low);
  EXPECT_EQ(with.variance, without.variance);
}

TEST(ShapleyEffects, OfAConstantAreZero) {
  std::mt19937_64 engine(8);
  const ShapleyRows kind(single_parameters(2), ShapleyOrders::all, 1);
  const auto found = shapley_effects(
      shapley_rows(linear({0.0, 0.0}), repetition::scrambled_sobol(engine, 32, 4), {}, kind), BootstrapOptions{});
  EXPECT_EQ(found.groups[0].value, 0.0);
  EXPECT_EQ(found.variance, 0.0);
}

// 0.92: three binomial standard errors of 300 repetitions below 95 % would be 0.912.
TEST(ShapleyEffects, IntervalsHoldTheTruth) {
  constexpr unsigned kRepetitions = 300;
  const std::vector<double> b = {1.0, 1.0, 2.0}, truth = of_iooss_and_prieur(b, 0.5);
  const GaussianCopula copula(three_with(0.5));
  const ShapleyRows kind(single_parameters(3), ShapleyOrders::random, 1);
  std::vector<int> bootstrap(3), nets(3);
  for (unsigned k = 0; k < kRepetitions; ++k) {
    std::mt19937_64 engine(100 + k);
    Points ab(200, Point(6));
    for (Point& p : ab)
      for (double& u : p) u = repetition::uniform(engine);
    const auto found = shapley_effects(shapley_rows(linear(b), ab, copula, kind), {0.95, 300, k});
    const auto of_nets = by_nets(linear(b), copula, kind, 3, 16, 1000 + k);
    for (std::size_t i = 0; i < 3; ++i) {
      bootstrap[i] += found.groups[i].low <= truth[i] && truth[i] <= found.groups[i].high;
      nets[i] += of_nets.groups[i].low <= truth[i] && truth[i] <= of_nets.groups[i].high;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(double(bootstrap[i]) / kRepetitions, 0.90) << i;
    EXPECT_GE(double(nets[i]) / kRepetitions, 0.92) << i;
  }
}

}  // namespace shapley_effects_test
}  // namespace boresight
