#include "boresight_analyses/random/distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "boresight_analyses/random/disc_coordinate.hpp"
#include "boresight_analyses/random/fit_clearance.hpp"

namespace boresight {
namespace distribution_test {

std::vector<DistributionPtr> all_continuous() {
  return {make_normal(1e-4, 1e-5),
          make_uniform(0.7, 0.95),
          make_lognormal(0.03, 1.3),
          make_triangular(1.0, 2.0, 4.0),
          make_beta(2.0, 3.0, -1.0, 4.0),
          make_weibull(1.5, 2.0, 1.0),
          make_normal(0.0, 1.0)->truncated(-1.0, 2.0),
          make_triangular(1.0, 2.0, 4.0)->truncated(1.5, 3.0),
          make_normal(0.0, 1.0)->truncated(6.0, 9.0),
          make_fit_clearance(parse_fit("20 H7/g6"), ZoneLaw::normal),
          make_fit_clearance(parse_fit("20 H7/g6"), ZoneLaw::uniform),
          make_disc_coordinate(2.0, 0.3, 0.1),
          make_disc_coordinate(0.0, 1.0, 2.0)};
}

TEST(Distribution, QuantileCdfAndSurvivalAreInversesOfOneAnother) {
  for (const DistributionPtr& x : all_continuous()) {
    for (const double u : {1e-6, 0.01, 0.3, 0.5, 0.77, 0.99}) {
      EXPECT_NEAR(x->cdf(x->quantile(u)), u, 1e-9) << x->text();
      EXPECT_NEAR(x->survival(x->upper_quantile(u)) / u, 1.0, 1e-6) << x->text();
      EXPECT_NEAR(x->cdf(x->quantile(u)) + x->survival(x->quantile(u)), 1.0, 1e-12) << x->text();
    }
  }
}

TEST(Distribution, DensityIsTheSlopeOfTheCdf) {
  for (const DistributionPtr& x : all_continuous()) {
    for (const double u : {0.11, 0.45, 0.83}) {
      const double at = x->quantile(u), h = 1e-4 * (x->quantile(0.9) - x->quantile(0.1));
      const double slope = (x->cdf(at + h) - x->cdf(at - h)) / (2.0 * h);
      EXPECT_NEAR(x->density(at) / slope, 1.0, 1e-5) << x->text();
    }
  }
}

TEST(Distribution, MeanAndSdAreThoseOfItsQuantiles) {
  for (const DistributionPtr& x : all_continuous()) {
    constexpr int n = 50000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n; ++i) {
      const double u = (i + 0.5) / n;
      if (x->text().starts_with("fit") && i % 100 != 50) continue;
      const double value = x->quantile(u);
      sum += value, squares += value * value;
    }
    const double count = x->text().starts_with("fit") ? n / 100.0 : n;
    const double mean = sum / count, sd = std::sqrt(squares / count - mean * mean);
    EXPECT_NEAR(x->mean(), mean, 1e-3 * sd) << x->text();
    EXPECT_NEAR(x->sd() / sd, 1.0, 5e-3) << x->text();
  }
}

// Johnson, Kotz, Balakrishnan (1994), Continuous Univariate Distributions 1, section 13.10.
TEST(Distribution, MomentsOfATruncatedNormalAreExact) {
  const double a = -1.0, b = 2.0;
  const auto phi = [](double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); };
  const double p = 0.5 * (std::erf(b / std::numbers::sqrt2) - std::erf(a / std::numbers::sqrt2));
  const double mean = (phi(a) - phi(b)) / p;
  const double variance = 1.0 + (a * phi(a) - b * phi(b)) / p - mean * mean;
  const DistributionPtr x = make_normal(5.0, 3.0)->truncated(2.0, 11.0);
  EXPECT_NEAR(x->mean(), 5.0 + 3.0 * mean, 1e-13);
  EXPECT_NEAR(x->sd(), 3.0 * std::sqrt(variance), 1e-13);
}

TEST(Distribution, QuadratureOfMomentsAgreesWithClosedForms) {
  for (const DistributionPtr& x :
       {make_lognormal(0.03, 1.3), make_triangular(1.0, 2.0, 4.0), make_weibull(1.5, 2.0, 1.0)}) {
    const DistributionPtr whole = x->truncated(x->lowest(), x->upper_quantile(1e-300));
    EXPECT_NEAR(whole->mean() / x->mean(), 1.0, 1e-12) << x->text();
    EXPECT_NEAR(whole->sd() / x->sd(), 1.0, 1e-11) << x->text();
  }
}

TEST(Distribution, TruncationFarOutInATailKeepsItsDigits) {
  const DistributionPtr x = make_normal(0.0, 1.0)->truncated(10.0, 12.0);
  // The quantile at 1/2 lies where the tail beyond it is the mean of those beyond 10 and beyond 12.
  const auto beyond = [](double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); };
  EXPECT_NEAR(beyond(x->quantile(0.5)) / (0.5 * (beyond(10.0) + beyond(12.0))), 1.0, 1e-9);
  EXPECT_GE(x->quantile(1e-12), 10.0);
  EXPECT_LE(x->upper_quantile(1e-12), 12.0);
}

TEST(Distribution, TruncationWithoutProbabilityIsRefused) {
  EXPECT_THROW(make_uniform(0.0, 1.0)->truncated(2.0, 3.0), std::domain_error);
  EXPECT_THROW(make_discrete({1.0, 2.0}, {0.5, 0.5})->truncated(3.0, 4.0), std::domain_error);
}

TEST(Distribution, ADiscreteOneTakesItsValuesWithTheirProbabilities) {
  const DistributionPtr x = make_discrete({3.0, 1.0, 2.0}, {0.5, 0.2, 0.3});
  EXPECT_EQ(x->quantile(0.1), 1.0);
  EXPECT_EQ(x->quantile(0.2), 1.0);
  EXPECT_EQ(x->quantile(0.21), 2.0);
  EXPECT_EQ(x->quantile(0.51), 3.0);
  EXPECT_EQ(x->cdf(2.5), 0.5);
  EXPECT_EQ(x->cdf(0.9), 0.0);
  EXPECT_EQ(x->cdf(3.0), 1.0);
  EXPECT_EQ(x->survival(0.9), 1.0);
  EXPECT_NEAR(x->mean(), 2.3, 1e-15);
  EXPECT_NEAR(x->sd(), std::sqrt(0.2 * 1.69 + 0.3 * 0.09 + 0.5 * 0.49), 1e-15);
  EXPECT_EQ(x->truncated(1.5, 9.0)->quantile(0.3), 2.0);  // 0.3 / 0.8 = 0.375
  EXPECT_EQ(x->truncated(1.5, 9.0)->quantile(0.4), 3.0);
}

TEST(Distribution, AnEmpiricalOneResamplesWhatWasMeasured) {
  const DistributionPtr x = make_empirical({4.0, 2.0, 2.0, 8.0});
  EXPECT_EQ(x->quantile(0.49), 2.0);
  EXPECT_EQ(x->quantile(0.6), 4.0);
  EXPECT_EQ(x->quantile(0.99), 8.0);
  EXPECT_EQ(x->mean(), 4.0);
}

TEST(Distribution, LognormalFactorIsOneStandardDeviationOfTheLogarithm) {
  const DistributionPtr x = make_lognormal(0.03, 1.3);
  EXPECT_NEAR(x->quantile(0.5), 0.03, 1e-16);
  EXPECT_NEAR(x->cdf(0.03 * 1.3) - x->cdf(0.03 / 1.3), 0.682689492137, 1e-12);
}

}  // namespace distribution_test
}  // namespace boresight
