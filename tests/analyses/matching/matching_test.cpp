// Matching on models whose optimum is known.
#include "boresight_analyses/matching/matching.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace boresight {
namespace {

// index = 1 + (x - 3)^2 + scatter, free flight = 0.1 + 0.02 (x - 7)^2: accuracy is best at 3, stability at 7.
class Valley final : public SampleModel {
 public:
  explicit Valley(double shift = 0.0) : shift_(shift) {}
  std::string rung() const override { return "valley"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 1; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>&) const override {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double x = samples[k].values[0],
                   scatter = samples[k].values.size() > 1 ? samples[k].values[1] : 0.0;
      outcomes[k].status = Outcome::Status::done;
      outcomes[k].value = 1.0 + std::pow(x - 3.0 - shift_, 2) + 0.2 * (scatter - 0.5);
      outcomes[k].motion = {.free_flight_share = 0.1 + 0.02 * std::pow(x - 7.0, 2),
                            .impacts_per_second = 1.0,
                            .peak_acceleration = 1.0};
    }
  }

 private:
  double shift_;
};

MatchingPlan plan(Over over = Over::nominal) {
  MatchingPlan p;
  DesignVariable v;
  v.paths = {"x"};
  v.si_unit = "1";
  v.from = 0.0;
  v.to = 10.0;
  v.starts = {0.5, 5.0, 9.5};
  p.variables = {v};
  p.objective.over = over;
  p.tolerance = 1e-4;
  p.map = 5;
  p.front = 4;
  if (over != Over::nominal) {
    RandomInputs inputs;
    RandomParameter r;
    r.paths = {"u"};
    r.distribution = make_uniform(0.0, 1.0);
    inputs.parameters.push_back(r);
    p.inputs = inputs;
    p.samples = p.confirm = 40;
  }
  return p;
}

TEST(Matching, ReachesTheSameAnswerFromThreeStarts) {
  const Valley model;
  const MatchingPlan p = plan();
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  ASSERT_TRUE(r.feasible);
  EXPECT_TRUE(r.converged);
  EXPECT_NEAR(r.design[0], 3.0, 2e-3);
  ASSERT_EQ(r.descents.size(), 4U);  // from the box and from each start
  for (const MatchingDescent& d : r.descents) EXPECT_TRUE(d.agrees) << d.from;
  EXPECT_EQ(r.map.x.size(), 6U);  // the grid, and the optimum in its place
}

TEST(Matching, KeepsAConstraintAndSaysThatItIsActive) {
  const Valley model;
  MatchingPlan p = plan();
  p.constraints.push_back({{.measure = Measure::free_flight_share}, 0.18});  // 5 <= x <= 9
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  EXPECT_TRUE(r.feasible);
  EXPECT_NEAR(r.design[0], 5.0, 5e-3);
  EXPECT_TRUE(r.active[0]);
}

TEST(Matching, SaysThatNoDesignKeepsTheConstraintsAndGivesTheOneThatBreaksThemLeast) {
  const Valley model;
  MatchingPlan p = plan();
  p.constraints.push_back({{.measure = Measure::free_flight_share}, 0.08});
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  EXPECT_FALSE(r.feasible);
  EXPECT_NEAR(r.design[0], 7.0, 0.05);
  EXPECT_NEAR(r.violation, 0.25, 1e-3);
}

TEST(Matching, FrontHoldsDesignsBetweenTheTwoOptimaOnly) {
  const Valley model;
  const MatchingPlan p = plan();
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  ASSERT_GE(r.front.size(), 4U);
  for (std::size_t k = 0; k < r.front.size(); ++k) {
    EXPECT_GE(r.front[k].design[0], 3.0 - 0.1);
    EXPECT_LE(r.front[k].design[0], 7.0 + 0.1);
    if (k > 0) {
      EXPECT_GT(r.front[k].index, r.front[k - 1].index);
      EXPECT_LT(r.front[k].free_flight_share, r.front[k - 1].free_flight_share);
    }
  }
}

TEST(Matching, AConfirmationThatAgreesLeavesTheOptimumAlone) {
  const Valley model;
  const MatchingPlan p = plan(Over::mean);
  DesignEvaluator evaluator(model, &*p.inputs, nullptr, {.samples = 40, .seed = 1});
  DesignEvaluator confirm(model, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult r = run_matching(p, evaluator, &confirm, "valley", {});
  ASSERT_EQ(r.confirmation.size(), 1U);
  EXPECT_TRUE(r.confirmation[0].agrees);
  EXPECT_FALSE(r.confirmation[0].went_on);
  EXPECT_LT(r.interval.low, r.objective);
  EXPECT_GT(r.interval.high, r.objective);
}

TEST(Matching, GoesOnOnTheRungThatDisagrees) {
  const Valley cheap, exact(1.5);
  const MatchingPlan p = plan(Over::mean);
  DesignEvaluator evaluator(cheap, &*p.inputs, nullptr, {.samples = 40, .seed = 1});
  DesignEvaluator confirm(exact, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult r = run_matching(p, evaluator, &confirm, "exact", {});
  ASSERT_EQ(r.confirmation.size(), 1U);
  EXPECT_FALSE(r.confirmation[0].agrees);
  EXPECT_TRUE(r.confirmation[0].went_on);
  EXPECT_NEAR(r.design[0], 4.5, 0.01);
}

}  // namespace
}  // namespace boresight
