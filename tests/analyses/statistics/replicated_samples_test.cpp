#include "boresight_analyses/statistics/replicated_samples.hpp"

#include <gmock/gmock.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <functional>
#include <map>
#include <numeric>

#include "repetition.hpp"

namespace boresight {
namespace replicated_samples_test {

using repetition::coverage;
using repetition::Points;

// exp of the sum of three normals with sd 0.4, 0.3, 0.2: lognormal in closed form, monotone, three dimensions.
const double kLogSd = std::sqrt(0.16 + 0.09 + 0.04);
double value(const std::vector<double>& u) {
  return std::exp(0.4 * gsl_cdf_ugaussian_Pinv(u[0]) + 0.3 * gsl_cdf_ugaussian_Pinv(u[1]) +
                  0.2 * gsl_cdf_ugaussian_Pinv(u[2]));
}
template <typename SamplingDesign>
ReplicatedSamples replicates(std::mt19937_64& engine, SamplingDesign&& design, int count, int size) {
  std::vector<std::vector<double>> values(count);
  for (auto& r : values)
    for (const auto& u : design(engine, size, 3)) r.push_back(value(u));
  return ReplicatedSamples(std::move(values));
}
double true_quantile(double p) { return std::exp(kLogSd * gsl_cdf_ugaussian_Pinv(p)); }

using Lists = std::vector<std::vector<double>>;

TEST(ReplicatedSamples, MeanIsStudentsOverReplicates) {
  const ReplicatedInterval mean = ReplicatedSamples(Lists{{1, 2, 3}, {2, 3, 4}, {4, 4, 4}}).mean(0.95);
  EXPECT_DOUBLE_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.high - 3.0, 4.302652730 * 1.0 / std::sqrt(3.0), 1e-8);
}

TEST(ReplicatedSamples, AreRefusedWhereTheyGiveNoInterval) {
  EXPECT_THROW(ReplicatedSamples(Lists{{1.0, 2.0}}), std::invalid_argument);
  EXPECT_THROW(ReplicatedSamples(Lists{{1.0, 2.0}, {1.0}}), std::invalid_argument);
  EXPECT_NO_THROW(ReplicatedSamples(Lists{{1.0, 2.0}, {1.0}}, {0, 1}));
  EXPECT_THROW(ReplicatedSamples(Lists{{1.0}, {std::nan("")}}), std::invalid_argument);
}

TEST(ReplicatedSamples, WithoutABadSampleAreBoundedByReplicatesThatHoldTwoOrNone) {
  const ReplicatedInterval p = ReplicatedSamples(Lists{{1, 2}, {1, 2}, {1, 2}, {1, 2}}).probability_below(3.0, 0.95);
  EXPECT_EQ(p.value, 1.0);
  EXPECT_NEAR(p.low, std::pow(0.025, 0.25), 1e-14);
  EXPECT_EQ(p.high, 1.0);
  const Lists nets(16, std::vector<double>(256, 1.0));
  EXPECT_NEAR(ReplicatedSamples(nets).probability_below(3.0, 0.95).low,
              1.0 - (1.0 - std::pow(0.025, 1.0 / 16.0)) / 128.0, 1e-14);
  EXPECT_NEAR(ReplicatedSamples(nets).probability_below(0.0, 0.95).high, (1.0 - std::pow(0.025, 1.0 / 16.0)) / 128.0,
              1e-14);
}

// The same samples against wider and wider limits: none bound it more closely than the one that all of them keep.
TEST(ReplicatedSamples, WithoutABadSampleAreSurerThanWithSome) {
  struct Design {
    int replicates, size;
  };
  for (const Design& d :
       {Design{2, 500}, Design{4, 64}, Design{8, 32}, Design{16, 4}, Design{16, 256}, Design{30, 20}}) {
    Lists dealt(static_cast<std::size_t>(d.replicates));
    const int all = d.replicates * d.size;
    for (int k = 0; k < all; ++k) dealt[static_cast<std::size_t>(k % d.replicates)].push_back(k);
    const ReplicatedSamples samples(dealt);
    for (const double confidence : {0.8, 0.9, 0.98}) {
      const double surest = samples.probability_below(all, confidence).low;
      for (int bad = 1; bad < std::min(60, all); ++bad)
        EXPECT_GT(surest, samples.probability_below(all - bad - 0.5, confidence).low)
            << d.replicates << " of " << d.size << ", " << bad << " bad";
    }
  }
}

// Two parameters alike within a little: bad samples of a hypercube lie along its diagonal and come together more often than independent
// ones do.
TEST(ReplicatedSamples, WithoutABadSampleAreNotSurerThanTheySay) {
  constexpr double kRisk = 0.05;
  std::mt19937_64 engine(5);
  struct Design {
    int replicates, size;
  };
  for (const Design& d : {Design{16, 4}, Design{10, 10}, Design{20, 20}}) {
    const double low = ReplicatedSamples(Lists(static_cast<std::size_t>(d.replicates),
                                               std::vector<double>(static_cast<std::size_t>(d.size), 0.0)))
                           .probability_below(1.0, 1.0 - 2.0 * kRisk)
                           .low;
    const double within = 1.0 - std::sqrt(low);  // P(|x - y| < within) = 1 - (1 - within)^2
    constexpr int kDrawn = 20000;
    int without = 0;
    for (int k = 0; k < kDrawn; ++k) {
      const Points points = repetition::latin_hypercube(engine, d.size, 2);
      without += std::none_of(points.begin(), points.end(),
                              [&](const std::vector<double>& u) { return std::abs(u[0] - u[1]) < within; });
    }
    const double chance = double(without) / kDrawn, error = std::sqrt(chance * (1.0 - chance) / kDrawn);
    EXPECT_LE(std::pow(chance - 2.0 * error, d.replicates), kRisk) << d.replicates << " of " << d.size;
  }
}

TEST(ReplicatedSamples, LeaveATailWithFewSamplesUnbounded) {
  std::mt19937_64 engine(7);
  const ReplicatedSamples s = replicates(engine, repetition::latin_hypercube, 4, 100);
  EXPECT_EQ(s.quantile(0.9973, 0.95).high, std::numeric_limits<double>::infinity());
  EXPECT_LT(s.quantile(0.95, 0.95).high, std::numeric_limits<double>::infinity());
}

// 1 to 400, dealt to four replicates in turn: every one has its half below 200.5, and what is left is the rounding of their shares.
// Four miss what is up to two steps of a hundredth away with a chance of 0.025 where the average share lies 1 - 0.025^(1/4) of that away: 0.48795, 0.51205.
TEST(ReplicatedSamples, ReadWoodruffsIntervalThroughThePooledSamples) {
  Lists dealt(4);
  for (int k = 0; k < 400; ++k) dealt[static_cast<std::size_t>(k % 4)].push_back(k + 1);
  const ReplicatedInterval median = ReplicatedSamples(std::move(dealt)).quantile(0.5, 0.95);
  EXPECT_EQ(median.value, 200.5);
  EXPECT_EQ(median.low, 195.0);   // 195.2 samples
  EXPECT_EQ(median.high, 205.0);  // 204.8 samples
}

// A net of one parameter has as many samples below the limit as it ought to, or one more, each time by chance: p * size - that many. The chance that
// the lower bound lies above p is then a sum over how many of the nets have one more.
TEST(ReplicatedSamples, AreNotSurerThanTheySayWhereSharesTakeTwoNeighbouringValues) {
  struct Design {
    int replicates, size;
    double one_sided;
  };
  for (const Design& d : {Design{8, 64, 0.95}, Design{16, 64, 0.9}, Design{10, 100, 0.95}, Design{16, 16, 0.99}})
    for (int i = 1; i < 60; ++i) {
      const double p = 1.0 - 0.4 * i / 60.0 / 2.0, sought = p * d.size, one_more = sought - std::floor(sought);
      double above = 0.0;
      for (int k = 0; k <= d.replicates; ++k) {
        Lists nets(static_cast<std::size_t>(d.replicates), std::vector<double>(static_cast<std::size_t>(d.size), 1.0));
        for (int r = 0; r < d.replicates; ++r)
          std::fill_n(nets[static_cast<std::size_t>(r)].begin(), static_cast<int>(sought) + (r < k ? 1 : 0), 0.0);
        const double low = ReplicatedSamples(nets).probability_below(0.5, 2.0 * d.one_sided - 1.0).low;
        if (low >= p)
          above += gsl_ran_binomial_pdf(static_cast<unsigned>(k), one_more, static_cast<unsigned>(d.replicates));
      }
      EXPECT_LE(above, 1.0 - d.one_sided + 1e-9) << d.replicates << " of " << d.size << ", p = " << p;
    }
}

// The chance that the lower bound of P(value <= limit) lies above its truth, where a net of 64 has `first` samples below the limit and each of some
// cells that the limit cuts adds another, by a chance of its own. Every outcome of the nets is counted.
double chance_of_too_high_a_bound(int nets, const std::vector<double>& cells, double risk,
                                  std::map<std::vector<int>, double>& bounds) {
  constexpr int kSize = 64, kFirst = 52;
  std::vector<double> chance{1.0};  // of as many more
  for (const double p : cells) {
    std::vector<double> next(chance.size() + 1, 0.0);
    for (std::size_t k = 0; k < chance.size(); ++k) {
      next[k] += chance[k] * (1.0 - p);
      next[k + 1] += chance[k] * p;
    }
    chance = std::move(next);
  }
  const double truth = (kFirst + std::accumulate(cells.begin(), cells.end(), 0.0)) / kSize;
  double above = 0.0;
  std::vector<int> nets_with(chance.size(), 0);  // as many more
  const std::function<void(std::size_t, int, double)> deal = [&](std::size_t k, int left, double log_ways) {
    if (k + 1 == chance.size()) {
      nets_with[k] = left;
      const auto [bound, fresh] = bounds.try_emplace(nets_with, 0.0);
      if (fresh) {
        Lists samples;
        for (std::size_t more = 0; more < nets_with.size(); ++more)
          for (int r = 0; r < nets_with[more]; ++r) {
            samples.emplace_back(static_cast<std::size_t>(kSize), 1.0);
            std::fill_n(samples.back().begin(), kFirst + static_cast<int>(more), 0.0);
          }
        bound->second = ReplicatedSamples(std::move(samples)).probability_below(0.5, 1.0 - 2.0 * risk).low;
      }
      if (bound->second > truth + 1e-9)
        above += std::exp(log_ways + left * std::log(chance[k]) - std::lgamma(left + 1.0));
      return;
    }
    for (int n = 0; n <= left; ++n) {
      nets_with[k] = n;
      deal(k + 1, left - n, log_ways + n * std::log(chance[k]) - std::lgamma(n + 1.0));
    }
  };
  deal(0, nets, std::lgamma(nets + 1.0));
  return above;
}

TEST(ReplicatedSamples, OfAFewCutCellsAreNotSurerThanTheySay) {
  for (const int nets : {4, 8, 16})
    for (const double risk : {0.1, 0.05, 0.025, 0.01})
      for (const int cells : {2, 4}) {
        std::map<std::vector<int>, double> bounds;
        for (const double a : {0.02, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.98})
          for (const double b : {0.02, 0.3, 0.7, 0.98}) {
            std::vector<double> chances(static_cast<std::size_t>(cells), b);
            std::fill_n(chances.begin(), cells / 2, a);
            EXPECT_LE(chance_of_too_high_a_bound(nets, chances, risk, bounds), risk)
                << nets << " nets, " << cells << " cells, of " << a << " and " << b << ", risk " << risk;
          }
      }
}

// Each replicate's mean is off by what its last stratum holds, which is skewed: Student's interval alone misses 0.128 of these.
TEST(ReplicatedSamples, OfSkewedValuesCoverTheirMeanNearlyAsOftenAsStated) {
  std::mt19937_64 engine(15);
  const double truth = std::exp(0.5);
  const int trials = 2000;
  int missed = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Lists values(16);
    for (auto& r : values)
      for (const auto& u : repetition::latin_hypercube(engine, 64, 1))
        r.push_back(std::exp(gsl_cdf_ugaussian_Pinv(u[0])));
    const ReplicatedInterval mean = ReplicatedSamples(std::move(values)).mean(0.95);
    missed += truth < mean.low || truth > mean.high;
  }
  EXPECT_LT(double(missed) / trials, 0.085);
}

TEST(ReplicatedSamples, OfALatinHypercubeAreFarNarrowerThanIndependentOnes) {
  std::mt19937_64 engine(8);
  const ReplicatedInterval mean = replicates(engine, repetition::latin_hypercube, 16, 256).mean(0.95);
  const double independent = 1.96 * std::exp(0.5 * kLogSd * kLogSd) * std::sqrt(std::expm1(kLogSd * kLogSd) / 4096.0);
  EXPECT_LT(mean.high - mean.low, independent);
}

struct Case {
  const char* name;
  Points (*design)(std::mt19937_64&, int, int);
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
class ReplicatedDesigns : public testing::TestWithParam<Case> {
 protected:
  template <typename F>
  void expect_covered(double truth, F&& interval, int size) {
    const double held = coverage(
        truth, [&](auto& e) { return interval(replicates(e, GetParam().design, 16, size)); }, 11);
    RecordProperty("coverage", std::to_string(held));
    EXPECT_GE(held, 0.93);
  }
};

TEST_P(ReplicatedDesigns, CoverTheMean) {
  expect_covered(
      std::exp(0.5 * kLogSd * kLogSd), [](const ReplicatedSamples& s) { return s.mean(0.95); }, 32);
}
TEST_P(ReplicatedDesigns, CoverTheSd) {
  expect_covered(
      std::exp(0.5 * kLogSd * kLogSd) * std::sqrt(std::expm1(kLogSd * kLogSd)),
      [](const ReplicatedSamples& s) { return s.sd(0.95); }, 128);
}
TEST_P(ReplicatedDesigns, CoverTheMedian) {
  expect_covered(
      1.0, [](const ReplicatedSamples& s) { return s.quantile(0.5, 0.95); }, 32);
}
TEST_P(ReplicatedDesigns, CoverThe9973Percentile) {
  expect_covered(
      true_quantile(0.9973), [](const ReplicatedSamples& s) { return s.quantile(0.9973, 0.95); }, 128);
}
TEST_P(ReplicatedDesigns, CoverTheProbability) {
  expect_covered(
      0.99, [](const ReplicatedSamples& s) { return s.probability_below(true_quantile(0.99), 0.95); }, 32);
}

INSTANTIATE_TEST_SUITE_P(Designs, ReplicatedDesigns,
                         testing::Values(Case{"LatinHypercube", repetition::latin_hypercube},
                                         Case{"ScrambledSobol", repetition::scrambled_sobol}),
                         [](const auto& one) { return one.param.name; });

}  // namespace replicated_samples_test
}  // namespace boresight
