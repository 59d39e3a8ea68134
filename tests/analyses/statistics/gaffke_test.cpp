#include "boresight_analyses/statistics/gaffke.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "boresight_analyses/statistics/binomial.hpp"
#include "repetition.hpp"

namespace boresight {
namespace gaffke_test {

TEST(Gaffke, OfValuesThatAreZeroOrOneIsClopperAndPearson) {
  for (const int n : {1, 2, 5, 16, 64})
    for (const int hits : {0, 1, n / 2, n - 1, n}) {
      std::vector<double> values(static_cast<std::size_t>(n), 0.0);
      std::fill_n(values.begin(), hits, 1.0);
      for (const double risk : {0.1, 0.025, 0.005})
        EXPECT_NEAR(gaffke_lower(values, 0.0, risk), clopper_pearson_lower(hits, n, 1.0 - risk), 1e-8)
            << hits << " of " << n;
    }
}

// By its definition: pieces of a unit that uniform cuts leave. 200,000 draws scatter by 0.0007 at a risk of 0.1.
TEST(Gaffke, IsTheQuantileOfValuesWeightedByThePiecesThatUniformCutsLeave) {
  const std::vector<double> values = {0.2, 0.2, 0.5, 0.7, 0.7, 0.7, 1.3};
  const double bound = gaffke_lower(values, -0.1, 0.1);
  std::mt19937_64 engine(3);
  constexpr int kDraws = 200000;
  int below = 0;
  for (int k = 0; k < kDraws; ++k) {
    std::vector<double> cuts = {0.0, 1.0};
    for (std::size_t i = 0; i < values.size(); ++i) cuts.push_back(repetition::uniform(engine));
    std::sort(cuts.begin(), cuts.end());
    double sum = -0.1 * (cuts[1] - cuts[0]);
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * (cuts[i + 2] - cuts[i + 1]);
    below += sum <= bound;
  }
  EXPECT_NEAR(double(below) / kDraws, 0.1, 0.003);
}

TEST(Gaffke, MovesAndStretchesWithItsValues) {
  const std::vector<double> values = {1.0, 2.0, 2.0, 5.0};
  std::vector<double> other;
  for (const double v : values) other.push_back(3.0 * v - 40.0);
  EXPECT_NEAR(gaffke_lower(other, -40.0, 0.05), 3.0 * gaffke_lower(values, 0.0, 0.05) - 40.0, 1e-8);
}

// Lognormal values, which no bound above holds: Student's t errs on the other side of the mean, where the long tail is.
TEST(Gaffke, ErrsNoMoreOftenThanItsRisk) {
  std::mt19937_64 engine(11);
  std::lognormal_distribution<double> heavy(0.0, 1.0);
  int above = 0;
  constexpr int kSets = 2000;
  for (int k = 0; k < kSets; ++k) {
    std::vector<double> values(8);
    for (double& v : values) v = heavy(engine);
    above += gaffke_lower(values, 0.0, 0.1) > std::exp(0.5);
  }
  EXPECT_LE(above, 0.1 * kSets);
}

TEST(Gaffke, RefusesWhatHasNoBound) {
  EXPECT_THROW(gaffke_lower({}, 0.0, 0.1), std::invalid_argument);
  EXPECT_THROW(gaffke_lower({1.0, -1.0}, 0.0, 0.1), std::invalid_argument);
  EXPECT_THROW(gaffke_lower({1.0}, 0.0, 0.0), std::invalid_argument);
  EXPECT_EQ(gaffke_lower({2.0, 2.0}, 2.0, 0.1), 2.0);
}

}  // namespace gaffke_test
}  // namespace boresight
