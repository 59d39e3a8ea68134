// The runs that a budget is made of: each in the variant that its number stands for, its history on the
// plan's grid.
#include "boresight_analyses/budget/budget_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"

namespace boresight {
namespace budget_runs_test {

struct Budgeted {
  std::shared_ptr<const Mechanism> mechanism;
  BudgetPlan plan;

  Budgeted()
      : mechanism(std::make_shared<const Mechanism>(
            read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml", {{"motion.duration", "0.2 s"}}))) {
    Document document = Document::from_text(
        "[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { uniform = { min = \"0.05 mm\", "
        "max = \"0.15 mm\" } }\n"
        "[budget]\nmembers = 3\nattribution = 3\nsampling = \"10 ms\"\n",
        "study.toml");
    Cursor root(document);
    Study study;
    study.index.quantity = "position_error";
    plan = read_budget_plan(root, study, mechanism->description(), mechanism->duration(), [](const Setting&) {});
  }
};

TEST(BudgetModel, RunsEveryNumberInTheVariantThatItStandsFor) {
  const Budgeted budgeted;
  const BudgetRuns runs(budgeted.plan, *budgeted.mechanism);
  const BudgetModel model("quasistatic", budgeted.mechanism, budgeted.plan, runs, {"position_error", "max"}, {}, false);
  ASSERT_EQ(runs.groups(), 1u);
  ASSERT_EQ(runs.joints(), 1u);
  const std::size_t count = static_cast<std::size_t>(runs.count());
  ASSERT_EQ(count, 1u + 3u * 3u);
  std::vector<double> gap(count);
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < count; ++k) {
    runs.values(k, {&gap[k], 1});
    samples.push_back({k, {&gap[k], 1}});
  }
  std::vector<Outcome> outcomes(count);
  model.evaluate(samples, outcomes, std::atomic<bool>{false});
  const std::size_t instants = 20;  // 0.2 s at 10 ms
  for (const Outcome& outcome : outcomes) {
    ASSERT_EQ(outcome.status, Outcome::Status::done) << outcome.message;
    ASSERT_EQ(outcome.history.size(), 3 * instants);
    double largest = 0.0;
    for (std::size_t i = 0; i < instants; ++i)
      largest =
          std::max(largest, std::hypot(outcome.history[3 * i], outcome.history[3 * i + 1], outcome.history[3 * i + 2]));
    // The value is the maximum over every step, of which the history holds some.
    EXPECT_LE(largest, outcome.value * (1.0 + 1e-9));
    EXPECT_GT(largest, 0.5 * outcome.value);
  }
  const auto value = [&](std::uint64_t number) { return outcomes[static_cast<std::size_t>(number)].value; };
  for (std::uint64_t member = 0; member < 3; ++member) {
    // A journal at rest is off by its gap: with half of it half as much, but for what the contact gives way.
    const double drawn = value(runs.drawn(member)), at = gap[static_cast<std::size_t>(runs.drawn(member))];
    EXPECT_NEAR(drawn / value(runs.nominal()), at / gap[0], 0.1 * at / gap[0]);
    EXPECT_LT(value(runs.halved(member, 0)), 0.8 * drawn);
    EXPECT_GT(value(runs.halved(member, 0)), 0.3 * drawn);
    EXPECT_EQ(value(runs.held(member, 0)), value(runs.nominal()));
  }
}

TEST(HistoryOnGrid, InterpolatesBetweenTheSamplesOfARun) {
  BudgetPlan plan;
  plan.start = 0.25;
  plan.duration = 1.0;
  plan.sampling = 0.25;
  RunResult run;
  run.time = {0.0, 0.25, 0.375, 1.0, 2.0};
  for (const double t : run.time) {
    PoseSample s;
    s.ideal.p = Vec3(7.0, 8.0, 9.0);
    s.pose.p = s.ideal.p + Vec3(t, 1.0 - t, 2.0);  // straight in time, so that the samples' places do not matter
    run.boresight.samples.push_back(s);
  }
  const std::vector<double> history = history_on_grid(run, PointingQuantity::position_error, Pointing{}, plan);
  ASSERT_EQ(history.size(), 12u);
  for (std::size_t k = 0; k < 4; ++k) {
    const double t = 0.25 + 0.25 * static_cast<double>(k);
    EXPECT_NEAR(history[3 * k], t, 1e-12);
    EXPECT_NEAR(history[3 * k + 1], 1.0 - t, 1e-12);
    EXPECT_NEAR(history[3 * k + 2], 2.0, 1e-12);
  }
}

}  // namespace budget_runs_test
}  // namespace boresight
