#include "boresight_analyses/sensitivity/morris_effects.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "boresight_analyses/sensitivity/sobol_rows.hpp"
#include "repetition.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace morris_effects_test {

constexpr int kLevels = 4;

BatchModel pointwise(double (*f)(const Point&)) {
  return [f](const Points& points) {
    std::vector<double> values;
    for (const Point& p : points) values.push_back(f(p));
    return values;
  };
}

// Saltelli and Sobol' (1995). At the levels 1/8, 3/8, 5/8, 7/8 a factor is (1/2 or 3/2 + a) / (1 + a), of mean 1 and variance
// 1/4 / (1 + a)^2, and a move takes it from one to the other: |d| = 2 / (1 + a) times the other factors.
const std::vector<double> kG = {0.0, 1.0, 4.5, 9.0, 99.0, 99.0};
double g_function(const Point& u) {
  double y = 1.0;
  for (std::size_t i = 0; i < kG.size(); ++i) y *= (std::abs(4.0 * u[i] - 2.0) + kG[i]) / (1.0 + kG[i]);
  return y;
}
double g_mu_star(std::size_t i) { return 2.0 / (1.0 + kG[i]); }
double g_sigma(std::size_t i) {  // mu is 0
  double mean_square = g_mu_star(i) * g_mu_star(i);
  for (std::size_t j = 0; j < kG.size(); ++j)
    if (j != i) mean_square *= 1.0 + 0.25 / std::pow(1.0 + kG[j], 2);
  return std::sqrt(mean_square);
}

// Ishigami and Homma (1990), a = 7, b = 0.1.
double ishigami(const Point& u) {
  const auto x = [&](std::size_t i) { return std::numbers::pi * (2.0 * u[i] - 1.0); };
  return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

// Morris (1991), of 20 inputs. Coefficients that he drew at random are (-1)^i and (-1)^(i + j) here, as in Saltelli and
// others 2004. His levels are 0, 1/3, 2/3, 1.
double morris_function(const Point& u) {
  std::vector<double> w;
  for (int i = 1; i <= 20; ++i) {
    const double x = (u[static_cast<std::size_t>(i) - 1] - 0.125) / 0.75;
    w.push_back(i == 3 || i == 5 || i == 7 ? 2.0 * (1.1 * x / (x + 0.1) - 0.5) : 2.0 * (x - 0.5));
  }
  const auto sign = [](int k) { return k % 2 == 0 ? 1.0 : -1.0; };
  double y = 0.0;
  for (int i = 1; i <= 20; ++i) {
    const double wi = w[static_cast<std::size_t>(i) - 1];
    y += (i <= 10 ? 20.0 : sign(i)) * wi;
    for (int j = i + 1; j <= 20; ++j) {
      const double wij = wi * w[static_cast<std::size_t>(j) - 1];
      y += (j <= 6 ? -15.0 : sign(i + j)) * wij;
      for (int l = j + 1; l <= 5; ++l) {
        const double wijl = wij * w[static_cast<std::size_t>(l) - 1];
        y += -10.0 * wijl;
        for (int s = l + 1; s <= 4; ++s) y += 5.0 * wijl * w[static_cast<std::size_t>(s) - 1];
      }
    }
  }
  return y;
}

Points starts(std::mt19937_64& engine, int n, int d) {
  Points x(static_cast<std::size_t>(n), Point(static_cast<std::size_t>(d)));
  for (Point& p : x)
    for (double& u : p) u = repetition::uniform(engine);
  return x;
}

MorrisEffects<Independent> screened(const BatchModel& model, int d, int trajectories, unsigned seed) {
  std::mt19937_64 engine(seed);
  const MorrisTrajectories of(single_parameters(d), kLevels, seed);
  return morris_effects(morris_rows(model, starts(engine, trajectories, d), of), {0.95, 500, seed});
}

TEST(MorrisEffects, MeetTheGFunction) {
  const auto found = screened(pointwise(g_function), 6, 4000, 1);
  validation::PrintedTable table("closed form on four levels, of the g-function",
                                 "mu* and sigma of elementary effects, by 4,000 trajectories", 0.03);
  for (std::size_t i = 0; i < 6; ++i) {
    table.expect("mu* of x_" + std::to_string(i + 1), g_mu_star(i), found.groups[i].mu_star.value);
    table.expect("sigma of x_" + std::to_string(i + 1), g_sigma(i), found.groups[i].sigma.value);
    EXPECT_NEAR(found.groups[i].mu.value, 0.0, 4.0 * g_sigma(i) / std::sqrt(4000.0));
  }
}

// On the levels the angles are -3/4 pi, -pi/4, pi/4 and 3/4 pi: a move of x_1 always turns its sine about, sin^2 is 1/2
// everywhere, so that x_2 does nothing, and a move of x_3 takes x_3^4 from (pi/4)^4 to 81 times as much or back.
TEST(MorrisEffects, MeetIshigamiOnItsLevels) {
  const auto found = screened(pointwise(ishigami), 3, 4000, 2);
  const double p = std::pow(std::numbers::pi / 4.0, 4), sine = std::sqrt(0.5);
  const double least = 4.0 * sine * (1.0 + 0.1 * p), most = 4.0 * sine * (1.0 + 8.1 * p);
  EXPECT_NEAR(found.groups[0].mu_star.value, 0.5 * (least + most), 4.0 * 0.5 * (most - least) / std::sqrt(4000.0));
  EXPECT_NEAR(found.groups[1].mu_star.value, 0.0, 1e-12);
  EXPECT_NEAR(found.groups[2].mu_star.value, 2.0 * 8.0 * p * sine, 1e-9);
}

// Morris's groups: 1 to 7 act, bent or with others; 8 to 10 act straight; 11 to 20 hardly act.
TEST(MorrisEffects, TellTheGroupsOfMorrissFunctionApart) {
  for (const unsigned seed : {3u, 4u, 5u}) {
    const auto found = screened(pointwise(morris_function), 20, 20, seed);
    double least_of_ten = 1e9, most_of_rest = 0.0, least_bent = 1e9, most_straight = 0.0;
    for (std::size_t i = 0; i < 20; ++i) {
      const auto& g = found.groups[i];
      if (i < 10)
        least_of_ten = std::min(least_of_ten, g.mu_star.value);
      else
        most_of_rest = std::max(most_of_rest, g.mu_star.value);
      if (i < 7) least_bent = std::min(least_bent, g.sigma.value);
      if (i >= 7 && i < 10) most_straight = std::max(most_straight, g.sigma.value / g.mu_star.value);
    }
    EXPECT_GT(least_of_ten, 2.0 * most_of_rest) << seed;
    EXPECT_LT(most_straight, 0.35) << seed;
    EXPECT_GT(least_bent, 20.0) << seed;
  }
  // 8 to 10 act by 20 w alone but for products with the other inputs, of which only w_3, w_5 and w_7 have a mean; dw/du = 8/3.
  const auto many = screened(pointwise(morris_function), 20, 2000, 6);
  double mean = 0.0;
  for (const double x : {0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0}) mean += 0.25 * 2.0 * (1.1 * x / (x + 0.1) - 0.5);
  validation::PrintedTable table("closed form of Morris 1991",
                                 "mu of inputs 8 to 10 of Morris's function, by 2,000 trajectories", 0.6);
  for (const std::size_t i : {7u, 8u, 9u})
    table.expect("input " + std::to_string(i + 1), 8.0 / 3.0 * (20.0 + (i % 2 == 0 ? 3.0 : -3.0) * mean),
                 many.groups[i].mu.value);
}

TEST(MorrisEffects, OfAStraightLineAreItsSlopesWithoutScatter) {
  const auto found = screened(pointwise([](const Point& u) { return 3.0 * u[0] - 2.0 * u[1] + 1e6; }), 3, 16, 7);
  EXPECT_NEAR(found.groups[0].mu.value, 3.0, 1e-8);
  EXPECT_NEAR(found.groups[1].mu.value, -2.0, 1e-8);
  EXPECT_NEAR(found.groups[1].mu_star.high, 2.0, 1e-8);
  EXPECT_NEAR(found.groups[0].sigma.value, 0.0, 1e-4);
  EXPECT_EQ(found.groups[2].mu_star.value, 0.0);
}

TEST(MorrisEffects, EveryLevelIsAsProbableAtEveryStep) {
  std::mt19937_64 engine(8);
  const MorrisTrajectories of(single_parameters(3), kLevels, 8);
  const Points from = starts(engine, 4000, 3);
  for (std::uint64_t step = 0; step < of.points(); ++step) {
    std::vector<double> share(kLevels);
    for (std::uint64_t row = 0; row < from.size(); ++row) {
      Point p = from[row];
      of.place(row, step, p);
      EXPECT_DOUBLE_EQ(p[1] * kLevels - 0.5, std::round(p[1] * kLevels - 0.5));
      share[static_cast<std::size_t>(p[1] * kLevels)] += 1.0 / double(from.size());
    }
    for (const double s : share) EXPECT_NEAR(s, 0.25, 0.03);
  }
  EXPECT_THROW(MorrisTrajectories(single_parameters(3), 5, 1), std::invalid_argument);
}

// Of u and 1 - u a magnitude of errors about zero is the same.
TEST(MorrisEffects, NoMoveIsAMirrorImageAboutTheMedian) {
  for (int levels = 2; levels <= 64; ++levels) {
    if (levels % 4 != 0) {
      EXPECT_THROW(MorrisTrajectories(single_parameters(1), levels, 1), std::invalid_argument) << levels;
      continue;
    }
    const MorrisTrajectories of(single_parameters(1), levels, 1);
    for (int k = 0; k < levels; ++k) {
      Point before{(k + 0.5) / levels}, after = before;
      of.place(0, 0, before);
      of.place(0, 1, after);
      EXPECT_DOUBLE_EQ(std::abs(after[0] - before[0]), 0.5);
      EXPECT_GE(std::abs(after[0] + before[0] - 1.0), 0.9 / levels) << levels << " levels, from " << before[0];
    }
  }
}

TEST(MorrisEffects, OfAMagnitudeAreNotNothing) {
  std::mt19937_64 engine(11);
  for (const int levels : {4, 8, 12, 64}) {
    const MorrisTrajectories of(single_parameters(2), levels, 11);
    const auto found =
        morris_effects(morris_rows(pointwise([](const Point& u) { return std::abs(u[0] - 0.5) + 0.01 * u[1]; }),
                                   starts(engine, 400, 2), of),
                       {});
    // |u - 1/2| changes by 1/2 - 2 |u - 1/4| or its negative, u the lower end: on average by a quarter.
    EXPECT_NEAR(found.groups[0].mu_star.value, 2.0 * 0.25, 0.05) << levels;
    EXPECT_NEAR(found.groups[1].mu_star.value, 0.01, 1e-12) << levels;
  }
}

TEST(MorrisEffects, MoveAGroupAsOne) {
  std::mt19937_64 engine(9);
  const MorrisTrajectories of({{0, 2}, {1}}, kLevels, 9);
  EXPECT_EQ(of.points(), 3u);
  const auto found = morris_effects(
      morris_rows(pointwise([](const Point& u) { return u[0] + u[2] + u[1]; }), starts(engine, 2000, 3), of), {});
  EXPECT_NEAR(found.groups[0].mu_star.value, 1.0, 0.1);  // +-1 +-1: 2 or 0
  EXPECT_NEAR(found.groups[1].mu_star.value, 1.0, 1e-12);
}

TEST(MorrisEffects, LeaveOutTrajectoriesWithAFailedRunAndCountThem) {
  std::mt19937_64 engine(10);
  const MorrisTrajectories of(single_parameters(2), kLevels, 10);
  auto rows = morris_rows(pointwise([](const Point& u) { return u[0] * u[1]; }), starts(engine, 40, 2), of);
  const std::vector<std::vector<double>> fewer(rows.begin() + 1, rows.end());
  rows[0][1] = std::numeric_limits<double>::quiet_NaN();
  const auto with = morris_effects(rows, BootstrapOptions{}), without = morris_effects(fewer, BootstrapOptions{});
  EXPECT_EQ(with.failed_rows, 1);
  EXPECT_EQ(with.rows, 39);
  EXPECT_EQ(with.groups[0].mu_star.low, without.groups[0].mu_star.low);
  EXPECT_THROW(morris_effects(std::vector<std::vector<double>>(rows.begin(), rows.begin() + 5), BootstrapOptions{}),
               std::invalid_argument);
}

// Two standard errors of a share of 95 % among 300 repetitions are 2.5 %; the bootstrap of 40 rows is a little short besides.
TEST(MorrisEffects, IntervalsHoldTheTruth) {
  constexpr unsigned kRepetitions = 300;
  int by_bootstrap = 0, by_replicates = 0;
  const BatchModel model = pointwise(g_function);
  for (unsigned k = 0; k < kRepetitions; ++k) {
    const auto found = screened(model, 6, 40, 1000 + k);
    const auto holds = [&](const auto& i) { return i.low <= g_mu_star(0) && g_mu_star(0) <= i.high; };
    by_bootstrap += holds(found.groups[0].mu_star);
    std::mt19937_64 engine(5000 + k);
    const MorrisTrajectories of(single_parameters(6), kLevels, k);
    std::vector<std::vector<std::vector<double>>> replicates(16);
    const auto rows = morris_rows(model, starts(engine, 64, 6), of);
    for (std::size_t row = 0; row < rows.size(); ++row) replicates[row % 16].push_back(rows[row]);
    by_replicates += holds(morris_effects(replicates, 0.95).groups[0].mu_star);
  }
  EXPECT_GT(by_bootstrap, 0.90 * kRepetitions);
  EXPECT_GT(by_replicates, 0.92 * kRepetitions);
  EXPECT_LT(by_replicates, 0.985 * kRepetitions);
}

}  // namespace morris_effects_test
}  // namespace boresight
