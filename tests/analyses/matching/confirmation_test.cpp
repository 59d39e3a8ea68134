// What confirms an optimum: other random numbers, on the next rung up.
#include <gmock/gmock.h>

#include "boresight_analyses/matching/matching.hpp"
#include "valley.hpp"

namespace boresight {
namespace matching_confirmation_test {

TEST(Matching, AConfirmationThatAgreesLeavesTheOptimumAlone) {
  const Valley model;
  const MatchingPlan p = valley_plan(Over::mean);
  DesignEvaluator evaluator(model, &*p.inputs, nullptr, {.samples = 40, .seed = 1});
  DesignEvaluator confirm(model, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult r = run_matching(p, evaluator, &confirm, "valley", {});
  ASSERT_EQ(r.confirmation.size(), 1U);
  EXPECT_TRUE(r.confirmation[0].agrees);
  EXPECT_FALSE(r.confirmation[0].went_on);
  EXPECT_LT(r.interval.low, r.objective);
  EXPECT_GT(r.interval.high, r.objective);
}

// Sixty samples show no upper end of their 95 % quantile, and the worst of them is less than that of four hundred: neither contradicts the other.
TEST(Matching, QuantilesAndWorstsOfFewerSamplesDoNotContradictThoseOfMore) {
  const Valley model(0.0, 2.0), other(1.5, 2.0);
  for (const Over over : {Over::quantile, Over::worst}) {
    MatchingPlan p = valley_plan(over);
    p.map = p.front = 0;
    p.variables[0].starts = {5.0};
    int disagree = 0;
    for (std::uint64_t seed = 2; seed < 12; ++seed) {
      DesignEvaluator evaluator(model, &*p.inputs, nullptr, {.samples = 400, .seed = 1});
      DesignEvaluator confirm(model, &*p.inputs, nullptr, {.samples = 60, .seed = seed});
      const MatchingResult r = run_matching(p, evaluator, &confirm, "valley", {});
      disagree += !r.confirmation[0].agrees;
      if (r.confirmation[0].agrees) {
        EXPECT_NEAR(r.objective, 1.9, 0.11);
      }
    }
    EXPECT_LE(disagree, 1) << over_names()[static_cast<std::size_t>(over)].name;
    // A rung that says something else still disagrees.
    DesignEvaluator evaluator(model, &*p.inputs, nullptr, {.samples = 400, .seed = 1});
    DesignEvaluator confirm(other, &*p.inputs, nullptr, {.samples = 60, .seed = 2});
    EXPECT_FALSE(run_matching(p, evaluator, &confirm, "other", {}).confirmation[0].agrees);
  }
}

// Fails where the scatter is in its upper tenth.
class ValleyThatFails final : public SampleModel {
 public:
  std::string rung() const override { return "valley"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 1; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override {
    Valley().evaluate(samples, outcomes, stop);
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (samples[k].values[1] > 0.9) outcomes[k] = {.status = Outcome::Status::failed, .message = "too much"};
  }
};

TEST(Matching, AConfirmationWhoseRunsFailConfirmsNothingAndSaysSo) {
  const Valley model;
  const ValleyThatFails fails;
  const MatchingPlan p = valley_plan(Over::mean);
  DesignEvaluator evaluator(model, &*p.inputs, nullptr, {.samples = 40, .seed = 1});
  DesignEvaluator confirm(fails, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult r = run_matching(p, evaluator, &confirm, "exact", {});
  ASSERT_EQ(r.confirmation.size(), 1U);
  EXPECT_TRUE(r.feasible && r.converged);
  EXPECT_FALSE(r.confirmed());
  EXPECT_GT(r.confirmation[0].failed, 0U);
  EXPECT_THAT(r.confirmation[0].sentence,
              testing::HasSubstr(std::to_string(r.confirmation[0].failed) + " of its 40 runs failed"));
  EXPECT_THAT(r.confirmation[0].sentence, testing::HasSubstr("the optimum is not confirmed"));
}

// The mean is sought, the worst of the samples has a limit.
MatchingPlan plan_with_the_worst_limited(double at_most) {
  MatchingPlan p = valley_plan(Over::mean);
  p.map = p.front = 0;
  MatchingConstraint limit{.measure = p.objective, .at_most = at_most};
  limit.measure.over = Over::worst;
  p.constraints = {limit};
  return p;
}

TEST(Matching, AConfirmationThatBreaksALimitNamesIt) {
  const Valley model(0.0, 0.0), wide(0.0, 4.0);
  const MatchingPlan p = plan_with_the_worst_limited(1.5);
  DesignEvaluator evaluator(model, &*p.inputs, nullptr, {.samples = 40, .seed = 1});
  DesignEvaluator confirm(wide, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult r = run_matching(p, evaluator, &confirm, "exact", {});
  ASSERT_EQ(r.confirmation.size(), 1U);
  EXPECT_FALSE(r.confirmation[0].agrees);
  EXPECT_THAT(r.confirmation[0].sentence, testing::HasSubstr("index is "));
  EXPECT_THAT(r.confirmation[0].sentence, testing::HasSubstr("beyond its limit there"));
  EXPECT_FALSE(r.feasible);  // none keeps it there
}

// The worst of samples about a mean that both agree on: each rung has a value of its own.
TEST(Matching, AConfirmationHasTheConstraintsValuesOfItsOwnRung) {
  const Valley model(0.0, 0.0), wide(0.0, 0.01);
  const MatchingPlan p = plan_with_the_worst_limited(20.0);
  DesignEvaluator evaluator(model, &*p.inputs, nullptr, {.samples = 40, .seed = 1});
  DesignEvaluator confirm(wide, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult agreed = run_matching(p, evaluator, &confirm, "exact", {});
  ASSERT_TRUE(agreed.confirmation.at(0).agrees);
  EXPECT_FALSE(agreed.on_confirming_rung);
  EXPECT_NEAR(agreed.constraint_values.at(0), 1.0, 1e-6);
  EXPECT_GT(agreed.confirmation[0].constraint_values.at(0), 1.004);
  EXPECT_LT(agreed.confirmation[0].constraint_values[0], 1.006);

  // Where a descent went on there, the optimum is of that rung, and so are its constraints.
  const Valley elsewhere(1.5);
  DesignEvaluator other(elsewhere, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult moved = run_matching(p, evaluator, &other, "exact", {});
  ASSERT_TRUE(moved.confirmation.at(0).went_on);
  EXPECT_TRUE(moved.on_confirming_rung);
  EXPECT_EQ(moved.constraint_values, moved.confirmation[0].constraint_values);
}

TEST(Matching, GoesOnOnTheRungThatDisagrees) {
  const Valley cheap, exact(1.5);
  const MatchingPlan p = valley_plan(Over::mean);
  DesignEvaluator evaluator(cheap, &*p.inputs, nullptr, {.samples = 40, .seed = 1});
  DesignEvaluator confirm(exact, &*p.inputs, nullptr, {.samples = 40, .seed = 2});
  const MatchingResult r = run_matching(p, evaluator, &confirm, "exact", {});
  ASSERT_EQ(r.confirmation.size(), 1U);
  EXPECT_FALSE(r.confirmation[0].agrees);
  EXPECT_TRUE(r.confirmation[0].went_on);
  EXPECT_NEAR(r.design[0], 4.5, 0.01);
  // What is as good is so by the rung that the answer is of, and the descent that found it is no worse place than it.
  EXPECT_LE(r.as_good_from[0], r.design[0]);
  EXPECT_GE(r.as_good_to[0], r.design[0]);
  EXPECT_GT(r.as_good_from[0], 3.5);
  EXPECT_TRUE(r.descents.back().agrees);
}

}  // namespace matching_confirmation_test
}  // namespace boresight
