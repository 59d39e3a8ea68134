// Sobol' indices against OpenTURNS, on the function of Ishigami and Homma (1990), which it takes from its own
// text.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/JansenSensitivityAlgorithm.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/SaltelliSensitivityAlgorithm.hxx>
#include <openturns/SobolIndicesExperiment.hxx>
#include <openturns/SymbolicFunction.hxx>
#include <openturns/Uniform.hxx>

#include "boresight_analyses/sensitivity/sobol_indices.hpp"
#include "repetition.hpp"
#include "tails/problems.hpp"

namespace boresight {
namespace {

using std::numbers::pi;

double ishigami(const Point& x) {
  return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}
const BatchModel kOurs = problems::pointwise([](const Point& u) {
  return ishigami({pi * (2.0 * u[0] - 1.0), pi * (2.0 * u[1] - 1.0), pi * (2.0 * u[2] - 1.0)});
});
OT::SymbolicFunction theirs() {
  OT::Description in(3), out(1, "sin(x1) + 7 * sin(x2)^2 + 0.1 * x3^4 * sin(x1)");
  for (unsigned k = 0; k < 3; ++k) in[k] = "x" + std::to_string(k + 1);
  return OT::SymbolicFunction(in, out);
}
OT::ComposedDistribution cube() {
  return OT::ComposedDistribution(OT::ComposedDistribution::DistributionCollection(3, OT::Uniform(-pi, pi)));
}

// Twelve comparisons of two intervals each: at 99.8 % all of them hold with a chance above 95 %.
TEST(SobolIndicesAgreeWithOpenTurns, OnIshigamiWithinBothIntervals) {
  constexpr double kConfidence = 0.998;
  OT::RandomGenerator::SetSeed(1);
  OT::SaltelliSensitivityAlgorithm peer(cube(), 10000, theirs());
  peer.setConfidenceLevel(kConfidence);
  const OT::Point first = peer.getFirstOrderIndices(), total = peer.getTotalOrderIndices();
  const OT::Interval firsts = peer.getFirstOrderIndicesInterval(), totals = peer.getTotalOrderIndicesInterval();

  std::mt19937_64 engine(1);
  Points ab(10000, Point(6));
  for (Point& p : ab)
    for (double& u : p) u = repetition::uniform(engine);
  const auto random =
      sobol_indices(sobol_rows(kOurs, ab, single_parameters(3)), BootstrapOptions{kConfidence, 2000, 1});
  std::vector<std::vector<SobolRow>> nets;
  for (int r = 0; r < 16; ++r)
    nets.push_back(sobol_rows(kOurs, repetition::scrambled_sobol(engine, 1024, 6), single_parameters(3)));
  const auto replicated = sobol_indices(nets, kConfidence);

  const auto overlap = [](const auto& ours, double low, double high) { return ours.low <= high && low <= ours.high; };
  for (unsigned g = 0; g < 3; ++g) {
    const double f0 = firsts.getLowerBound()[g], f1 = firsts.getUpperBound()[g];
    const double t0 = totals.getLowerBound()[g], t1 = totals.getUpperBound()[g];
    EXPECT_LT(f1 - f0, 0.25) << g;  // neither says too little to be held against the other
    EXPECT_LT(t1 - t0, 0.25) << g;
    EXPECT_LT(random.groups[g].first.high - random.groups[g].first.low, 0.15) << g;
    EXPECT_LT(replicated.groups[g].total.high - replicated.groups[g].total.low, 0.05) << g;
    EXPECT_TRUE(overlap(random.groups[g].first, f0, f1)) << g;
    EXPECT_TRUE(overlap(random.groups[g].total, t0, t1)) << g;
    // Nets settle the indices ten times closer: their value is to lie in the peer's interval.
    EXPECT_TRUE(f0 <= replicated.groups[g].first.value && replicated.groups[g].first.value <= f1) << g;
    EXPECT_TRUE(t0 <= replicated.groups[g].total.value && replicated.groups[g].total.value <= t1) << g;
    std::printf(
        "  x%u first %.4f [%.4f, %.4f] theirs, %.4f [%.4f, %.4f] ours; total %.4f [%.4f, %.4f], %.4f [%.4f, "
        "%.4f]\n",
        g + 1, first[g], f0, f1, random.groups[g].first.value, random.groups[g].first.low, random.groups[g].first.high,
        total[g], t0, t1, random.groups[g].total.value, random.groups[g].total.low, random.groups[g].total.high);
  }
}

// The same evaluations, rows made by the peer: Jansen's sums (total index) are the same. The peer divides
// them by 2 n - 1 and the variance of a alone, we by 2 n and that of a and b.
TEST(SobolIndicesAgreeWithOpenTurns, OnJansensSumsOfTheSameEvaluations) {
  constexpr unsigned n = 500;
  OT::RandomGenerator::SetSeed(3);
  const OT::Sample in = OT::SobolIndicesExperiment(cube(), n, false).generate(), out = theirs()(in);
  const OT::JansenSensitivityAlgorithm peer(in, out, n);
  double mean = 0.0, variance = 0.0;
  std::vector<SobolRow> rows(n);
  for (unsigned k = 0; k < n; ++k) {
    rows[k] = {out(k, 0), out(n + k, 0), {out(2 * n + k, 0), out(3 * n + k, 0), out(4 * n + k, 0)}};
    EXPECT_NEAR(rows[k].a, ishigami({in(k, 0), in(k, 1), in(k, 2)}), 1e-12);
    mean += rows[k].a / n;
  }
  for (const SobolRow& r : rows) variance += (r.a - mean) * (r.a - mean) / (n - 1);
  const auto ours = sobol_indices(rows, BootstrapOptions{});
  for (unsigned g = 0; g < 3; ++g) {
    const double sum = peer.getTotalOrderIndices()[g] * variance * (2.0 * n - 1.0) / (2.0 * n);
    EXPECT_NEAR(ours.groups[g].total.value * ours.variance / sum, 1.0, 1e-12) << g;
  }
}

}  // namespace
}  // namespace boresight
