// How often an allocation calls a requirement met that is not, by repetition on models whose probabilities are
// exact; and what it does where gaps work against each other.
#include "boresight_analyses/allocation/confirmation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>

#include "boresight_analyses/allocation/allocation.hpp"

namespace boresight {
namespace confirmation_test {

constexpr double kProbability = 0.9, kConfidence = 0.9, kRisk = 1.0 - kConfidence;
constexpr double kMilli = 1e-3, kStep = 0.01, kWidth = 0.005;  // option o of a joint: (1 + kStep o + kWidth u) mm

double normal_quantile(double u) { return quantile(boost::math::normal(), std::clamp(u, 1e-12, 1.0 - 1e-12)); }

AllocationPlan plan_with(std::uint64_t seed, int options) {
  AllocationPlan plan;
  plan.samples = 150;
  plan.confirm = 80;
  plan.seed = seed;
  plan.front = 0;
  plan.requirement = {2.05 * kMilli, kProbability, kConfidence};
  for (int j = 0; j < 2; ++j) {
    AllocationEntry& joint = plan.entries.emplace_back();
    joint.paths = {"joint " + std::to_string(j)};
    for (int o = 0; o < options; ++o) {
      const double least = kMilli * (1.0 + kStep * o);
      joint.options.push_back({std::to_string(o), 10.0 - o - 0.1 * j, make_uniform(least, least + kMilli * kWidth)});
    }
  }
  return plan;
}

// Both gaps in one direction.
LinearDeviation sum_of_gaps() { return {{0.0}, {0, 0, 0}, {{1, 0, 0}, {1, 0, 0}}, "max"}; }

Outcome done(double value) {
  Outcome outcome;
  outcome.status = Outcome::Status::done;
  outcome.value = value;
  return outcome;
}

// At the limit times 1 + 0.02 excess.
Outcome near_limit(const AllocationPlan& plan, double excess) {
  return done(plan.requirement.limit * (1.0 + 0.02 * excess));
}

TEST(Confirmation, CountsSamplesWithoutAnAnswerAsFailedAndAsNotWithin) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const AllocationConfirmation c =
      confirmation_of({1.0, kNone, 2.0, 3.0, kNone}, {2.0, kProbability, kConfidence}, kConfidence);
  EXPECT_EQ(c.samples, 5u);
  EXPECT_EQ(c.failed, 2u);
  EXPECT_EQ(c.share_within, 0.4);
  EXPECT_FALSE(c.met);
}

struct Repeated {
  int claims = 0, repetitions = 0;
  double rate() const { return static_cast<double>(claims) / repetitions; }
  double allowed() const { return kRisk + 2.0 * std::sqrt(kRisk * (1.0 - kRisk) / repetitions); }
};

// `model(plan)` gives the confirming rung. Every set that it confirms has exactly the required probability.
template <typename Model>
Repeated repeated(int repetitions, int options, const Model& model) {
  Repeated all;
  for (int r = 0; r < repetitions; ++r) {
    const AllocationPlan plan = plan_with(static_cast<std::uint64_t>(1000 * r + 1), options);
    all.claims += run_allocation(plan, sum_of_gaps(), 0.0, model(plan), "synthetic", {}).feasible;
    ++all.repetitions;
  }
  return all;
}

// Every set of options weighs the two gaps in a way of its own, so that one that the samples refute is followed by
// one which they may like: each exceeds the limit with probability 1 - kProbability exactly.
TEST(Confirmation, SearchThatGoesOnUntilASetIsConfirmedKeepsTheRisk) {
  const Repeated met = repeated(400, 6, [](const AllocationPlan& plan) {
    return [&plan](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
      std::vector<Outcome> outcomes;
      for (const auto& g : gaps) {
        double option[2], score[2];
        for (int j = 0; j < 2; ++j) {
          const double x = (g[static_cast<std::size_t>(j)] / kMilli - 1.0) / kStep;
          option[j] = std::floor(x + 1e-9);
          score[j] = normal_quantile((x - option[j]) * kStep / kWidth);
        }
        const double angle = 0.4 + 1.1 * option[0] + 2.3 * option[1];
        const double share = cdf(boost::math::normal(), std::cos(angle) * score[0] + std::sin(angle) * score[1]);
        outcomes.push_back(near_limit(plan, share - kProbability));
      }
      return outcomes;
    };
  });
  RecordProperty("false_met_rate", std::to_string(met.rate()));
  std::printf("false met: %.3f, nominal %.3f, allowed %.3f\n", met.rate(), kRisk, met.allowed());
  EXPECT_LE(met.rate(), met.allowed());
}

// The index is a gap less another input: drawn from one stream with the gap, it would never exceed anything.
TEST(Confirmation, GapsAndOtherRandomParametersAreIndependent) {
  RandomInputs inputs;
  inputs.parameters.resize(1);
  const double excess_at = 1.0 - std::sqrt(2.0 * (1.0 - kProbability));  // P(u - v <= this) = kProbability
  Repeated met;
  for (int r = 0; r < 400; ++r) {
    AllocationPlan plan = plan_with(static_cast<std::uint64_t>(1000 * r + 1), 1);
    plan.inputs = inputs;
    const auto model = [&](const std::vector<std::vector<double>>& gaps,
                           const std::vector<std::vector<double>>& others) {
      std::vector<Outcome> outcomes;
      for (std::size_t k = 0; k < gaps.size(); ++k)
        outcomes.push_back(near_limit(plan, (gaps[k][0] / kMilli - 1.0) / kWidth - others[k][0] - excess_at));
      return outcomes;
    };
    met.claims += run_allocation(plan, sum_of_gaps(), 0.0, model, "synthetic", {}).feasible;
    ++met.repetitions;
  }
  std::printf("false met: %.3f, nominal %.3f, allowed %.3f\n", met.rate(), kRisk, met.allowed());
  EXPECT_LE(met.rate(), met.allowed());
}

TEST(Confirmation, EveryOneDrawsSamplesThatNoneBeforeHasSeen) {
  const AllocationPlan plan = plan_with(7, 6);
  std::vector<std::vector<std::vector<double>>> seen;
  const AllocationResult result =
      run_allocation(plan, sum_of_gaps(), 0.0,
                     [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                       seen.push_back(gaps);
                       return std::vector<Outcome>(gaps.size(), near_limit(plan, 0.1));
                     },
                     "synthetic", {});
  EXPECT_FALSE(result.feasible);
  ASSERT_GE(result.confirmations.size(), 3u);
  std::vector<std::uint64_t> seeds;
  for (const AllocationConfirmation& c : result.confirmations) seeds.push_back(c.seed);
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(std::unique(seeds.begin(), seeds.end()), seeds.end());
  // Where in its zone the first gap of the first sample lies.
  const auto place = [](double gap) {
    const double x = (gap / kMilli - 1.0) / kStep;
    return x - std::floor(x + 1e-9);
  };
  for (std::size_t k = 2; k < seen.size(); ++k) EXPECT_NE(place(seen[k][0][0]), place(seen[k - 1][0][0]));
}

TEST(Confirmation, SaysInWordsWhatItsNumbersAre) {
  AllocationPlan plan = plan_with(11, 1);
  plan.requirement.limit = 3.0 * kMilli;
  const AllocationResult result =
      run_allocation(plan, sum_of_gaps(), 0.0,
                     [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                       return std::vector<Outcome>(gaps.size(), near_limit(plan, -0.1));
                     },
                     "synthetic", {});
  ASSERT_FALSE(result.confirmations.empty());
  const AllocationConfirmation& c = result.confirmations.front();
  // All of 80 within: with risk r the share is at least r^(1/80). Of the tenth that may be wrong each confirmation has its part.
  const double confidence = confirmation_confidence(plan.requirement);
  EXPECT_NEAR(c.share_low, std::pow(1.0 - confidence, 1.0 / 80.0), 1e-9);
  char expected[200];
  std::snprintf(expected, sizeof expected,
                "80 fresh samples of the synthetic rung with seed %llu: 100 %% within the limit, at least %.4g %% ",
                static_cast<unsigned long long>(c.seed), 100.0 * c.share_low);
  EXPECT_THAT(c.sentence, testing::StartsWith(expected));
  std::snprintf(expected, sizeof expected, "with %.4g %% confidence (90 %% over the ", 100.0 * confidence);
  EXPECT_THAT(c.sentence, testing::HasSubstr(expected));
  EXPECT_GT(confidence, kConfidence);
  EXPECT_LT(confidence, 1.0);
}

// Samples that keep the limit by less than their rung may be off do not show it.
TEST(Confirmation, CountsEachSampleAsLargerByWhatItsRungMayLeaveOut) {
  AllocationPlan plan = plan_with(11, 1);
  plan.requirement.limit = 3.0 * kMilli;
  const auto result_beside = [&](double model_error) {
    return run_allocation(plan, sum_of_gaps(), 0.0,
                          [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                            Outcome outcome = near_limit(plan, -1.0);
                            outcome.model_error = model_error;
                            return std::vector<Outcome>(gaps.size(), outcome);
                          },
                          "synthetic", {});
  };
  EXPECT_TRUE(result_beside(0.01).feasible);
  const AllocationResult beyond = result_beside(0.03);
  EXPECT_FALSE(beyond.feasible);
  ASSERT_FALSE(beyond.confirmations.empty());
  EXPECT_NEAR(beyond.confirmations.front().model_error, 0.03, 1e-12);
  EXPECT_THAT(beyond.confirmations.front().sentence,
              testing::HasSubstr("counted as larger by what the rung may leave out, on average by 3 %"));
}

// e = 2 - c1 + c2 (mm): the wider first gap points better, and the tightest set keeps no limit below 2 mm.
TEST(Allocation, FindsTheWiderGapThatWorksAgainstAnother) {
  AllocationPlan plan = plan_with(3, 6);
  plan.requirement.limit = 1.96 * kMilli;
  const LinearDeviation opposed({0.0}, {2.0 * kMilli, 0, 0}, {{-1, 0, 0}, {1, 0, 0}}, "max");
  const auto exact = [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
    std::vector<Outcome> outcomes;
    for (const auto& g : gaps) outcomes.push_back(done(opposed.index(g)));
    return outcomes;
  };
  const AllocationResult found = run_allocation(plan, opposed, 0.0, exact, "synthetic", {});
  ASSERT_TRUE(found.feasible);
  EXPECT_TRUE(found.chosen.proven);
  EXPECT_EQ(found.chosen.choice.front(), 5);

  // A form that its own rung does not keep proves nothing, and says no less of what it found.
  const AllocationResult bent = run_allocation(plan, opposed, 1.01 * kMostMisfit, exact, "synthetic", {});
  ASSERT_TRUE(bent.feasible);
  EXPECT_FALSE(bent.chosen.proven);
  EXPECT_EQ(bent.chosen.bound, 0.0);
  EXPECT_EQ(bent.chosen.choice, found.chosen.choice);

  // And before it says that there is none, it has tried what points best, not the tightest alone.
  plan.requirement.limit = 1.9 * kMilli;
  const AllocationResult none = run_allocation(plan, opposed, 0.0, exact, "synthetic", {});
  EXPECT_FALSE(none.feasible);
  EXPECT_NEAR(none.best_reachable, (2.0 - 0.05) * kMilli, 0.006 * kMilli);
  EXPECT_EQ(none.chosen.choice, (std::vector<int>{5, 0}));

  // Nor the tightest alone where none of the search's samples may exceed the limit: of 22 within, 90 percent are with 90 percent confidence.
  plan.samples = 22;
  EXPECT_EQ(run_allocation(plan, opposed, 0.0, exact, "synthetic", {}).chosen.choice, (std::vector<int>{5, 0}));
}

TEST(Allocation, TriesTheTightestGapsOnTheConfirmingRungBeforeItSaysThatNothingDoes) {
  AllocationPlan plan = plan_with(5, 4);
  plan.requirement.limit = 1.0 * kMilli;  // the linear deviation never falls to it
  int calls = 0;
  const AllocationResult result =
      run_allocation(plan, sum_of_gaps(), 0.0,
                     [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                       // What the search tries first says that the rung is as the deviation.
                       const bool first = calls++ == 0;
                       std::vector<Outcome> outcomes;
                       for (const auto& g : gaps)
                         outcomes.push_back(done(first ? g[0] + g[1] : 0.9 * plan.requirement.limit));
                       return outcomes;
                     },
                     "synthetic", {});
  EXPECT_TRUE(result.feasible);
  EXPECT_EQ(result.chosen.choice, (std::vector<int>{0, 0}));
  EXPECT_FALSE(result.chosen.proven);
}

TEST(Allocation, OverCostCurvesClaimsNoProof) {
  AllocationPlan plan = plan_with(9, 1);
  for (AllocationEntry& joint : plan.entries) {
    joint.options.clear();
    joint.curve = {make_cost_curve("reciprocal", 1.0, 0.2, 1.0, 1e-3), 0.002 * kMilli, 0.1 * kMilli};
  }
  plan.requirement.limit = 0.08 * kMilli;
  const LinearDeviation deviation = sum_of_gaps();
  const AllocationResult result =
      run_allocation(plan, deviation, 0.0,
                     [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                       std::vector<Outcome> outcomes;
                       for (const auto& g : gaps) outcomes.push_back(done(deviation.index(g)));
                       return outcomes;
                     },
                     "synthetic", {});
  EXPECT_TRUE(result.feasible);
  EXPECT_TRUE(result.chosen.finished);
  EXPECT_FALSE(result.chosen.proven);
}

// One joint, whose widest option the rung refutes and whose others it likes: the search's factor follows it up and down, and comes back to
// what was refuted.
TEST(Allocation, AsksNoSetAgainThatAnyRoundHasRefuted) {
  AllocationPlan plan = plan_with(13, 5);
  plan.entries.pop_back();
  plan.requirement.limit = 1.045 * kMilli;
  const LinearDeviation one_gap({0.0}, {0, 0, 0}, {{1, 0, 0}}, "max");
  std::vector<int> asked;
  const AllocationResult result =
      run_allocation(plan, one_gap, 0.0,
                     [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                       const int option = static_cast<int>(std::floor((gaps[0][0] / kMilli - 1.0) / kStep + 1e-9));
                       asked.push_back(option);
                       const double factor = asked.size() == 1 ? 1.0 : option == 4 ? 1.027 : 0.98;
                       std::vector<Outcome> outcomes;
                       for (const auto& g : gaps) outcomes.push_back(done(factor * g[0]));
                       return outcomes;
                     },
                     "synthetic", {.accuracy = 0.001});
  ASSERT_TRUE(result.feasible);
  asked.erase(asked.begin());  // the trial that the first factor is from
  EXPECT_EQ(asked.front(), 4);
  std::vector<int> sorted = asked;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end()) << testing::PrintToString(asked);
  EXPECT_EQ(result.chosen.choice, std::vector<int>{3});
  EXPECT_FALSE(result.chosen.proven) << "the factor that leaves out the refuted set was measured by nobody";
}

// The only set there is, and so the tightest: what a round found of it stands.
TEST(Allocation, TriesNoTightestGapsAgainThatARoundHasRefuted) {
  AllocationPlan plan = plan_with(15, 1);
  int calls = 0;
  const AllocationResult result =
      run_allocation(plan, sum_of_gaps(), 0.0,
                     [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                       const double factor = calls++ == 0 ? 1.0 : 1.1;
                       std::vector<Outcome> outcomes;
                       for (const auto& g : gaps) outcomes.push_back(done(factor * (g[0] + g[1])));
                       return outcomes;
                     },
                     "synthetic", {});
  EXPECT_FALSE(result.feasible);
  EXPECT_EQ(calls, 2) << "the trial that the factor is from, and one confirmation";
  ASSERT_EQ(result.confirmations.size(), 1u);
  EXPECT_EQ(result.best_reachable, result.confirmations.front().reached);
  EXPECT_EQ(result.chosen.choice, (std::vector<int>{0, 0}));
}

// Samples of the search that a moderate requirement does with: the rung is first tried on those, and no more.
TEST(Confirmation, OfFewSamplesIsTriedOnThoseThatThereAre) {
  AllocationPlan plan = plan_with(7, 3);
  plan.samples = 8;
  plan.requirement = {2.05 * kMilli, 0.8, 0.8};
  std::vector<std::size_t> asked;
  const AllocationResult result =
      run_allocation(plan, sum_of_gaps(), 0.0,
                     [&](const std::vector<std::vector<double>>& gaps, const std::vector<std::vector<double>>&) {
                       asked.push_back(gaps.size());
                       std::vector<Outcome> outcomes;
                       for (const std::vector<double>& gap : gaps) outcomes.push_back(done(gap[0] + gap[1]));
                       return outcomes;
                     },
                     "synthetic", {});
  ASSERT_FALSE(asked.empty());
  EXPECT_EQ(asked.front(), 8u);
  EXPECT_NEAR(result.factor, 1.0, 0.02);  // the rung is the sum that the search goes by
}

}  // namespace confirmation_test
}  // namespace boresight
