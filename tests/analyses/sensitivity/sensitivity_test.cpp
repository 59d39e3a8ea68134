#include "boresight_analyses/sensitivity/sensitivity.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight_analyses/sensitivity/local_sensitivity.hpp"
#include "closed_form_study.hpp"

namespace boresight {
namespace sensitivity_test {

// V(|z|) = 1 - 2/pi: the variance is 9 + 4 + 25 (1 - 2/pi).
TEST_F(SensitivityTest, MeetsTheIndicesOfAnAdditiveModelInBothDesigns) {
  const double v[] = {9.0, 4.0, 25.0 * (1.0 - 2.0 / M_PI)}, total = v[0] + v[1] + v[2];
  for (const char* table :
       {"[sensitivity]\nsamples = 4096\n", "[sensitivity]\nsamples = 6000\ndesign = \"random\"\n"}) {
    const SensitivityPlan p = plan(table);
    const auto s = store(p, p.design.kind == SamplingKind::random ? "r.db" : "s.db");
    ASSERT_TRUE(compute_sensitivity_runs(ClosedForm{}, p, *s, {.jobs = 2, .progress = {}, .interrupted = {}}));
    const auto result = global_sensitivity(p, *s);
    ASSERT_TRUE(result);
    for (std::size_t g = 0; g < 3; ++g) {
      EXPECT_NEAR(result->groups[g].first.value, v[g] / total, 0.05) << table << g;
      EXPECT_NEAR(result->groups[g].total.value, v[g] / total, 0.05) << table << g;
    }
    EXPECT_NEAR(result->sd, std::sqrt(total), 0.05 * std::sqrt(total));
  }
}

TEST_F(SensitivityTest, IsTheSameInOnePieceOrResumed) {
  const SensitivityPlan p = plan("[sensitivity]\nsamples = 64\n");
  const ClosedForm whole, parts;
  const auto one = store(p, "one.db"), two = store(p, "two.db");
  compute_sensitivity_runs(whole, p, *one, {.jobs = 1, .progress = {}, .interrupted = {}});
  EXPECT_FALSE(compute_sensitivity_runs(
      parts, p, *two, {.jobs = 2, .progress = {}, .interrupted = [&] { return parts.evaluations > 100; }}));
  EXPECT_TRUE(compute_sensitivity_runs(parts, p, *two, {.jobs = 2, .progress = {}, .interrupted = {}}));
  EXPECT_EQ(parts.evaluations, static_cast<int>(p.runs()));  // none twice
  const auto a = global_sensitivity(p, *one), b = global_sensitivity(p, *two);
  for (std::size_t g = 0; g < 3; ++g) {
    EXPECT_EQ(a->groups[g].first.value, b->groups[g].first.value);
    EXPECT_EQ(a->groups[g].total.low, b->groups[g].total.low);
  }
}

TEST_F(SensitivityTest, CountsFailedRunsAndLeavesOutTheirRows) {
  const SensitivityPlan p = plan("[sensitivity]\nsamples = 64\ngroups = { gap = [\"clearance.F1.radial\"] }\n");
  ClosedForm model;
  model.fails = [](std::uint64_t number) { return number == 7 || number == 8 || number == 100; };
  const auto s = store(p);
  compute_sensitivity_runs(model, p, *s, {.jobs = 1, .progress = {}, .interrupted = {}});
  const auto result = global_sensitivity(p, *s);
  EXPECT_EQ(result->groups[0].name, "gap");
  EXPECT_EQ(result->failed_runs, 3u);
  EXPECT_EQ(result->failed_rows, 2);
}

// y = 5 |c| + 0.3 sin(40 c): no slope at c = 0, and yet nothing rough, as with an error of either sign about zero.
class Turning final : public SampleModel {
 public:
  std::string rung() const override { return "closed form"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 1; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>&) const override {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double c = (samples[k].values[2] - 0.03) / 0.001;
      outcomes[k].status = Outcome::Status::done;
      outcomes[k].value = 5.0 * std::abs(c) + 0.3 * std::sin(40.0 * c);
    }
  }
};
TEST_F(SensitivityTest, SaysWhereTheIndexTurns) {
  const SensitivityPlan p = plan("[sensitivity]\nsamples = 64\n");
  const LocalSensitivity c = local_sensitivity(Turning{}, p.inputs, 1, [] { return false; }).parameters[2];
  EXPECT_FALSE(c.meaningful);
  EXPECT_TRUE(c.turns);
  EXPECT_THAT(c.why_not, testing::HasSubstr("turns here"));
}

// Slopes of the smooth parameters are exact; |z| has none at its middle.
TEST_F(SensitivityTest, GivesSlopesWhereThereAreSome) {
  const SensitivityPlan p = plan("[sensitivity]\nsamples = 64\n");
  const LocalResult local = local_sensitivity(ClosedForm{}, p.inputs, 1, [] { return false; });
  EXPECT_TRUE(local.parameters[0].meaningful);
  EXPECT_NEAR(local.parameters[0].derivative.back(), 3e5, 1.0);
  EXPECT_NEAR(local.parameters[1].derivative.back(), 200.0, 1e-6);
  EXPECT_NEAR(local.parameters[0].at_high - local.at_medians, 3.0 * 1.6449, 1e-2);
  ClosedForm rough;
  rough.fails = [](std::uint64_t number) { return number == 3; };
  EXPECT_FALSE(local_sensitivity(rough, p.inputs, 1, [] { return false; }).parameters[0].meaningful);
}

// The median of a distribution with a long tail may be nearer to its end than half a standard deviation: Weibull's of shape k has its median
// at scale (ln 2)^(1/k), and for k = 1/2 the variance 20 scale^2.
TEST_F(SensitivityTest, StepsStayInsideTheSupportAndHalve) {
  const SensitivityPlan p = plan("[sensitivity]\nsamples = 64\n", R"(
[[random]]
parameter = "payload.mass"
distribution = { weibull = { shape = 0.5, scale = "2 kg" } }
)");
  const LocalSensitivity mass = local_sensitivity(ClosedForm{}, p.inputs, 1, [] { return false; }).parameters[3];
  const double median = 2.0 * std::pow(M_LN2, 2);
  EXPECT_NEAR(mass.median, median, 1e-12);
  EXPECT_NEAR(mass.sd, 2.0 * std::sqrt(20.0), 1e-9);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(mass.step[k], median * std::pow(0.5, k), 1e-12) << k;
  const LocalSensitivity gap = local_sensitivity(ClosedForm{}, p.inputs, 1, [] { return false; }).parameters[0];
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(gap.step[k], gap.sd * std::pow(0.5, k + 1), 1e-18) << k;
}

TEST_F(SensitivityTest, RefusesWhatContradictsItself) {
  expect_refused("[sensitivity]\nsamples = 100\n", "128");
  expect_refused("[sensitivity]\nsamples = 8\n", "16 to");
  expect_refused("[sensitivity]\nsamples = 64\nconfidence = 1.5\n", "less than 1");
  expect_refused("[sensitivity]\nsamples = 64\ndesign = \"lhs\"\n", "sobol");
  expect_refused("[sensitivity]\nsamples = 64\ndesign = \"random\"\nreplicates = 4\n", "replicates");
  expect_refused("[sensitivity]\nsamples = 64\nsampels = 3\n", "samples");
  expect_refused("[sensitivity]\nsamples = 64\ngroups = { a = [\"clearance.F1.radiall\"] }\n", "clearance.F1.radial");
  expect_refused(
      "[sensitivity]\nsamples = 64\ngroups = { a = [\"clearance.F1.radial\"], b = [\"clearance.F1.radial\"] }\n",
      "second time");
  expect_refused("[sensitivity]\nsamples = 64\n", "one group",
                 "[[correlation]]\nparameters = [\"clearance.F1.radial\", "
                 "\"clearance.F1.friction.coefficient\"]\ncoefficient = 0.5\n");
}

}  // namespace sensitivity_test
}  // namespace boresight
