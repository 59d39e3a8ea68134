// How often the wrong one of two models is chosen, where residuals follow one another.
#include "boresight_analyses/statistics/effective_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "repetition.hpp"

namespace boresight {
namespace effective_samples_test {

double normal(std::mt19937_64& engine) {
  return std::sqrt(-2.0 * std::log(repetition::uniform(engine))) * std::cos(2.0 * M_PI * repetition::uniform(engine));
}

// First-order noise of variance 1.
std::vector<double> noise(std::mt19937_64& engine, int n, double follows) {
  std::vector<double> x(static_cast<std::size_t>(n));
  double last = normal(engine);
  for (double& v : x) v = last = follows * last + std::sqrt(1.0 - follows * follows) * normal(engine);
  return x;
}

struct Fit {
  double loss = 0.0;
  std::vector<double> residuals;
};

// Of a constant, or of a constant and a slope.
Fit fit(const std::vector<double>& y, bool slope) {
  const auto n = static_cast<double>(y.size());
  double mean = 0.0, product = 0.0, square = 0.0;
  for (const double v : y) mean += v / n;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double x = static_cast<double>(k) - 0.5 * (n - 1.0);
    product += x * y[k];
    square += x * x;
  }
  Fit f;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double x = static_cast<double>(k) - 0.5 * (n - 1.0);
    f.residuals.push_back(y[k] - mean - (slope ? x * product / square : 0.0));
    f.loss += f.residuals.back() * f.residuals.back();
  }
  return f;
}

std::vector<double> autocorrelations(const std::vector<double>& r, std::size_t lags) {
  std::vector<double> rho(lags + 1, 0.0);
  for (std::size_t l = 0; l <= lags; ++l)
    for (std::size_t k = 0; k + l < r.size(); ++k) rho[l] += r[k] * r[k + l];
  for (std::size_t l = lags + 1; l-- > 0;) rho[l] /= rho[0];
  return rho;
}

ResidualsOfBest residuals_of(const Fit& line) {
  const auto n = static_cast<double>(line.residuals.size());
  return {line.loss / n, values_per_independent_one(autocorrelations(line.residuals, 400), 3.0 / std::sqrt(n), n, 2.0),
          2.0};
}

TEST(EffectiveSamples, OfFirstOrderNoiseAreThoseOfItsSumOfAutocorrelations) {
  std::mt19937_64 engine(5);
  for (const double follows : {0.0, 0.5, 0.9}) {
    const std::vector<double> x = noise(engine, 200000, follows);
    const double found = values_per_independent_one(autocorrelations(x, 200), 3.0 / std::sqrt(200000.0), 200000.0, 0.0);
    EXPECT_NEAR(found / ((1.0 + follows) / (1.0 - follows)), 1.0, 0.05) << follows;
  }
  EXPECT_EQ(values_per_independent_one({1.0, -0.5, 0.4}, 0.01, 100.0, 2.0), 1.0);
}

TEST(EffectiveSamples, TooFewOfThemSayNothing) {
  EXPECT_TRUE(std::isinf(akaike(100.0, 100.0, 3.0, {1.0, 25.0, 2.0})));
  // Hurvich and Tsai: n = 20 white values, two parameters: 12 / 17 beyond Akaike's own 2 K.
  EXPECT_NEAR(akaike(18.0, 20.0, 2.0, {0.9, 1.0, 2.0}), 18.0 + 4.0 + 12.0 / 17.0, 1e-12);
}

// The truth is a constant. A slope that noise alone makes is preferred where it takes off more than 2: with a chance of
// P(chi^2 > 2) = 0.157 for white residuals.
TEST(EffectiveSamples, TheWrongModelIsChosenNoMoreOftenForResidualsThatFollowOneAnother) {
  constexpr int kStudies = 1000;
  constexpr double kNominal = 0.1573;
  for (const double follows : {0.0, 0.5, 0.9, 0.97}) {
    int wrong = 0, wrong_as_if_white = 0;
    std::mt19937_64 engine(6);
    for (int study = 0; study < kStudies; ++study) {
      const std::vector<double> y = noise(engine, 2000, follows);
      const auto n = static_cast<double>(y.size());
      const Fit constant = fit(y, false), line = fit(y, true);
      wrong_as_if_white += line.loss + 4.0 < constant.loss + 2.0;
      const ResidualsOfBest best = residuals_of(line);
      wrong += akaike(line.loss, n, 3.0, best) < akaike(constant.loss, n, 2.0, best);
    }
    std::printf("autocorrelation %.2f: wrong choices %.3f (as if white: %.3f), nominal %.3f\n", follows,
                double(wrong) / kStudies, double(wrong_as_if_white) / kStudies, kNominal);
    EXPECT_LE(double(wrong) / kStudies, kNominal + 2.0 * std::sqrt(kNominal * (1.0 - kNominal) / kStudies)) << follows;
    if (follows > 0.4) {
      EXPECT_GT(double(wrong_as_if_white) / kStudies, 0.3) << follows;
    }
  }
}

// A slope of five standard errors is found all the same.
TEST(EffectiveSamples, AnEffectThatIsThereIsFound) {
  constexpr int kStudies = 200;
  constexpr double kFollows = 0.9;
  const double per_independent = (1.0 + kFollows) / (1.0 - kFollows);
  int right = 0;
  std::mt19937_64 engine(7);
  for (int study = 0; study < kStudies; ++study) {
    std::vector<double> y = noise(engine, 2000, kFollows);
    const auto n = static_cast<double>(y.size());
    for (std::size_t k = 0; k < y.size(); ++k)
      y[k] += 5.0 * std::sqrt(12.0 * per_independent / n) * static_cast<double>(k) / n;
    const Fit constant = fit(y, false), line = fit(y, true);
    const ResidualsOfBest best = residuals_of(line);
    right += akaike(line.loss, n, 3.0, best) < akaike(constant.loss, n, 2.0, best);
  }
  EXPECT_GE(right, 0.98 * kStudies);
}

}  // namespace effective_samples_test
}  // namespace boresight
