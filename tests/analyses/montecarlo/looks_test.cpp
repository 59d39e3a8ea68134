// Looking again: how often a requirement is called met that is not, where whoever asks adds samples until it is.
#include "boresight_analyses/montecarlo/looks.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight_analyses/montecarlo/estimates.hpp"
#include "boresight_analyses/statistics/binomial.hpp"
#include "closed_form.hpp"
#include "repetition.hpp"

namespace boresight {
namespace looks_test {

constexpr double kProbability = 0.95, kConfidence = 0.95, kRisk = 1.0 - kConfidence;

double allowed(int repetitions) { return kRisk + 2.0 * std::sqrt(kRisk * (1.0 - kRisk) / repetitions); }

MonteCarloPlan plan_of(std::uint64_t samples) {
  MonteCarloPlan plan = sum_plan(samples);
  plan.requirement = Requirement{kProbability, kProbability, kConfidence};  // of values uniform in (0, 1)
  return plan;
}

// Values are uniform and the limit is where exactly the required share lies below.
std::vector<double> uniform_values(std::mt19937_64& engine, std::size_t count) {
  std::vector<double> values(count);
  for (double& v : values) v = repetition::uniform(engine);
  return values;
}

// 100 samples, then half as many again, and again, until it says "met" or 5000 are in.
TEST(Looks, AddingSamplesUntilItSaysMetKeepsTheRisk) {
  constexpr int kStudies = 600;
  int met = 0, met_by_fixed_numbers = 0;
  std::mt19937_64 engine(21);
  for (int study = 0; study < kStudies; ++study) {
    const std::vector<double> all = uniform_values(engine, 5000);
    std::optional<FirstLook> first;
    bool here = false, fixed = false;
    for (std::size_t n = 100; n <= all.size(); n += n / 2) {
      const MonteCarloPlan plan = plan_of(n);
      const std::vector<double> values(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
      const auto hits = std::count_if(values.begin(), values.end(), [](double v) { return v <= kProbability; });
      fixed = fixed || clopper_pearson_lower(hits, static_cast<std::int64_t>(n), kConfidence) >= kProbability;
      const Judgement judgement = judgement_of(plan, n, first);
      if (!first) first = first_look_of(plan, n);
      MonteCarloPlan plain = plan;
      here = here || estimate(values, plain, {}, judgement).requirement->met;
    }
    met += here;
    met_by_fixed_numbers += fixed;
  }
  std::printf("false met: %.3f (each look by itself: %.3f), nominal %.3f\n", double(met) / kStudies,
              double(met_by_fixed_numbers) / kStudies, kRisk);
  EXPECT_LE(double(met) / kStudies, allowed(kStudies));
  EXPECT_GT(double(met_by_fixed_numbers) / kStudies, 0.08);
}

// The same studies, ended by the width of an interval.
TEST(Looks, AStudyThatItsSamplesEndKeepsTheRisk) {
  constexpr int kStudies = 300;
  int met = 0, outside = 0;
  std::mt19937_64 engine(22);
  MonteCarloPlan plan = plan_of(5000);
  plan.stop = {.width = 0.01, .of = "p95", .seconds = 0.0};
  for (int study = 0; study < kStudies; ++study) {
    const std::vector<double> all = uniform_values(engine, plan.samples);
    for (const std::uint64_t n : stopping_points(plan)) {
      const ReportedInterval i = estimate_of("p95", all, n, plan, interval_confidence(plan, "p95"));
      if (n < plan.samples && std::max(i.high - i.value, i.value - i.low) > plan.stop.width * i.value) continue;
      const std::vector<double> values(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
      const Estimates e = estimate(values, plan, {}, judgement_of(plan, n, std::nullopt));
      met += e.requirement->met;
      outside += e.of("p95").interval.low > 0.95 || e.of("p95").interval.high < 0.95;
      break;
    }
  }
  EXPECT_LE(double(met) / kStudies, allowed(kStudies));
  EXPECT_LE(double(outside) / kStudies, allowed(kStudies));
}

TEST(Looks, TheFirstOneIsClopperAndPearsonsAndTheRestHaveTheRiskItLeft) {
  const MonteCarloPlan plan = plan_of(100);
  const Judgement first = judgement_of(plan, 100, std::nullopt);
  EXPECT_EQ(first.by, Judgement::By::fixed_number);
  EXPECT_EQ(first.confidence, kConfidence);
  // At most one bad of 100: 0.95^100 + 100 0.05 0.95^99.
  const double spent = std::pow(0.95, 100) + 100 * 0.05 * std::pow(0.95, 99);
  const FirstLook look = first_look_of(plan, 100);
  EXPECT_NEAR(look.spent, spent, 1e-12);
  const Judgement again = judgement_of(plan, 150, look);
  EXPECT_EQ(again.by, Judgement::By::any_time);
  EXPECT_NEAR(again.confidence, 1.0 - (kRisk - spent), 1e-12);
  // The same samples again are no other look.
  EXPECT_EQ(judgement_of(plan, 100, look).by, Judgement::By::fixed_number);
}

TEST(Looks, ARequirementMetWithRoomIsShownByALaterLook) {
  std::mt19937_64 engine(23);
  MonteCarloPlan plan = plan_of(3000);
  plan.requirement->limit = 0.98;
  const FirstLook first = first_look_of(plan, 100);
  EXPECT_TRUE(estimate(uniform_values(engine, 3000), plan, {}, judgement_of(plan, 3000, first)).requirement->met);
}

// A study none of whose samples is bad: of as many as it takes it is met, of one replicate less, or of nets of half the size, it is not.
TEST(Looks, NetsAndHypercubesSayHowManySamplesItTakes) {
  for (const SamplingKind kind : {SamplingKind::lhs, SamplingKind::sobol})
    for (const double probability : {0.9, 0.95, 0.9973}) {
      MonteCarloPlan plan = sum_plan(1, kind);
      plan.design.strata = 20;
      plan.requirement = Requirement{2.0, probability, kConfidence};
      const Judgement judgement = judgement_of(plan, 1, std::nullopt);
      const auto fewest = static_cast<std::uint64_t>(fewest_samples(plan, judgement));
      for (const bool enough : {true, false}) {
        plan.samples = enough ? fewest : kind == SamplingKind::lhs ? fewest - plan.design.strata : fewest / 2;
        const Estimates e =
            estimate(std::vector<double>(plan.samples, 1.0), plan, {}, judgement_of(plan, plan.samples, std::nullopt));
        EXPECT_EQ(e.requirement->met, enough) << to_string(kind) << ", " << plan.samples << " for " << probability;
        EXPECT_EQ(e.requirement->fewest_samples, fewest);
      }
    }
}

TEST(Looks, NetsAndHypercubesHaveOne) {
  MonteCarloPlan plan = sum_plan(1600, SamplingKind::sobol);
  plan.requirement = Requirement{20.0, kProbability, kConfidence};
  const FirstLook first = first_look_of(plan, 1600);
  EXPECT_EQ(first.spent, kRisk);
  const Judgement again = judgement_of(plan, 3200, first);
  EXPECT_EQ(again.by, Judgement::By::nothing);
  EXPECT_THAT(again.why, testing::HasSubstr("1600 samples before"));
}

TEST(Looks, AreWrittenAndReadToTheLastBit) {
  const FirstLook look{12345, 0.037081};
  const std::optional<FirstLook> read = FirstLook::parse(look.text());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->samples, look.samples);
  EXPECT_EQ(read->spent, look.spent);
  EXPECT_FALSE(FirstLook::parse(""));
  EXPECT_NE(question_of({1e-3, 0.95, 0.95}), question_of({1e-3 + 1e-9, 0.95, 0.95}));
}

}  // namespace looks_test
}  // namespace boresight
