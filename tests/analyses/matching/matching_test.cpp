// Matching on models whose optimum is known.
#include "boresight_analyses/matching/matching.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/matching/design_slopes.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"

namespace boresight {
namespace matching_test {

// index = 1 + (x - 3)^2 + scatter, free flight = 0.1 + 0.02 (x - 7)^2: accuracy is best at 3, stability at 7.
class Valley final : public SampleModel {
 public:
  explicit Valley(double shift = 0.0, double width = 0.2) : shift_(shift), width_(width) {}
  std::string rung() const override { return "valley"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 1; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>&) const override {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double x = samples[k].values[0], scatter = samples[k].values.size() > 1 ? samples[k].values[1] : 0.0;
      outcomes[k].status = Outcome::Status::done;
      outcomes[k].value = 1.0 + std::pow(x - 3.0 - shift_, 2) + width_ * (scatter - 0.5);
      outcomes[k].motion = {
          .free_flight_share = 0.1 + 0.02 * std::pow(x - 7.0, 2), .impacts_per_second = 1.0, .peak_acceleration = 1.0};
    }
  }

 private:
  double shift_, width_;
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

TEST(Matching, InterruptedAtAnyDesignLeavesAMapOfTheSameShape) {
  const Valley model;
  const MatchingPlan p = plan();
  bool whole = false;
  int in_map = 0;
  for (int last = 1; !whole; ++last) {
    DesignEvaluator evaluator(model, nullptr, nullptr, {});
    int seen = 0;
    MatchingOptions options;
    options.progress = [&](const MatchingResult&) {
      if (++seen == last) throw EvaluationInterrupted();
    };
    const MatchingResult r = run_matching(p, evaluator, nullptr, "", options);
    whole = !r.interrupted;
    for (const std::vector<double>& row : r.map.value) {
      EXPECT_EQ(row.size(), r.map.x.size()) << "interrupted at design " << last;
      in_map += std::isnan(row.back());
    }
    ASSERT_LT(last, 1000);
  }
  EXPECT_GT(in_map, 3);
}

// Slopes of Valley, and how often they were asked for.
MatchingOptions with_slopes(int& asked) {
  MatchingOptions options;
  options.no_slopes.clear();
  options.slopes = [&asked](const std::vector<double>& design, std::string&) {
    ++asked;
    return std::optional(std::vector{2.0 * (design[0] - 3.0)});
  };
  return options;
}

TEST(Matching, GoesByGradientsWhereThereAreAny) {
  const Valley model;
  DesignEvaluator plain(model, nullptr, nullptr, {});
  const MatchingResult without = run_matching(plan(), plain, nullptr, "", {});
  for (const char* local : {"auto", "mma"}) {
    MatchingPlan p = plan();
    p.local = local;
    DesignEvaluator evaluator(model, nullptr, nullptr, {});
    int asked = 0;
    const MatchingResult r = run_matching(p, evaluator, nullptr, "", with_slopes(asked));
    EXPECT_TRUE(r.converged);
    EXPECT_NEAR(r.design[0], 3.0, 1e-3);
    EXPECT_EQ(r.local, std::string(local) == "auto" ? "slsqp" : "mma");
    EXPECT_GT(asked, 0);
    for (std::size_t k = 0; k < r.descents.size(); ++k) {
      EXPECT_TRUE(r.descents[k].agrees) << r.descents[k].from;
      EXPECT_LE(r.descents[k].evaluations, without.descents[k].evaluations) << r.descents[k].from;
    }
    EXPECT_NE(r.why.find("gradients"), std::string::npos) << r.why;
  }
}

// Friction has an optimum inside: little lets the journal bounce on, much carries it along the bore. On the mechanism itself, over
// a motion short enough to have slopes.
TEST(Matching, GradientsOfTheMechanismLeadToTheOptimumThatASearchWithoutFinds) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml",
                     {{"motion.duration", "20 ms"}, {"clearance.F1.contact.restitution", "0.95"}}));
  MatchingPlan p;
  DesignVariable v;
  v.paths = {"clearance.F1.friction.coefficient"};
  v.si_unit = "1";
  v.places.emplace_back(mechanism->description(), v.paths[0]);
  v.from = 0.005;
  v.to = 0.2;
  v.starts = {0.02};
  p.variables = {v};
  p.global = "none";
  p.tolerance = 1e-3;
  p.map = p.front = 0;
  const IndexChoice index{.quantity = "position_error", .statistic = "rms"};
  const RungSampleModel model(
      "perturbation", mechanism, [&](std::span<const double> values) { return p.parameters_with(*mechanism, values); },
      index, {}, false);
  MatchingResult with, without;
  const auto solve = [&](bool gradients) {
    MatchingOptions options;
    ASSERT_EQ(why_no_slopes(p), "");
    if (gradients)
      options.slopes = [slopes = DesignSlopes(mechanism, p, index, {})](
                           const std::vector<double>& design, std::string& why) { return slopes.at(design, why); };
    DesignEvaluator evaluator(model, nullptr, nullptr, {});
    (gradients ? with : without) = run_matching(p, evaluator, nullptr, "", options);
  };
  solve(true);
  solve(false);
  EXPECT_EQ(with.local, "slsqp") << with.why;
  EXPECT_EQ(without.local, "cobyla");
  EXPECT_GT(with.design[0], 0.01);
  EXPECT_LT(with.design[0], 0.1);
  EXPECT_NEAR(with.objective, without.objective, 1e-4 * without.objective);
}

TEST(Matching, GoesByGradientsOfALogarithmicVariable) {
  const Valley model;
  MatchingPlan p = plan();
  p.variables[0].from = 0.1;
  p.variables[0].log = true;
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  int asked = 0;
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", with_slopes(asked));
  EXPECT_EQ(r.local, "slsqp");
  EXPECT_NEAR(r.design[0], 3.0, 1e-3);
}

TEST(Matching, GoesOnWithoutGradientsWhereTheyEndAndSaysWhy) {
  const Valley model;
  const MatchingPlan p = plan();
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  int asked = 0;
  MatchingOptions options = with_slopes(asked);
  const auto everywhere = options.slopes;
  options.slopes = [everywhere](const std::vector<double>& design, std::string& why) {
    why = design[0] > 9.0 ? "motions part" : "";
    return design[0] > 9.0 ? std::nullopt : everywhere(design, why);
  };
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", options);
  EXPECT_TRUE(r.converged);
  EXPECT_NEAR(r.design[0], 3.0, 2e-3);
  EXPECT_EQ(r.descents.front().algorithm, "slsqp");
  EXPECT_EQ(r.descents.back().algorithm, "cobyla");  // from 9.5
  EXPECT_NE(r.why.find("motions part"), std::string::npos) << r.why;
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

// Of a free flight of at most L the most accurate design is x = 7 - sqrt((L - 0.1) / 0.02).
TEST(Matching, FrontHoldsTheMostAccurateDesignOfEveryLevelThatItWasAskedFor) {
  const Valley model;
  MatchingPlan p = plan();
  p.front = 6;
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  for (int k = 1; k <= p.front; ++k) {
    const double level = 0.1 + 0.32 * k / (p.front + 1.0);
    const double best = 0.9 + std::pow(4.0 - std::sqrt((level - 0.1) / 0.02), 2);  // no scatter: -0.1
    double found = 1e300;
    for (const FrontPoint& f : r.front)
      if (f.free_flight_share <= level + 1e-3) found = std::min(found, f.index);
    EXPECT_NEAR(found, best, 0.05 * best) << level;
  }
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

TEST(Matching, TakesABetterPlaceThatItsMapShows) {
  // A descent from here stays in its own valley; the other one is deeper.
  class TwoValleys final : public SampleModel {
   public:
    std::string rung() const override { return "two valleys"; }
    double step() const override { return 0.0; }
    std::string leaves_out() const override { return ""; }
    std::size_t batch() const override { return 1; }
    void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                  const std::atomic<bool>&) const override {
      for (std::size_t k = 0; k < samples.size(); ++k) {
        const double x = samples[k].values[0];
        outcomes[k].status = Outcome::Status::done;
        outcomes[k].value = std::min(2.0 + std::pow(x - 1.0, 2), 1.0 + std::pow(x - 8.0, 2));
      }
    }
  } const model;
  MatchingPlan p = plan();
  p.global = "none";
  p.variables[0].starts = {0.5};
  p.map = 21;
  p.front = 0;
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  EXPECT_NEAR(r.design[0], 8.0, 1e-2);
  EXPECT_NEAR(r.objective, 1.0, 1e-3);
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

// Sixty samples show no upper end of their 95 % quantile, and the worst of them is less than that of four hundred: neither contradicts the other.
TEST(Matching, QuantilesAndWorstsOfFewerSamplesDoNotContradictThoseOfMore) {
  const Valley model(0.0, 2.0), other(1.5, 2.0);
  for (const Over over : {Over::quantile, Over::worst}) {
    MatchingPlan p = plan(over);
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
  const MatchingPlan p = plan(Over::mean);
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
  MatchingPlan p = plan(Over::mean);
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
  const MatchingPlan p = plan(Over::mean);
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

TEST(DesignSlopes, AreOfNumbersOfContactsAboveZeroInOneMotionsIndexWithoutLimits) {
  MatchingPlan p = plan();
  p.variables[0].paths = {"clearance.F1.radial", "clearance.A1.radial"};
  p.variables[0].from = 1e-5;
  EXPECT_EQ(why_no_slopes(p), "");
  const auto why_not = [&](auto change) {
    MatchingPlan other = p;
    change(other);
    return why_no_slopes(other);
  };
  using testing::HasSubstr;
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.variables[0].paths[1] = "payload.mass"; }),
              HasSubstr("payload.mass is none"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.variables[0].from = 0.0; }), HasSubstr("may be zero"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.objective.measure = Measure::free_flight_share; }),
              HasSubstr("only the index"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.objective.over = Over::mean; }), HasSubstr("one motion"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.constraints.push_back({q.objective, 1.0}); }), HasSubstr("limits"));
}

}  // namespace matching_test
}  // namespace boresight
