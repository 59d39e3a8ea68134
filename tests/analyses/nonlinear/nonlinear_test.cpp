// Exponents and sections of systems whose own are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boresight_analyses/nonlinear/lyapunov.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace nonlinear_test {

StateSeries henon(int n) {  // a = 1.4, b = 0.3
  StateSeries s{1.0, 1, MatX(2, n)};
  double x = 0.1, y = 0.1;
  for (int k = -100; k < n; ++k) {
    const double next = 1.0 - 1.4 * x * x + y;
    y = 0.3 * x, x = next;
    if (k >= 0) s.states.col(k) << x, y;
  }
  return s;
}

StateSeries lorenz(int n, double spacing) {  // sigma = 16, R = 45.92, b = 4, as in Rosenstein et al.
  StateSeries s{spacing, 1, MatX(3, n)};
  Vec3 y(1.0, 2.0, 20.0);
  const auto f = [](const Vec3& v) {
    return Vec3(16.0 * (v[1] - v[0]), v[0] * (45.92 - v[2]) - v[1], v[0] * v[1] - 4.0 * v[2]);
  };
  const int inner = 4;
  const double h = spacing / inner;
  for (int k = -1000; k < n; ++k) {
    if (k >= 0) s.states.col(k) = y;
    for (int i = 0; i < inner; ++i) {
      const Vec3 k1 = f(y), k2 = f(y + 0.5 * h * k1), k3 = f(y + 0.5 * h * k2), k4 = f(y + h * k3);
      y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
  }
  return s;
}

TEST(LyapunovExponent, OfTheHenonMapIsAsPublished) {
  // 0.418 (Wolf et al. 1985; Rosenstein et al. 1993 find 0.375 to 0.409 themselves).
  const Divergence d = largest_lyapunov_exponent(henon(2000), 10.0, 12.0);
  EXPECT_TRUE(d.rises);
  EXPECT_NEAR(d.exponent, 0.418, 0.06);
}

TEST(LyapunovExponent, CurveBeginsWhereNeighboursAreFoundAndGoesOnAsLongAsAsked) {
  const Divergence d = largest_lyapunov_exponent(henon(3000), 10.0, 20.0);
  ASSERT_EQ(d.t.size(), 21u);
  EXPECT_EQ(d.t.front(), 0.0);
  EXPECT_EQ(d.t.back(), 20.0);
}

// 45 states that can be followed, and neighbours that must lie 30 apart: too few for an answer.
TEST(LyapunovExponent, OfASeriesShorterThanTwiceTheSeparationIsNotGiven) {
  EXPECT_EQ(largest_lyapunov_exponent(henon(50), 30.0, 5.0).pairs, 0);
  EXPECT_GT(largest_lyapunov_exponent(henon(80), 30.0, 5.0).pairs, 0);
}

// Separation and horizon are times, not numbers of states.
TEST(LyapunovExponent, IsPerSecondWhateverTheSpacing) {
  StateSeries seconds = henon(3000), tenths = seconds;
  tenths.spacing = 0.1;
  const Divergence a = largest_lyapunov_exponent(seconds, 30.0, 20.0), b = largest_lyapunov_exponent(tenths, 3.0, 2.0);
  EXPECT_EQ(a.pairs, b.pairs);
  EXPECT_EQ(a.log_distance, b.log_distance);
  EXPECT_NEAR(b.exponent / a.exponent, 10.0, 1e-9);
}

// A motion that comes back to the same bits has neighbours at no distance: nothing can be said of them, and nothing parts.
TEST(LyapunovExponent, OfAnExactCycleDoesNotRise) {
  StateSeries cycle{1.0, 1, MatX(1, 300)};
  for (int k = 0; k < 300; ++k) cycle.states(0, k) = k % 3;
  const Divergence d = largest_lyapunov_exponent(cycle, 4.0, 20.0);
  EXPECT_FALSE(d.rises);
  EXPECT_FALSE(d.log_distance.empty());
}

TEST(LyapunovExponent, OfLorenzSystemIsAsPublished) {
  // 1.50 (Wolf et al. 1985). Rosenstein et al. (1993, table 2) find 1.35 to 1.75 with 1000 to 5000 states: so
  // far the method goes.
  const Divergence d = largest_lyapunov_exponent(lorenz(5000, 0.01), 1.0, 5.0);
  EXPECT_TRUE(d.rises);
  validation::expect_printed("Wolf and others 1985", "largest Lyapunov exponent of the Lorenz system [1/s]", "1.50",
                             d.exponent, 0.2);
}

// x'' + 0.2 x' + x = cos(1.3 t) after its transient: a circle around which nothing parts.
StateSeries linear_oscillator(int periods, int per_period) {
  StateSeries s{2.0 * std::numbers::pi / 1.3 / per_period, per_period, MatX(2, periods * per_period + 1)};
  for (Eigen::Index k = 0; k < s.states.cols(); ++k) {
    const double t = static_cast<double>(k) * s.spacing;
    s.states.col(k) << std::cos(1.3 * t) + std::exp(-0.1 * t) * std::cos(t),
        -1.3 * std::sin(1.3 * t) - std::exp(-0.1 * t) * std::sin(t);
  }
  return s;
}

TEST(LyapunovExponent, OfALinearOscillatorIsNotPositive) {
  const StateSeries s = linear_oscillator(60, 50);
  const Divergence d = largest_lyapunov_exponent(s, 4.0, 20.0);
  EXPECT_FALSE(d.rises);
  EXPECT_LT(d.exponent, 0.0);
  EXPECT_NEAR(d.exponent, -0.1, 0.02);  // neighbours at the same phase close in as the transient does
}

TEST(PoincareSection, OfAMotionOfTheDrivesPeriodIsOnePoint) {
  const StateSeries s = linear_oscillator(60, 50);
  const MatX section = poincare_section(s, 40);
  EXPECT_EQ(section.cols(), 21);
  EXPECT_EQ(section_period(section, VecX::Constant(2, 2.0)), 1);
}

TEST(PoincareSection, OfAPeriodDoubledMotionHasTwoPoints) {
  StateSeries s{0.1, 10, MatX(1, 401)};
  for (int k = 0; k <= 400; ++k)
    s.states(0, k) =
        std::sin(2.0 * std::numbers::pi * k / 20.0 + 0.3) + 0.2 * std::cos(2.0 * std::numbers::pi * k / 10.0);
  EXPECT_EQ(section_period(poincare_section(s, 5), VecX::Constant(1, 2.0)), 2);
}

TEST(PoincareSection, OfAnIncommensurateMotionNeverComesBack) {
  StateSeries s{0.1, 10, MatX(1, 801)};
  for (int k = 0; k <= 800; ++k) s.states(0, k) = std::sin(2.0 * std::numbers::pi * k / 10.0 * std::numbers::phi);
  EXPECT_EQ(section_period(poincare_section(s, 0), VecX::Constant(1, 2.0)), 0);
}

TEST(LyapunovExponent, IsNotGivenWhereTheHistoryIsTooShort) {
  const Divergence d = largest_lyapunov_exponent(henon(15), 10.0, 12.0);
  EXPECT_FALSE(d.rises);
  EXPECT_EQ(d.pairs, 0);
}

}  // namespace nonlinear_test
}  // namespace boresight
