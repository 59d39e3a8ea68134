// Distributions and what samples say of a quantile, against OpenTURNS (Baudin, Dutfoy, Iooss, Popelin 2017,
// Handbook of Uncertainty Quantification, 2001-2038).
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <openturns/Beta.hxx>
#include <openturns/Binomial.hxx>
#include <openturns/LogNormal.hxx>
#include <openturns/Normal.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/Triangular.hxx>
#include <openturns/TruncatedDistribution.hxx>
#include <openturns/WeibullMin.hxx>
#include <openturns/Wilks.hxx>

#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/independent_samples.hpp"

namespace boresight {
namespace {

constexpr double kLevels[] = {1e-6, 1e-3, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 0.999, 1.0 - 1e-6};

// Quantiles relative to their own size or the sd, whichever is larger.
void expect_the_same(const Distribution& ours, const OT::Distribution& theirs, double tolerance) {
  const double sd = theirs.getStandardDeviation()[0];
  EXPECT_NEAR(ours.mean(), theirs.getMean()[0], 1e-8 * sd) << ours.text();
  EXPECT_NEAR(ours.sd(), sd, 1e-8 * sd) << ours.text();
  for (const double u : kLevels) {
    const double x = theirs.computeScalarQuantile(u), tail = theirs.computeScalarQuantile(u, true);
    EXPECT_NEAR(ours.quantile(u), x, tolerance * std::max(std::abs(x), sd)) << ours.text() << " at " << u;
    EXPECT_NEAR(ours.upper_quantile(u), tail, tolerance * std::max(std::abs(tail), sd))
        << ours.text() << " above " << u;
    // A truncated one is a difference of two probabilities: a rounding of theirs, over the mass that is left,
    // is its own.
    const double below = theirs.computeCDF(x);
    EXPECT_NEAR(ours.cdf(x), below, 1e-10 * below + 1e-15) << ours.text() << " at " << x;
    EXPECT_NEAR(ours.density(x) / theirs.computePDF(x), 1.0, 1e-10) << ours.text() << " at " << x;
  }
}

constexpr double kTight = 1e-10;

TEST(DistributionsAgreeWithOpenTurns, Normal) {
  expect_the_same(*make_normal(1e-4, 2e-5), OT::Normal(1e-4, 2e-5), kTight);
}
TEST(DistributionsAgreeWithOpenTurns, TruncatedNormal) {
  expect_the_same(*make_normal(1.0, 0.2)->truncated(0.7, 1.3),
                  OT::TruncatedDistribution(OT::Normal(1.0, 0.2), 0.7, 1.3), kTight);
  expect_the_same(*make_normal(1.0, 0.2)->truncated(1.1, 1.9),
                  OT::TruncatedDistribution(OT::Normal(1.0, 0.2), 1.1, 1.9), kTight);
}
TEST(DistributionsAgreeWithOpenTurns, Lognormal) {
  expect_the_same(*make_lognormal(0.5, 1.3), OT::LogNormal(std::log(0.5), std::log(1.3)), kTight);
}
TEST(DistributionsAgreeWithOpenTurns, Triangular) {
  expect_the_same(*make_triangular(1.0, 1.2, 2.0), OT::Triangular(1.0, 1.2, 2.0), kTight);
}
TEST(DistributionsAgreeWithOpenTurns, Beta) {
  expect_the_same(*make_beta(2.0, 5.0, -1.0, 3.0), OT::Beta(2.0, 5.0, -1.0, 3.0), kTight);
  expect_the_same(*make_beta(0.7, 1.5, 0.0, 1.0), OT::Beta(0.7, 1.5, 0.0, 1.0), kTight);
}
TEST(DistributionsAgreeWithOpenTurns, Weibull) {
  expect_the_same(*make_weibull(1.8, 0.3, 0.1), OT::WeibullMin(0.3, 1.8, 0.1), kTight);
}

// Hyndman and Fan (1996, The American Statistician 50): they take definition 5, position n p + 1/2, we
// definition 7, position (n - 1) p + 1. At the level that has the same position the two are one number.
TEST(SamplesAgreeWithOpenTurns, OnAQuantile) {
  OT::RandomGenerator::SetSeed(1);
  for (const unsigned n : {20u, 101u, 1000u}) {
    const OT::Sample sample = OT::WeibullMin(1.0, 1.5, 0.0).getSample(n);
    std::vector<double> values;
    for (unsigned k = 0; k < n; ++k) values.push_back(sample(k, 0));
    const IndependentSamples ours(values);
    for (const double p : {0.1, 0.5, 0.9, 0.95}) {
      const IndependentInterval q = ours.quantile(p, 0.9);
      const double theirs = sample.computeQuantile(((n - 1) * p + 0.5) / n)[0];
      EXPECT_NEAR(q.value, theirs, 1e-12) << n << " samples at " << p;
      const double at_p = sample.computeQuantile(p)[0];
      EXPECT_TRUE(q.low <= at_p && at_p <= q.high) << n << " samples at " << p;
    }
  }
}

TEST(SamplesAgreeWithOpenTurns, OnTheCoverageOfAQuantilesInterval) {
  for (const int n : {59, 200, 3000})
    for (const double p : {0.5, 0.9, 0.9973}) {
      const QuantileRanks r = quantile_ranks(n, p, 0.95);
      const OT::Binomial b(static_cast<OT::UnsignedInteger>(n), p);
      const double coverage =
          b.computeCDF(OT::Scalar(r.high - 1)) - (r.low > 0 ? b.computeCDF(OT::Scalar(r.low - 1)) : 0.0);
      EXPECT_NEAR(r.coverage, coverage, 1e-10) << n << " samples at " << p;
    }
}

// 500 samples of theirs, their quantile as the truth: three binomial standard errors below the coverage
// stated.
TEST(SamplesAgreeWithOpenTurns, ThatIntervalsHoldTheirQuantile) {
  OT::RandomGenerator::SetSeed(2);
  const OT::LogNormal law(0.0, 0.5);
  const double truth = law.computeQuantile(0.9)[0];
  int held = 0;
  double stated = 0.0;
  for (int k = 0; k < 500; ++k) {
    const OT::Sample sample = law.getSample(150);
    std::vector<double> values;
    for (unsigned i = 0; i < 150; ++i) values.push_back(sample(i, 0));
    const IndependentInterval q = IndependentSamples(values).quantile(0.9, 0.95);
    held += q.low <= truth && truth <= q.high;
    stated = q.coverage;
  }
  EXPECT_NEAR(held / 500.0, stated, 3.0 * std::sqrt(stated * (1.0 - stated) / 500.0));
}

TEST(SamplesAgreeWithOpenTurns, OnWilksSizes) {
  for (const double p : {0.5, 0.9, 0.95, 0.9973})
    for (const double c : {0.9, 0.95, 0.99})
      for (const unsigned m : {0u, 1u, 3u})
        EXPECT_EQ(wilks_one_sided(p, c, m), static_cast<std::int64_t>(OT::Wilks::ComputeSampleSize(p, c, m)))
            << p << ' ' << c << ' ' << m;
}

}  // namespace
}  // namespace boresight
