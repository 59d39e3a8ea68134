// Screening and Shapley effects as studies: plan, store and answer.
#include <gmock/gmock.h>

#include <cmath>

#include "closed_form_study.hpp"

namespace boresight {
namespace sensitivity_methods_test {

const std::string kMorris = "[sensitivity]\nmethod = \"morris\"\n", kShapley = "[sensitivity]\nmethod = \"shapley\"\n";
const std::string kCorrelated =
    "[[correlation]]\nparameters = [\"clearance.F1.radial\", \"clearance.F1.contact.restitution\"]\ncoefficient = "
    "0.5\n";

// On four levels a score moves by the quantiles of 1/8 and 5/8 or of 3/8 and 7/8, 1.469 sd either way.
TEST_F(SensitivityTest, ScreeningMeetsTheMovesOfAnAdditiveModelInBothDesigns) {
  const double move = 1.1503493803760079 + 0.3186393639643752;  // Phi^-1(7/8), Phi^-1(5/8)
  for (const char* design : {"samples = 64\n", "samples = 64\ndesign = \"random\"\n"}) {
    const SensitivityPlan p = plan(kMorris + design);
    EXPECT_EQ(p.runs(), 64u * 4u);
    const auto s = store(p, p.design.kind == SamplingKind::random ? "r.db" : "s.db");
    ASSERT_TRUE(compute_sensitivity_runs(ClosedForm{}, p, *s, {.jobs = 2, .progress = {}, .interrupted = {}}));
    const auto found = screening(p, *s);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->groups[0].mu->value, 2.0 * 3.0 * move, 1e-6) << design;
    EXPECT_NEAR(found->groups[1].mu_star.value, 2.0 * 2.0 * move, 1e-6) << design;
    // |z| goes from 1.150 to 0.319 or back: always by as much, to either side.
    EXPECT_NEAR(found->groups[2].mu_star.value, 2.0 * 5.0 * (1.1503493803760079 - 0.3186393639643752), 1e-6);
    EXPECT_GT(found->groups[2].sigma->value, 7.0);
    EXPECT_NEAR(found->groups[0].sigma->value, 0.0, 1e-4);
    EXPECT_EQ(found->negligible(), 0u);
    EXPECT_EQ(found->rows, 64);
  }
}

TEST_F(SensitivityTest, ScreeningSaysWhatIsNegligibleByTheShareAskedFor) {
  const SensitivityPlan p = plan(kMorris + "samples = 32\nnegligible = 0.7\n");
  const auto s = store(p);
  ASSERT_TRUE(compute_sensitivity_runs(ClosedForm{}, p, *s, {.jobs = 1, .progress = {}, .interrupted = {}}));
  const auto found = screening(p, *s);
  EXPECT_FALSE(found->groups[0].negligible);
  EXPECT_TRUE(found->groups[1].negligible);  // two thirds of the first
  EXPECT_FALSE(found->groups[2].negligible);
}

TEST_F(SensitivityTest, ScreeningIsTheSameInOnePieceOrResumed) {
  const SensitivityPlan p = plan(kMorris + "samples = 32\n");
  const ClosedForm whole, parts;
  const auto one = store(p, "one.db"), two = store(p, "two.db");
  compute_sensitivity_runs(whole, p, *one, {.jobs = 1, .progress = {}, .interrupted = {}});
  EXPECT_FALSE(compute_sensitivity_runs(
      parts, p, *two, {.jobs = 2, .progress = {}, .interrupted = [&] { return parts.evaluations > 50; }}));
  EXPECT_TRUE(compute_sensitivity_runs(parts, p, *two, {.jobs = 2, .progress = {}, .interrupted = {}}));
  EXPECT_EQ(parts.evaluations, static_cast<int>(p.runs()));  // none twice
  EXPECT_EQ(screening(p, *one)->groups[2].mu_star.low, screening(p, *two)->groups[2].mu_star.low);
}

// y = 3 a + 2 b + 5 |c|, a and b correlated by 1/2: V = 9 + 4 + 6 + 25 (1 - 2/pi). What a and b explain is divided as Iooss and
// Prieur 2019 have it for two normal inputs: a^2 + r a b + r^2 (b^2 - a^2) / 2.
TEST_F(SensitivityTest, ShapleyEffectsMeetTheClosedFormOfACorrelatedModelInBothDesigns) {
  const double of_c = 25.0 * (1.0 - 2.0 / M_PI), v = 19.0 + of_c, apart = 0.5 * 0.25 * (4.0 - 9.0);
  const double truth[] = {(9.0 + 3.0 + apart) / v, (4.0 + 3.0 - apart) / v, of_c / v};
  for (const char* more :
       {"samples = 4096\n", "samples = 8000\ndesign = \"random\"\n", "samples = 8192\norders = \"random\"\n"}) {
    const SensitivityPlan p = plan(kShapley + more, kCorrelated);
    EXPECT_EQ(p.runs_per_row(), p.shapley->orders() == ShapleyOrders::all ? 8u : 4u);
    const auto s = store(p, std::to_string(p.rows) + ".db");
    ASSERT_TRUE(compute_sensitivity_runs(ClosedForm{}, p, *s, {.jobs = 2, .progress = {}, .interrupted = {}}));
    const auto found = shapley_division(p, *s);
    ASSERT_TRUE(found);
    double sum = 0.0;
    for (std::size_t g = 0; g < 3; ++g) {
      EXPECT_NEAR(found->groups[g].effect.value, truth[g], 0.04) << more << g;
      EXPECT_FALSE(found->groups[g].undersampled);
      sum += found->groups[g].effect.value;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(found->sd, std::sqrt(v), 0.05 * std::sqrt(v));
    EXPECT_LT(found->rows_that_settle(), double(found->rows));
  }
}

TEST_F(SensitivityTest, RowsWithAFailedRunAreLeftOutByEveryMethod) {
  for (const std::string& method : {kMorris, kShapley}) {
    const SensitivityPlan p = plan(method + "samples = 64\ndesign = \"random\"\n");
    ClosedForm model;
    model.fails = [&](std::uint64_t number) { return number / p.runs_per_row() == 7; };
    const auto s = store(p, method == kMorris ? "m.db" : "s.db");
    ASSERT_TRUE(compute_sensitivity_runs(model, p, *s, {.jobs = 1, .progress = {}, .interrupted = {}}));
    const RowCounts counts = method == kMorris ? RowCounts(*screening(p, *s)) : RowCounts(*shapley_division(p, *s));
    EXPECT_EQ(counts.rows, 63);
    EXPECT_EQ(counts.failed_rows, 1);
    EXPECT_EQ(counts.failed_runs, p.runs_per_row());
  }
}

TEST_F(SensitivityTest, KeysOfAnotherMethodAndWhatAMethodCannotDoAreRefused) {
  expect_refused("[sensitivity]\nsamples = 64\nmethod = \"moris\"\n", "did you mean morris?");
  expect_refused("[sensitivity]\nsamples = 64\nlevels = 4\n", "with method = \"morris\" only");
  expect_refused(kShapley + "samples = 64\nnegligible = 0.1\n", "with method = \"morris\" only");
  expect_refused(kMorris + "samples = 64\norders = \"all\"\n", "with method = \"shapley\" only");
  for (const char* levels : {"2", "3", "5", "6", "10", "62", "68"})
    expect_refused(kMorris + "samples = 64\nlevels = " + levels + "\n",
                   "a multiple of 4 from 4 to 64: with other numbers some moves are mirror images about the median");
  expect_refused(kMorris + "samples = 64\nnegligible = 1.5\n", "less than 1");
  expect_refused("[sensitivity]\nsamples = 64\n", "or method = \"shapley\"", kCorrelated);
  expect_refused(kMorris + "samples = 64\n", "correlated parameters in one group", kCorrelated);
  expect_refused(
      kShapley + "samples = 64\n", "is discrete and correlated",
      "[[random]]\nparameter = \"payload.mass\"\ndistribution = { discrete = { values = [\"0 kg\", \"1 kg\"] } }\n"
      "[[correlation]]\nparameters = [\"clearance.F1.radial\", \"payload.mass\"]\ncoefficient = 0.5\n");
}

// What a store holds belongs to the runs that the method makes.
TEST_F(SensitivityTest, PlansOfOtherMethodsAreOtherRuns) {
  const Study study;
  const std::string sobol = plan("[sensitivity]\nsamples = 64\n").text(study),
                    morris = plan(kMorris + "samples = 64\n").text(study),
                    levels = plan(kMorris + "samples = 64\nlevels = 8\n").text(study),
                    shapley = plan(kShapley + "samples = 64\n").text(study),
                    orders = plan(kShapley + "samples = 64\norders = \"random\"\n").text(study);
  EXPECT_NE(sobol, morris);
  EXPECT_NE(morris, levels);
  EXPECT_NE(sobol, shapley);
  EXPECT_NE(shapley, orders);
  EXPECT_EQ(sobol.find("method"), std::string::npos);  // as it was before there were others
}

}  // namespace sensitivity_methods_test
}  // namespace boresight
