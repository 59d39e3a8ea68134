// Probabilities of rare excesses against OpenTURNS: its FORM (Hasofer and Lind 1974) and its subset
// simulation.
#include <gmock/gmock.h>

#include <cmath>
#include <openturns/Cobyla.hxx>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/CompositeRandomVector.hxx>
#include <openturns/FORM.hxx>
#include <openturns/Greater.hxx>
#include <openturns/LogNormal.hxx>
#include <openturns/Normal.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/RandomVector.hxx>
#include <openturns/SubsetSampling.hxx>
#include <openturns/SymbolicFunction.hxx>
#include <openturns/ThresholdEvent.hxx>
#include <openturns/WeibullMin.hxx>

#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/statistics/running.hpp"
#include "boresight_analyses/tails/tail_estimate.hpp"
#include "boresight_analyses/tails/tail_proposal.hpp"
#include "tails/problems.hpp"

namespace boresight {
namespace {

using problems::phi;
using problems::pointwise;

constexpr int kRuns = 30;

// The excess of a formula in x1, x2 over a limit, x1 and x2 independent.
class Peer {
 public:
  Peer(const char* formula, double limit, const OT::Distribution& x1, const OT::Distribution& x2) {
    OT::Description in(2), out(1, formula);
    in[0] = "x1";
    in[1] = "x2";
    OT::ComposedDistribution::DistributionCollection laws(2);
    laws[0] = x1;
    laws[1] = x2;
    joint_ = OT::ComposedDistribution(laws);
    event_ = OT::ThresholdEvent(OT::CompositeRandomVector(OT::SymbolicFunction(in, out), OT::RandomVector(joint_)),
                                OT::Greater(), limit);
  }
  double form() const {
    OT::Cobyla solver;
    solver.setMaximumEvaluationNumber(10000);
    solver.setMaximumAbsoluteError(1e-10);
    solver.setMaximumRelativeError(1e-10);
    solver.setMaximumResidualError(1e-10);
    solver.setMaximumConstraintError(1e-10);
    OT::FORM f(solver, event_, joint_.getMean());
    f.run();
    return f.getResult().getEventProbability();
  }
  RunningMoments subset(unsigned seed) const {
    OT::RandomGenerator::SetSeed(seed);
    RunningMoments p;
    for (int k = 0; k < kRuns; ++k) {
      OT::SubsetSampling s(event_);
      s.setMaximumOuterSampling(1000);
      s.setBlockSize(1);
      s.run();
      p.add(s.getResult().getProbabilityEstimate());
    }
    return p;
  }

 private:
  OT::ComposedDistribution joint_;
  OT::ThresholdEvent event_;
};

RunningMoments our_subset(const BatchModel& model, double limit) {
  RunningMoments p;
  for (int k = 0; k < kRuns; ++k) {
    SubsetOptions o;
    o.seed = 100 + static_cast<std::uint64_t>(k);
    p.add(subset_simulation(model, 2, limit, o).probability);
  }
  return p;
}
IndependentInterval our_estimate(const BatchModel& model, double limit) {
  return importance_sampling(model, limit, tail_proposal(model, 2, limit, {}).mixture, 20000, {0.998, 1, 0})
      .probability;
}

// Means of runs of 1000 points a level: three standard errors of the difference, and 2 % each for a bias of
// the order of 1 / points.
void expect_the_same(const RunningMoments& ours, const RunningMoments& theirs) {
  const double error = std::sqrt((ours.sd() * ours.sd() + theirs.sd() * theirs.sd()) / kRuns);
  EXPECT_NEAR(ours.mean(), theirs.mean(), 3.0 * error + 0.04 * theirs.mean());
  EXPECT_NEAR(ours.sd() / theirs.sd(), 1.0, 0.6);  // and they scatter alike
}
void expect_held(const IndependentInterval& i, double truth) {
  EXPECT_TRUE(i.low <= truth && truth <= i.high) << i.low << " to " << i.high << ", not " << truth;
  EXPECT_LT(i.high - i.low, 0.2 * truth);
}
void print(const char* what, double form, const RunningMoments& theirs, const RunningMoments& ours,
           const IndependentInterval& i) {
  std::printf(
      "  %s: FORM %.4g, subsets %.4g +- %.1g theirs, %.4g +- %.1g ours, importance sampling %.4g [%.4g, "
      "%.4g]\n",
      what, form, theirs.mean(), theirs.sd() / std::sqrt(kRuns), ours.mean(), ours.sd() / std::sqrt(kRuns), i.value,
      i.low, i.high);
}

TEST(TailsAgreeWithOpenTurns, OnALinearLimitState) {
  const Peer peer("(x1 + x2) / sqrt(2)", 3.5, OT::Normal(0.0, 1.0), OT::Normal(0.0, 1.0));
  const BatchModel model = pointwise(problems::linear);
  const RunningMoments theirs = peer.subset(1), ours = our_subset(model, 3.5);
  const IndependentInterval i = our_estimate(model, 3.5);
  print("linear", peer.form(), theirs, ours, i);
  EXPECT_NEAR(peer.form() / phi(-3.5), 1.0, 1e-6);
  expect_held(i, peer.form());
  expect_the_same(ours, theirs);
}

// v > limit + 0.2 w^2 with v, w standard normal: E[phi(-limit - 0.2 w^2)], which FORM overstates.
double bent_truth(double limit) {
  double p = 0.0;
  const double h = 1e-3;  // the trapezoidal rule is exact to rounding for an entire function that decays
  for (double w = -10.0; w < 10.0; w += h)
    p += h * phi(-limit - 0.2 * w * w) * std::exp(-0.5 * w * w) / std::sqrt(2.0 * M_PI);
  return p;
}
TEST(TailsAgreeWithOpenTurns, OnABentLimitStateWhereFormIsOff) {
  const Peer peer("(x1 + x2) / sqrt(2) - 0.1 * (x1 - x2)^2", 3.0, OT::Normal(0.0, 1.0), OT::Normal(0.0, 1.0));
  const BatchModel model =
      pointwise([](const Point& u) { return problems::linear(u) - 0.1 * (u[0] - u[1]) * (u[0] - u[1]); });
  const RunningMoments theirs = peer.subset(2), ours = our_subset(model, 3.0);
  const IndependentInterval i = our_estimate(model, 3.0);
  print("bent", peer.form(), theirs, ours, i);
  EXPECT_NEAR(peer.form() / phi(-3.0), 1.0, 1e-6);
  expect_held(i, bent_truth(3.0));
  EXPECT_GT(peer.form(), i.high);
  expect_the_same(ours, theirs);
}

// Weibull load over lognormal strength: the way into standard normal space is each one's own.
TEST(TailsAgreeWithOpenTurns, OnLoadOverStrength) {
  const OT::WeibullMin load(1.0, 2.0, 0.0);
  const OT::LogNormal strength(std::log(5.0), std::log(1.2));
  const Peer peer("x1 - x2", 0.0, load, strength);
  const DistributionPtr s = make_weibull(2.0, 1.0, 0.0), r = make_lognormal(5.0, 1.2);
  const auto x = [](const Distribution& d, double u) {
    return u < 0.0 ? d.quantile(phi(u)) : d.upper_quantile(phi(-u));
  };
  const BatchModel model = pointwise([&](const Point& u) { return x(*s, u[0]) - x(*r, u[1]); });
  const RunningMoments theirs = peer.subset(3), ours = our_subset(model, 0.0);
  const IndependentInterval i = our_estimate(model, 0.0);
  print("load over strength", peer.form(), theirs, ours, i);
  // P(S > R) = E[survival of S at R], by their functions alone.
  double truth = 0.0;
  for (double y = 0.5; y < 20.0; y += 1e-3) truth += 1e-3 * strength.computePDF(y) * load.computeComplementaryCDF(y);
  expect_held(i, truth);
  EXPECT_NEAR(peer.form() / truth, 1.0, 0.3);
  expect_the_same(ours, theirs);
}

}  // namespace
}  // namespace boresight
