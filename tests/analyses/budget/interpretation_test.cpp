// The three interpretations on ensembles whose answers are counted by hand, and what their intervals claim.
#include "boresight_analyses/budget/interpretation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace interpretation_test {

// Member k is k / 100 of the time at 2, else at 1; 0 <= k < 100.
EnsembleInTime stepped(std::int64_t failed = 0) {
  std::vector<std::vector<double>> sizes;
  for (int k = 0; k < 100; ++k) {
    sizes.emplace_back(100, 1.0);
    for (int i = 0; i < k; ++i) sizes.back()[static_cast<std::size_t>(i)] = 2.0;
  }
  return EnsembleInTime(std::move(sizes), failed);
}

TEST(Interpretation, CountsMembersOrTimeOrBoth) {
  const EnsembleInTime e = stepped();
  const auto share = [&](Interpretation i, double leave_out = 0.0) {
    return e.compliance(i, 1.5, 0.5, 0.9, leave_out).share;
  };
  EXPECT_DOUBLE_EQ(share(Interpretation::ensemble), 0.01);        // one member never exceeds
  EXPECT_DOUBLE_EQ(share(Interpretation::temporal), 0.01);        // the worst is at 2 for 99 % of the time
  EXPECT_DOUBLE_EQ(share(Interpretation::temporal, 0.25), 0.26);  // without the 25 worst
  EXPECT_DOUBLE_EQ(share(Interpretation::mixed), 0.505);
  EXPECT_EQ(e.level(Interpretation::temporal, 0.01, 0.9).value, 1.0);  // of the worst, its one instant at 1
  EXPECT_EQ(e.level(Interpretation::temporal, 0.02, 0.9).value, 2.0);
  EXPECT_EQ(e.level(Interpretation::mixed, 0.5, 0.9).value, 1.0);
  EXPECT_EQ(e.level(Interpretation::mixed, 0.51, 0.9).value, 2.0);
  EXPECT_EQ(e.level(Interpretation::temporal, 0.5, 0.9, 0.6).value, 1.0);
  EXPECT_EQ(e.level(Interpretation::temporal, 0.5, 0.9).value, 2.0);
}

// 1 - 0.1^(1/100) = 2.28 %: so many more may be worse than the worst of a hundred, with 90 % confidence.
TEST(Interpretation, SaysHowManyMayBeWorseThanTheWorstThatWasSeen) {
  const ReportedInterval worst = stepped().level(Interpretation::temporal, 0.5, 0.9, 0.0);
  EXPECT_NE(worst.basis.find("at most 2.28 % of all are worse"), std::string::npos) << worst.basis;
}

TEST(Interpretation, AFailedMemberCountsAsBad) {
  const EnsembleInTime e = stepped(100);
  EXPECT_DOUBLE_EQ(e.compliance(Interpretation::mixed, 3.0, 0.4, 0.9).share, 0.5);
  EXPECT_DOUBLE_EQ(e.compliance(Interpretation::ensemble, 3.0, 0.4, 0.9).share, 0.5);
  EXPECT_FALSE(e.compliance(Interpretation::temporal, 3.0, 0.4, 0.9).met);
  EXPECT_TRUE(std::isinf(e.level(Interpretation::mixed, 0.95, 0.9).high));
}

// What a model may be off by raises all that a member has by the same.
TEST(Interpretation, OfRaisedMembersIsThatOfTheRaisedSizes) {
  const CounterStream stream(7, StreamPurpose::resampling);
  std::vector<std::vector<double>> sizes, larger;
  std::vector<double> by;
  for (std::uint64_t k = 0; k < 60; ++k) {
    by.push_back(0.3 * stream.uniform(k, 999, 0));
    sizes.emplace_back();
    for (std::uint64_t i = 0; i < 50; ++i) sizes.back().push_back(stream.uniform(k, i, 0));
    larger.push_back(sizes.back());
    for (double& size : larger.back()) size += by.back();
  }
  const EnsembleInTime raised = EnsembleInTime(sizes, 3).raised(by), anew(larger, 3);
  for (const Interpretation i : kInterpretations)
    for (const double leave_out : {0.0, 0.2}) {
      EXPECT_EQ(raised.compliance(i, 1.1, 0.8, 0.9, leave_out).share,
                anew.compliance(i, 1.1, 0.8, 0.9, leave_out).share);
      EXPECT_EQ(raised.compliance(i, 1.1, 0.8, 0.9, leave_out).shown,
                anew.compliance(i, 1.1, 0.8, 0.9, leave_out).shown);
      EXPECT_EQ(raised.level(i, 0.8, 0.9, leave_out).value, anew.level(i, 0.8, 0.9, leave_out).value);
      EXPECT_EQ(raised.level(i, 0.8, 0.9, leave_out).high, anew.level(i, 0.8, 0.9, leave_out).high);
    }
  EXPECT_THROW(EnsembleInTime(sizes).raised({0.1}), std::invalid_argument);
}

TEST(Interpretation, NeedsAsManyMembersAsWilksSays) {
  const auto constant = [](std::size_t members) { return EnsembleInTime({members, std::vector<double>(10, 1.0)}); };
  for (const Interpretation i : {Interpretation::ensemble, Interpretation::mixed}) {
    EXPECT_FALSE(constant(44).compliance(i, 2.0, 0.95, 0.9).met);
    EXPECT_TRUE(constant(45).compliance(i, 2.0, 0.95, 0.9).met);
    EXPECT_EQ(constant(44).compliance(i, 2.0, 0.95, 0.9).fewest, 45);
  }
}

TEST(Interpretation, TheMixedIntervalHoldsTheLevelAtLeastAsOftenAsItClaims) {
  // e = A sin(phase), A uniform on (0, 10): 8.154 holds for 95 % (ECSS-E-ST-60-10C, Figure A-5).
  constexpr int kTrials = 200, kMembers = 60, kTimes = 50;
  const CounterStream stream(3, StreamPurpose::sample);
  int held = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    std::vector<std::vector<double>> sizes(kMembers);
    for (std::uint64_t k = 0; k < kMembers; ++k)
      for (int i = 0; i < kTimes; ++i)
        sizes[k].push_back(10.0 * stream.uniform(trial, k) * std::sin(0.5 * M_PI * (i + 0.5) / kTimes));
    const ReportedInterval level = EnsembleInTime(std::move(sizes)).level(Interpretation::mixed, 0.95, 0.9);
    held += level.low <= 8.154 && 8.154 <= level.high;
  }
  EXPECT_GE(held, 0.9 * kTrials);
}

TEST(Interpretation, RefusesMembersOfUnequalLengthAndNone) {
  EXPECT_THROW(EnsembleInTime({{1.0, 2.0}, {1.0}}), std::invalid_argument);
  EXPECT_THROW(EnsembleInTime(std::vector<std::vector<double>>{}), std::invalid_argument);
}

// A member keeps the limit with a chance that is just the share asked for: called met no more often than 1 - confidence.
// Counting the members seen and nothing else, as if the worst of them were the worst there is, says so in 0.95^members.
TEST(Interpretation, TheTemporalOneIsCalledMetThatIsNotNoMoreOftenThanItsRisk) {
  constexpr int kTrials = 1000;
  constexpr double kProbability = 0.95, kRisk = 0.1;
  const CounterStream stream(7, StreamPurpose::sample);
  for (const std::uint64_t members : {20, 45, 60, 120}) {
    int met = 0, none_exceeded = 0;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
      std::vector<std::vector<double>> sizes;
      bool kept = true;
      for (std::uint64_t k = 0; k < members; ++k) {
        const bool keeps = stream.uniform(trial, k, members) < kProbability;
        kept = kept && keeps;
        sizes.push_back({1.0, 1.0, keeps ? 1.0 : 3.0, 1.0});
      }
      none_exceeded += kept;
      met += EnsembleInTime(std::move(sizes)).compliance(Interpretation::temporal, 2.0, kProbability, 1.0 - kRisk).met;
    }
    std::printf("%d members: false met %.3f (none of them exceeds: %.3f), nominal %.3f\n", static_cast<int>(members),
                double(met) / kTrials, double(none_exceeded) / kTrials, kRisk);
    EXPECT_LE(double(met) / kTrials, kRisk + 2.0 * std::sqrt(kRisk * (1.0 - kRisk) / kTrials)) << members;
  }
}

TEST(Interpretation, TheTemporalOneTakesTheMembersOfWilksAndNoneThatExceeds) {
  const auto met = [](std::size_t members, bool one_exceeds) {
    std::vector<std::vector<double>> sizes(members, std::vector<double>(10, 1.0));
    if (one_exceeds) sizes.front() = std::vector<double>(10, 3.0);
    return EnsembleInTime(std::move(sizes)).compliance(Interpretation::temporal, 2.0, 0.95, 0.9);
  };
  EXPECT_FALSE(met(44, false).met);
  EXPECT_TRUE(met(45, false).met);
  EXPECT_EQ(met(44, false).fewest, 45);
  EXPECT_FALSE(met(500, true).met);
}

TEST(Interpretation, ResampledOnceEachAMemberGivesTheLevelItself) {
  const EnsembleInTime e = stepped();
  const std::vector<std::uint32_t> once(100, 1);
  EXPECT_EQ(e.resampled_level(Interpretation::mixed, 0.5, 0.0, once), 1.0);
  EXPECT_EQ(e.resampled_level(Interpretation::mixed, 0.51, 0.0, once), 2.0);
  EXPECT_EQ(e.resampled_level(Interpretation::temporal, 0.5, 0.6, once), 1.0);
  EXPECT_EQ(e.resampled_level(Interpretation::temporal, 0.5, 0.0, once), 2.0);
  std::vector<std::uint32_t> first(100, 0);
  first[0] = 100;
  EXPECT_EQ(e.resampled_level(Interpretation::ensemble, 0.95, 0.0, first), 1.0);
}

}  // namespace interpretation_test
}  // namespace boresight
