#include "boresight_analyses/statistics/independent_samples.hpp"

#include <gmock/gmock.h>
#include <gsl/gsl_cdf.h>

#include <type_traits>

#include "boresight_analyses/statistics/replicated_samples.hpp"
#include "repetition.hpp"

namespace boresight {
namespace independent_samples_test {

using repetition::coverage;
using repetition::uniform;

// Samples of independent and of dependent designs cannot stand in for each other.
static_assert(!std::is_convertible_v<IndependentInterval, ReplicatedInterval>);
static_assert(!std::is_convertible_v<ReplicatedInterval, IndependentInterval>);
static_assert(!std::is_constructible_v<IndependentInterval, ReplicatedInterval>);
static_assert(!std::is_constructible_v<IndependentSamples, ReplicatedSamples>);
static_assert(!std::is_convertible_v<std::vector<double>, IndependentSamples>);

// The t interval of 1..10 by hand: t(0.975, 9) = 2.262157 (tests/reference/statistics_tables.py), sd = sqrt(55 / 6).
TEST(IndependentSamples, MeanIntervalIsStudents) {
  const IndependentSamples s({10, 9, 8, 7, 6, 5, 4, 3, 2, 1});
  const IndependentInterval mean = s.mean(0.95);
  EXPECT_DOUBLE_EQ(mean.value, 5.5);
  EXPECT_NEAR(mean.high - 5.5, 2.262157163 * 3.0276503541 / std::sqrt(10.0), 1e-8);
  EXPECT_NEAR(s.sd(0.95).value, 3.0276503541, 1e-9);
}

TEST(IndependentSamples, QuantileEndsAreOrderStatistics) {
  const IndependentInterval median = IndependentSamples({10, 9, 8, 7, 6, 5, 4, 3, 2, 1}).quantile(0.5, 0.95);
  EXPECT_EQ(median.value, 5.5);
  EXPECT_EQ(median.low, 2.0);
  EXPECT_EQ(median.high, 9.0);
  EXPECT_TRUE(median.exact);
  EXPECT_NEAR(median.coverage, 0.978515625, 1e-12);
}

// Two failed samples may lie anywhere: the ends are those of the ten or of the ten with both below or both above.
TEST(IndependentSamples, FailedSamplesWidenAQuantileAndCountAsBad) {
  std::vector<double> values(98);
  for (int k = 0; k < 98; ++k) values[k] = k + 1;
  const IndependentSamples with(values, 2);
  std::vector<double> below = values, above = values;
  for (const double v : {-1.0, -2.0}) below.push_back(v);
  for (const double v : {1001.0, 1002.0}) above.push_back(v);
  EXPECT_EQ(with.quantile(0.9, 0.95).low, IndependentSamples(below).quantile(0.9, 0.95).low);
  EXPECT_EQ(with.quantile(0.9, 0.95).high, IndependentSamples(above).quantile(0.9, 0.95).high);
  EXPECT_EQ(with.quantile(0.97, 0.95).high, std::numeric_limits<double>::infinity());
  const IndependentInterval good = with.probability_below(1e9, 0.95),
                            counted = IndependentSamples(above).probability_below(1000, 0.95);
  EXPECT_EQ(good.value, 0.98);
  EXPECT_EQ(good.low, counted.low);
  EXPECT_EQ(good.high, counted.high);
}

TEST(IndependentSamples, AreRefusedWithoutFiniteValues) {
  EXPECT_THROW(IndependentSamples({1.0, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(IndependentSamples({1.0}).mean(0.95), std::invalid_argument);
  EXPECT_THROW(IndependentSamples({}).quantile(0.5, 0.95), std::invalid_argument);
}

// Lognormal, median 1, ln sd 0.5: skewed as pointing errors are.
double lognormal(std::mt19937_64& engine) { return std::exp(0.5 * gsl_cdf_ugaussian_Pinv(uniform(engine))); }
IndependentSamples lognormals(std::mt19937_64& engine, int n) {
  std::vector<double> values(n);
  for (double& v : values) v = lognormal(engine);
  return IndependentSamples(std::move(values));
}
void expect_nominal(double share) {
  EXPECT_GE(share, 0.93);
  EXPECT_LE(share, 0.97);
}

TEST(IndependentSamples, Cover95PercentOfTheTimeTheMean) {
  expect_nominal(coverage(
      std::exp(0.125), [](auto& e) { return lognormals(e, 400).mean(0.95); }, 1));
}
// As few and as skewed as samples of a multibody motion: Student's interval alone holds 86 of 100 here, Bonett's 74.
double more_lognormal(std::mt19937_64& engine) { return std::exp(gsl_cdf_ugaussian_Pinv(uniform(engine))); }
IndependentSamples few(std::mt19937_64& engine, int n) {
  std::vector<double> values(n);
  for (double& v : values) v = more_lognormal(engine);
  return IndependentSamples(std::move(values));
}
TEST(IndependentSamples, CoverTheMeanOfFewSkewedOnesToo) {
  EXPECT_GE(coverage(
                std::exp(0.5), [](auto& e) { return few(e, 20).mean(0.95); }, 11),
            0.91);
  EXPECT_GE(coverage(
                std::exp(0.5), [](auto& e) { return few(e, 100).mean(0.95); }, 12),
            0.93);
}
TEST(IndependentSamples, CoverTheSdOfFewSkewedOnesMoreThan83TimesInAHundred) {
  const double sd = std::sqrt(std::exp(1.0) * std::expm1(1.0));
  EXPECT_GE(coverage(
                sd, [](auto& e) { return few(e, 40).sd(0.95); }, 13),
            0.83);
  EXPECT_GE(coverage(
                sd, [](auto& e) { return few(e, 200).sd(0.95); }, 14),
            0.87);
}
TEST(IndependentSamples, ThatAreAllAlikeSayWhatTheyDoNotShow) {
  const IndependentSamples s(std::vector<double>(60, 2.0));
  EXPECT_EQ(s.mean(0.95).low, s.mean(0.95).high);
  EXPECT_THAT(s.mean(0.95).basis, testing::HasSubstr("up to 5 % of other ones would go unseen"));
  EXPECT_THAT(s.sd(0.95).basis, testing::HasSubstr("unseen"));
}

TEST(IndependentSamples, Cover95PercentOfTheTimeTheSd) {
  expect_nominal(coverage(
      std::exp(0.125) * std::sqrt(std::expm1(0.25)), [](auto& e) { return lognormals(e, 2000).sd(0.95); }, 2));
}
TEST(IndependentSamples, Cover95PercentOfTheTimeTheMedian) {
  expect_nominal(coverage(
      1.0, [](auto& e) { return lognormals(e, 500).quantile(0.5, 0.95); }, 3));
}
TEST(IndependentSamples, Cover95PercentOfTheTimeThe95thPercentile) {
  expect_nominal(coverage(
      std::exp(0.5 * gsl_cdf_ugaussian_Pinv(0.95)), [](auto& e) { return lognormals(e, 1000).quantile(0.95, 0.95); },
      4));
}
TEST(IndependentSamples, Cover95PercentOfTheTimeThe9973Percentile) {
  expect_nominal(coverage(
      std::exp(0.5 * gsl_cdf_ugaussian_Pinv(0.9973)),
      [](auto& e) { return lognormals(e, 4000).quantile(0.9973, 0.95); }, 5));
}
// Clopper-Pearson's discreteness: at n p of some hundreds it is close to nominal.
TEST(IndependentSamples, Cover95PercentOfTheTimeTheProbability) {
  expect_nominal(coverage(
      0.8,
      [](auto& e) { return lognormals(e, 1000).probability_below(std::exp(0.5 * gsl_cdf_ugaussian_Pinv(0.8)), 0.95); },
      6));
}

}  // namespace independent_samples_test
}  // namespace boresight
