#include "boresight_analyses/statistics/binomial.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reference/reference.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace binomial_test {

// Published tables: 95/95 takes 59, 93, 124 runs (Wilks 1941; NUREG/IAEA practice); the others recomputed exactly.
TEST(Wilks, OneSidedSizesMeetTheTables) {
  const char* const fewest[] = {"59", "93", "124"};
  for (int above = 0; above < 3; ++above)
    validation::expect_printed("Wilks 1941",
                               "samples for 95 % with 95 % confidence, one-sided, " + std::to_string(above) + " above",
                               fewest[above], static_cast<double>(wilks_one_sided(0.95, 0.95, above)), 0.0);
  for (const reference::Row& row : reference::table("statistics_tables", "wilks"))
    EXPECT_EQ(wilks_one_sided(row[0], row[1], static_cast<std::int64_t>(row[2])), static_cast<std::int64_t>(row[3]))
        << row[1];
}

// Two-sided 95/95: 93, and 90/90: 38, 99/99: 662 (Wilks 1941; Guba, Makai, Pal 2003, Table 2).
TEST(Wilks, TwoSidedSizesMeetTheTables) {
  const std::pair<double, const char*> fewest[] = {{0.95, "93"}, {0.90, "38"}, {0.99, "662"}};
  for (const auto& [p, printed] : fewest) {
    const std::string percent = std::to_string(std::lround(100.0 * p)) + " %";
    validation::expect_printed("Guba, Makai, Pal 2003, Table 2",
                               "samples for " + percent + " with " + percent + " confidence, two-sided", printed,
                               static_cast<double>(wilks_two_sided(p, p)), 0.0);
  }
}

// With no exceedance 1 - p^n >= confidence, and one sample fewer does not do.
TEST(Wilks, SizeIsTheFewestThatDo) {
  for (const double p : {0.5, 0.9, 0.999, 0.999999})
    for (const double confidence : {0.5, 0.9, 0.99}) {
      const std::int64_t n = wilks_one_sided(p, confidence);
      EXPECT_GE(-std::expm1(double(n) * std::log(p)), confidence * (1.0 - 1e-12)) << p;
      EXPECT_LT(-std::expm1(double(n - 1) * std::log(p)), confidence) << p;
    }
}

// Clopper, Pearson (1934) for 10 of 100: 0.0490 to 0.1762; none of n: 1 - (risk)^(1/n).
TEST(ClopperPearson, MeetsKnownBounds) {
  const ProbabilityBounds ten = clopper_pearson(10, 100, 0.95);
  const reference::Row exact = reference::line("statistics_tables", "clopper-pearson");
  EXPECT_NEAR(ten.low, exact[0], 1e-8);
  EXPECT_NEAR(ten.high, exact[1], 1e-8);
  validation::expect_printed("Clopper, Pearson 1934", "10 of 100, 95 %: lower bound", "0.0490", ten.low, 5e-5);
  validation::expect_printed("Clopper, Pearson 1934", "10 of 100, 95 %: upper bound", "0.1762", ten.high, 5e-5);
  EXPECT_EQ(clopper_pearson(0, 50, 0.95).low, 0.0);
  EXPECT_NEAR(clopper_pearson(0, 50, 0.95).high, 1.0 - std::pow(0.025, 1.0 / 50.0), 1e-14);
  EXPECT_EQ(clopper_pearson(50, 50, 0.95).high, 1.0);
  // Wilks' statement read the other way round.
  EXPECT_GE(clopper_pearson_lower(1109, 1109, 0.95), 0.9973);
  EXPECT_LT(clopper_pearson_lower(1108, 1108, 0.95), 0.9973);
  EXPECT_NEAR(clopper_pearson_upper(0, 50, 0.95), 1.0 - std::pow(0.05, 1.0 / 50.0), 1e-14);
  EXPECT_THROW(clopper_pearson(3, 2, 0.95), std::invalid_argument);
  EXPECT_THROW(clopper_pearson(0, 0, 0.95), std::invalid_argument);
}

TEST(ClopperPearson, HoldsForABillionSamples) {
  const ProbabilityBounds b = clopper_pearson(2'700'000, 1'000'000'000, 0.95);
  EXPECT_NEAR(b.low, 2.7e-3 - 1.95996 * std::sqrt(2.7e-3 / 1e9), 1e-8);
  EXPECT_NEAR(b.high, 2.7e-3 + 1.95996 * std::sqrt(2.7e-3 / 1e9), 1e-8);
}

// The coverage against GSL's binomial; no narrower pair of neighbouring ranks does.
TEST(QuantileRanks, CoverTheQuantileWithTheStatedProbability) {
  for (const int n : {1, 10, 59, 100, 1000, 20000})
    for (const double p : {0.01, 0.5, 0.95, 0.9973}) {
      const QuantileRanks r = quantile_ranks(n, p, 0.95);
      const auto cdf = [&](std::int64_t k) {
        return k < 0 ? 0.0 : k >= n ? 1.0 : gsl_cdf_binomial_P(static_cast<unsigned>(k), p, static_cast<unsigned>(n));
      };
      EXPECT_NEAR(r.coverage, cdf(r.high - 1) - cdf(r.low - 1), 1e-9);
      EXPECT_GE(r.coverage, 0.95);
      EXPECT_LT(cdf(r.high - 1) - cdf(r.low), 0.95);
      EXPECT_LT(cdf(r.high - 2) - cdf(r.low - 1), 0.95);
    }
  // Median of 10: the classical 2nd and 9th order statistics, 97.85 %.
  const QuantileRanks median = quantile_ranks(10, 0.5, 0.95);
  EXPECT_EQ(median.low, 2);
  EXPECT_EQ(median.high, 9);
  validation::expect_printed("closed form, 1 - 22 / 1024", "coverage of the median of 10 by ranks 2 and 9",
                             "0.978515625", median.coverage, 1e-12);
}

TEST(QuantileRanks, LeaveUnboundedWhatTooFewSamplesCannotBound) {
  EXPECT_EQ(quantile_ranks(100, 0.9973, 0.95).high, 101);
  EXPECT_EQ(quantile_ranks(100, 0.001, 0.95).low, 0);
}

}  // namespace binomial_test
}  // namespace boresight
