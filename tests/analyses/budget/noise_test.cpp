// What the windows' filters keep of a noise's spectrum, against closed forms.
#include "boresight_analyses/budget/noise.hpp"

#include <gsl/gsl_sf_expint.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

#include "boresight_analyses/budget/window_filter.hpp"

namespace boresight {
namespace noise_test {

using Complex = std::complex<double>;

const Windows kWindows{.window = 0.08, .separation = 0.3, .observation = 1.0, .revisit = 1.2};

// From the second integral D of the autocovariance, D'' = R, D(0) = D'(0) = 0: mean squares of a window's mean, and of two windows'
// difference.
struct Doubly {
  std::function<double(double)> integrated;
  double mean(double window) const { return 2.0 * integrated(window) / (window * window); }
  double difference(double window, double apart) const {
    const double covariance =
        (integrated(apart + window) - 2.0 * integrated(apart) + integrated(std::abs(apart - window))) /
        (window * window);
    return 2.0 * (mean(window) - covariance);
  }
};

void expect_indices(const Noise& noise, double variance, const Doubly& doubly, double tolerance) {
  const double mean = doubly.mean(kWindows.window);
  EXPECT_NEAR(noise.variance(ErrorIndex::ape, kWindows) / variance, 1.0, tolerance);
  EXPECT_NEAR(noise.variance(ErrorIndex::mpe, kWindows) / mean, 1.0, tolerance);
  EXPECT_NEAR(noise.variance(ErrorIndex::rpe, kWindows) / (variance - mean), 1.0, tolerance);
  EXPECT_NEAR(noise.variance(ErrorIndex::pde, kWindows) / doubly.difference(kWindows.window, kWindows.separation), 1.0,
              tolerance);
  EXPECT_NEAR(noise.variance(ErrorIndex::pre, kWindows) / doubly.difference(kWindows.window, kWindows.revisit), 1.0,
              tolerance);
}

// White noise S0 makes of a loop of second order R(t) = S0 wn / (8 zeta) exp(-zeta wn t) (cos wd t + zeta wn / wd sin wd t): Newland (1993),
// An Introduction to Random Vibrations, 7; twice integrated by hand.
TEST(Noise, WhiteThroughALoopOfSecondOrderKeepsWhatItsAutocovarianceSays) {
  for (const double zeta : {0.02, 0.3, 0.95}) {
    const double wn = 2.0 * M_PI * 5.0, wd = wn * std::sqrt(1.0 - zeta * zeta), variance = wn / (8.0 * zeta);
    const Complex l(zeta * wn, -wd), amplitude(1.0, -zeta * wn / wd);
    const Doubly doubly{
        [=](double t) { return variance * std::real(amplitude * (l * t - 1.0 + std::exp(-l * t)) / (l * l)); }};
    expect_indices(Noise({.white = 1.0}, {TransferFunction::second_order(5.0, zeta)}), variance, doubly, 1e-8);
  }
}

TEST(Noise, OfALoopHasTheFiguresWorkedOutByHand) {
  const Noise noise({.white = 1.0}, {TransferFunction::second_order(5.0, 0.3)});
  EXPECT_NEAR(noise.variance(ErrorIndex::ape, kWindows), 13.0899694, 1e-7);
  EXPECT_NEAR(noise.variance(ErrorIndex::mpe, kWindows), 8.7242231, 1e-7);
}

TEST(Noise, OfFirstOrderKeepsWhatTheContributorOfThatClassDoes) {
  const double deviation = 2.0, time = 0.03;
  const Noise noise({.deviation = deviation, .correlation_time = time});
  const Noise lagged({.white = 4.0 * deviation * deviation * time},
                     {TransferFunction::first_order(1.0 / (2.0 * M_PI * time))});
  for (const ErrorIndex index : kErrorIndices) {
    const double expected = deviation * deviation * kept_of_noise(index, time, kWindows);
    EXPECT_NEAR(noise.variance(index, kWindows) / expected, 1.0, 1e-8) << to_string(index);
    EXPECT_NEAR(lagged.variance(index, kWindows) / expected, 1.0, 1e-8) << to_string(index);
  }
}

// With x = 2 pi f T: the integral of 2 (1 - cos x) / x^2 is 2 Si(x) - 2 (1 - cos x) / x.
TEST(Noise, WhiteWithinABandKeepsWhatTheSineIntegralSays) {
  const double white = 3.0, window = kWindows.window;
  for (const auto& [lower, upper] : {std::pair{2.0, 60.0}, {0.001, 0.5}, {40.0, 41.0}, {0.0, 3000.0}}) {
    const auto integrated = [&](double f) {
      const double x = 2.0 * M_PI * f * window;
      return x == 0.0 ? 0.0 : (2.0 * gsl_sf_Si(x) - 2.0 * (1.0 - std::cos(x)) / x) / (2.0 * M_PI * window);
    };
    const double all = white * (upper - lower), mean = white * (integrated(upper) - integrated(lower));
    const Noise noise({.white = white, .lower = lower, .upper = upper});
    EXPECT_NEAR(noise.variance(ErrorIndex::ape, kWindows) / all, 1.0, 1e-9);
    EXPECT_NEAR(noise.variance(ErrorIndex::mpe, kWindows) / mean, 1.0, 1e-8) << lower;
    EXPECT_NEAR(noise.variance(ErrorIndex::rpe, kWindows), all - mean, 1e-8 * all) << lower;
  }
}

// The integral of 2 (1 - cos x) / x^3 is Ci(x) - sin x / x - (1 - cos x) / x^2.
TEST(Noise, FlickerWithinABandKeepsWhatTheCosineIntegralSays) {
  const double flicker = 0.7, lower = 0.01, upper = 200.0, window = kWindows.window;
  const auto integrated = [&](double f) {
    const double x = 2.0 * M_PI * f * window;
    return gsl_sf_Ci(x) - std::sin(x) / x - (1.0 - std::cos(x)) / (x * x);
  };
  const double all = flicker * std::log(upper / lower), mean = flicker * (integrated(upper) - integrated(lower));
  const Noise noise({.flicker = flicker, .lower = lower, .upper = upper});
  EXPECT_NEAR(noise.variance(ErrorIndex::ape, kWindows) / all, 1.0, 1e-9);
  EXPECT_NEAR(noise.variance(ErrorIndex::mpe, kWindows) / mean, 1.0, 1e-8);
  EXPECT_NEAR(noise.variance(ErrorIndex::rpe, kWindows) / (all - mean), 1.0, 1e-8);
}

// With v = (f / fn)^2, b = 2 - 4 zeta^2, q = v^2 - b v + 1, d = sqrt(1 - b^2 / 4): the integral of 1 / (2 v q) is half of
// ln v - ln(q) / 2 + b / (2 d) atan((v - b / 2) / d).
TEST(Noise, FlickerThroughALoopOfSecondOrderHasItsClosedForm) {
  const double flicker = 0.7, fn = 5.0;
  for (const double zeta : {0.05, 0.3, 0.9})
    for (const double lower : {1e-4, 0.1, 8.0}) {
      const double b = 2.0 - 4.0 * zeta * zeta, d = std::sqrt(1.0 - 0.25 * b * b), v = std::pow(lower / fn, 2);
      const double below =
          std::log(v) - 0.5 * std::log(v * v - b * v + 1.0) + 0.5 * b / d * std::atan((v - 0.5 * b) / d);
      const double expected = 0.5 * flicker * (0.5 * b / d * 0.5 * M_PI - below);
      const Noise noise({.flicker = flicker, .lower = lower}, {TransferFunction::second_order(fn, zeta)});
      EXPECT_NEAR(noise.variance(ErrorIndex::ape, kWindows) / expected, 1.0, 1e-8) << zeta << ' ' << lower;
    }
}

// 1 / ((u^2 - p) (u^2 - p*)) in partial fractions, p = 1 - 2 zeta^2 + 2 i zeta sqrt(1 - zeta^2).
TEST(Noise, WhiteWithinABandThroughALoopOfSecondOrderHasItsClosedForm) {
  const double fn = 5.0;
  for (const double zeta : {0.05, 0.3, 0.9})
    for (const auto& [lower, upper] : {std::pair{0.0, 4.0}, {3.0, 12.0}, {6.0, 500.0}}) {
      const Complex p(1.0 - 2.0 * zeta * zeta, 2.0 * zeta * std::sqrt(1.0 - zeta * zeta)), root = std::sqrt(p);
      const auto integrated = [&](double u) {
        return std::imag((std::log(u - root) - std::log(u + root)) / (2.0 * root)) / p.imag();
      };
      const double expected = fn * (integrated(upper / fn) - integrated(lower / fn));
      const Noise noise({.white = 1.0, .lower = lower, .upper = upper}, {TransferFunction::second_order(fn, zeta)});
      EXPECT_NEAR(noise.variance(ErrorIndex::ape, kWindows) / expected, 1.0, 1e-8) << zeta << ' ' << lower;
    }
}

TEST(Noise, OfATableIsStraightInItsLogarithms) {
  // f^-2 from 1 to 100 Hz in three points, and a flat piece behind.
  const Noise noise({.frequency = {1.0, 10.0, 100.0, 300.0}, .density = {2.0, 2e-2, 2e-4, 2e-4}});
  EXPECT_NEAR(noise.at(3.0), 2.0 / 9.0, 1e-12);
  EXPECT_EQ(noise.at(0.9), 0.0);
  EXPECT_EQ(noise.at(301.0), 0.0);
  EXPECT_NEAR(noise.variance(ErrorIndex::ape, kWindows), 2.0 * (1.0 - 0.01) + 2e-4 * 200.0, 1e-8);
}

TEST(Noise, SaysWhichEndOfItsBandItLacks) {
  const std::vector<TransferFunction> loop = {TransferFunction::second_order(5.0, 0.3)},
                                      sensitivity = {TransferFunction::sensitivity(5.0, 0.3)};
  EXPECT_EQ(Noise({.white = 1.0}, loop).unbounded(), "");
  EXPECT_TRUE(Noise({.white = 1.0}).unbounded().starts_with("an upper frequency"));
  EXPECT_TRUE(Noise({.white = 1.0}, sensitivity).unbounded().starts_with("an upper frequency"));
  EXPECT_EQ(Noise({.white = 1.0, .upper = 100.0}, sensitivity).unbounded(), "");
  EXPECT_TRUE(Noise({.flicker = 1.0}, loop).unbounded().starts_with("a lower frequency"));
  EXPECT_TRUE(Noise({.flicker = 1.0, .lower = 0.1}).unbounded().starts_with("an upper frequency"));
  // The loop takes away what is slow as the square of the frequency: flicker needs no lower end then, a random walk neither.
  EXPECT_EQ(Noise({.flicker = 1.0, .upper = 100.0}, sensitivity).unbounded(), "");
  EXPECT_EQ(Noise({.flicker = 1.0, .exponent = 2.0}, sensitivity).unbounded(), "");
  EXPECT_TRUE(Noise({.flicker = 1.0, .exponent = 3.0}, sensitivity).unbounded().starts_with("a lower frequency"));
}

TEST(TransferFunction, ALoopClosesToItsSensitivityAndItsComplement) {
  // L = wn^2 / (s (s + 2 zeta wn)) closes to the loop of second order.
  const double w = 2.0 * M_PI * 5.0, zeta = 0.3;
  const TransferFunction open({w * w}, {0.0, 2.0 * zeta * w, 1.0});
  for (const double f : {0.1, 4.0, 5.0, 70.0}) {
    const Complex sensor = open.closed_on_sensor().at(f), disturbance = open.closed_on_disturbance().at(f);
    EXPECT_NEAR(std::abs(sensor - TransferFunction::second_order(5.0, zeta).at(f)), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(disturbance - TransferFunction::sensitivity(5.0, zeta).at(f)), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(sensor + disturbance - 1.0), 0.0, 1e-12);
  }
  EXPECT_EQ(TransferFunction::sensitivity(5.0, zeta).order_at_zero(), 1);
  EXPECT_EQ(TransferFunction::second_order(5.0, zeta).order_at_infinity(), -2);
  EXPECT_EQ(TransferFunction::second_order(5.0, zeta).standing(), 1.0);
}

TEST(TransferFunction, IsStableWhereEveryPoleHasANegativeRealPart) {
  EXPECT_TRUE(TransferFunction({1.0}, {6.0, 11.0, 6.0, 1.0}).is_stable());   // -1, -2, -3
  EXPECT_FALSE(TransferFunction({1.0}, {10.0, 1.0, 1.0, 1.0}).is_stable());  // Routh: 1 < 10
  EXPECT_FALSE(TransferFunction({1.0}, {0.0, 1.0}).is_stable());             // an integrator
  std::vector<double> sizes = TransferFunction({1.0}, {6e-12, 11e-8, 6e-4, 1.0}).corners();
  std::sort(sizes.begin(), sizes.end());
  ASSERT_EQ(sizes.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sizes[std::size_t(k)] * 2.0 * M_PI * 1e4, k + 1.0, 1e-9);
}

TEST(TransferFunction, RefusesWhatIsNone) {
  EXPECT_THROW(TransferFunction({1.0}, {0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(TransferFunction({1.0, 1.0, 1.0}, {1.0, 1.0}), std::invalid_argument);
  EXPECT_NO_THROW(TransferFunction({1.0, 1.0, 0.0}, {1.0, 1.0}));
}

// Half the density of first order is at 1 / (2 pi tau); flicker and white noise are alike where f^e is their ratio; a band turns at its ends.
TEST(PowerDensity, TurnsAtItsCorners) {
  const PowerDensity first{.deviation = 2.0, .correlation_time = 0.5};
  ASSERT_EQ(first.corners().size(), 1u);
  EXPECT_NEAR(first.corners()[0], 1.0 / M_PI, 1e-12);
  EXPECT_NEAR(first.at(first.corners()[0]), 0.5 * first.at(1e-9), 1e-6 * first.at(1e-9));
  const PowerDensity pink{.white = 0.1, .flicker = 0.9, .exponent = 2.0, .lower = 0.01, .upper = 50.0};
  const std::vector<double> turns = pink.corners();
  ASSERT_EQ(turns.size(), 3u);
  EXPECT_EQ(turns[0], 0.01);
  EXPECT_EQ(turns[1], 50.0);
  EXPECT_NEAR(turns[2], 3.0, 1e-12);
}

}  // namespace noise_test
}  // namespace boresight
