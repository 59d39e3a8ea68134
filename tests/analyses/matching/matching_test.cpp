// Matching on models whose optimum is known.
#include "boresight_analyses/matching/matching.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/matching/design_slopes.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"
#include "valley.hpp"

namespace boresight {
namespace matching_test {

TEST(Matching, ReachesTheSameAnswerFromThreeStarts) {
  const Valley model;
  const MatchingPlan p = valley_plan();
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
  const MatchingPlan p = valley_plan();
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
  const MatchingResult without = run_matching(valley_plan(), plain, nullptr, "", {});
  for (const char* local : {"auto", "mma"}) {
    MatchingPlan p = valley_plan();
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
  MatchingPlan p = valley_plan();
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
  const MatchingPlan p = valley_plan();
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
  MatchingPlan p = valley_plan();
  p.constraints.push_back({{.measure = Measure::free_flight_share}, 0.18});  // 5 <= x <= 9
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  EXPECT_TRUE(r.feasible);
  EXPECT_NEAR(r.design[0], 5.0, 5e-3);
  EXPECT_TRUE(r.active[0]);
}

TEST(Matching, SaysThatNoDesignKeepsTheConstraintsAndGivesTheOneThatBreaksThemLeast) {
  const Valley model;
  MatchingPlan p = valley_plan();
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
  MatchingPlan p = valley_plan();
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
  const MatchingPlan p = valley_plan();
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
  MatchingPlan p = valley_plan();
  p.global = "none";
  p.variables[0].starts = {0.5};
  p.map = 21;
  p.front = 0;
  DesignEvaluator evaluator(model, nullptr, nullptr, {});
  const MatchingResult r = run_matching(p, evaluator, nullptr, "", {});
  EXPECT_NEAR(r.design[0], 8.0, 1e-2);
  EXPECT_NEAR(r.objective, 1.0, 1e-3);
}

}  // namespace matching_test
}  // namespace boresight
