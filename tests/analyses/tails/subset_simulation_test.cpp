#include "boresight_analyses/tails/subset_simulation.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "problems.hpp"

namespace boresight {
namespace subset_simulation_test {

using problems::phi;
using problems::pointwise;

struct Runs {
  double mean = 0.0, coefficient_of_variation = 0.0, stated = 0.0;
};
Runs runs(const BatchModel& model, int dimensions, double limit, int count) {
  Runs r;
  double square = 0.0;
  for (int k = 0; k < count; ++k) {
    SubsetOptions o;
    o.seed = 10 + static_cast<std::uint64_t>(k);
    const SubsetResult s = subset_simulation(model, dimensions, limit, o);
    EXPECT_TRUE(s.reached);
    r.mean += s.probability / count;
    square += s.probability * s.probability / count;
    r.stated += s.coefficient_of_variation / count;
  }
  r.coefficient_of_variation = std::sqrt(square - r.mean * r.mean) / r.mean;
  return r;
}

// The mean of 40 runs against the truth, with room for three standard errors and a bias of the order of 1 / samples.
void expect_meets(const Runs& r, double truth) {
  EXPECT_NEAR(r.mean / truth, 1.0, 3.0 * r.coefficient_of_variation / std::sqrt(40.0) + 0.02);
  EXPECT_LT(r.coefficient_of_variation, 0.5);
}

TEST(SubsetSimulation, MeetsALinearLimitStateInAnyDimension) {
  for (const int d : {2, 10}) expect_meets(runs(pointwise(problems::linear), d, 3.5, 40), phi(-3.5));
}
TEST(SubsetSimulation, MeetsAParallelSystem) {
  expect_meets(runs(pointwise(problems::parallel), 2, 2.0, 40), phi(-2.0) * phi(-2.0));
}
TEST(SubsetSimulation, MeetsTwoRegions) {
  expect_meets(runs(pointwise(problems::two_sided), 3, 3.5, 40), 2.0 * phi(-3.5));
}

// Au and Beck's estimate takes levels as independent: the right order, on the low side.
TEST(SubsetSimulation, StatesTheOrderOfItsScatter) {
  const Runs r = runs(pointwise(problems::linear), 5, 3.5, 40);
  EXPECT_GT(r.stated, 0.5 * r.coefficient_of_variation);
  EXPECT_LT(r.stated, 1.5 * r.coefficient_of_variation);
}

TEST(SubsetSimulation, CountsAFrequentExcessAsPlainMonteCarloDoes) {
  const SubsetResult s = subset_simulation(pointwise(problems::linear), 2, 0.5, {});
  EXPECT_EQ(s.evaluations, 1000);
  EXPECT_EQ(s.levels.size(), 1u);
  EXPECT_NEAR(s.coefficient_of_variation, std::sqrt((1.0 - s.probability) / (1000.0 * s.probability)), 1e-12);
  EXPECT_EQ(double(s.beyond.size()), 1000.0 * s.probability);
}

TEST(SubsetSimulation, SaysThatALimitIsOutOfReach) {
  const SubsetResult s = subset_simulation(pointwise([](const Point& u) { return std::tanh(u[0]); }), 1, 2.0, {});
  EXPECT_FALSE(s.reached);
  EXPECT_EQ(s.probability, 0.0);
}

TEST(SubsetSimulation, CountsFailedPointsAsBeyond) {
  const SubsetResult s = subset_simulation(
      pointwise([](const Point& u) { return u[0] > 3.0 ? std::numeric_limits<double>::quiet_NaN() : u[0]; }), 2, 3.0,
      {});
  EXPECT_TRUE(s.reached);
  EXPECT_GT(s.failed, 0);
  EXPECT_NEAR(s.probability / phi(-3.0), 1.0, 0.6);
}

TEST(SubsetSimulation, GivesTheSameBitsForTheSameSeed) {
  const SubsetResult a = subset_simulation(pointwise(problems::linear), 3, 3.0, {}),
                     b = subset_simulation(pointwise(problems::linear), 3, 3.0, {});
  EXPECT_EQ(a.probability, b.probability);
  EXPECT_EQ(a.beyond, b.beyond);
}

// The chains of the second level, put together again from the points that were asked for: every one of them moves, and the
// scatter stated is Au and Beck's, Eqs. 25-28, of these chains.
TEST(SubsetSimulation, MovesEveryChainAndStatesTheScatterOfThem) {
  SubsetOptions options;
  options.samples = 100;
  std::vector<Points> asked;
  const double limit = 2.0;
  const SubsetResult s = subset_simulation(
      [&](const Points& points) {
        asked.push_back(points);
        return pointwise(problems::linear)(points);
      },
      2, limit, options);
  ASSERT_EQ(s.levels.size(), 2u);
  Points at = asked[0];
  std::stable_sort(at.begin(), at.end(),
                   [](const Point& a, const Point& b) { return problems::linear(a) > problems::linear(b); });
  constexpr std::size_t kChains = 10, kLength = 10;
  at.resize(kChains);
  std::vector<std::vector<double>> beyond(kChains);
  double P = 0.0;
  for (std::size_t step = 0; step < kLength; ++step) {
    if (step > 0) {
      ASSERT_EQ(asked[step].size(), kChains);
      for (std::size_t c = 0; c < kChains; ++c) {
        EXPECT_NE(asked[step][c], at[c]) << "chain " << c << " stands still";
        if (problems::linear(asked[step][c]) > s.levels[0].threshold) at[c] = asked[step][c];
      }
    }
    for (std::size_t c = 0; c < kChains; ++c) beyond[c].push_back(problems::linear(at[c]) > limit ? 1.0 : 0.0);
    for (std::size_t c = 0; c < kChains; ++c) P += beyond[c].back() / double(kChains * kLength);
  }
  EXPECT_NEAR(s.levels[1].probability, P, 1e-12);
  double gamma = 0.0;
  for (std::size_t lag = 1; lag < kLength; ++lag) {
    double product = 0.0;
    for (const std::vector<double>& chain : beyond)
      for (std::size_t k = lag; k < kLength; ++k)
        product += chain[k - lag] * chain[k] / double(kChains * (kLength - lag));
    gamma += 2.0 * (1.0 - double(lag) / kLength) * (product - P * P) / (P * (1.0 - P));
  }
  EXPECT_NEAR(s.levels[1].coefficient_of_variation, std::sqrt((1.0 - P) / (P * kChains * kLength) * (1.0 + gamma)),
              1e-12);
}

}  // namespace subset_simulation_test
}  // namespace boresight
