// Looking again at a budget: how often a requirement is called met that is not, where whoever asks adds members until it is.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "boresight_analyses/budget/interpretation.hpp"
#include "boresight_analyses/random/counter_stream.hpp"
#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {
namespace member_looks_test {

constexpr double kProbability = 0.95, kConfidence = 0.9, kRisk = 1.0 - kConfidence;
constexpr std::size_t kTimes = 2;

double allowed(int repetitions) { return kRisk + 2.0 * std::sqrt(kRisk * (1.0 - kRisk) / repetitions); }

// Sizes of a member over time, of which so many exceed the limit, 2.
std::vector<double> member(std::size_t exceeding) {
  std::vector<double> sizes(kTimes, 1.0);
  std::fill_n(sizes.begin(), exceeding, 3.0);
  return sizes;
}

// What a draw between 0 and 1 makes of a member: each just keeps kProbability in its interpretation.
std::size_t all_or_nothing(double u) { return u < kProbability ? 0 : kTimes; }
std::size_t a_little_or_nothing(double u) { return u < kProbability ? 0 : 1; }
std::size_t some_of_the_time(double u) { return u < 0.9 ? 0 : 1; }  // 5 % of it on average

struct FalseMet {
  double judged = 0.0, each_look_by_itself = 0.0;
};

// 50 members, then an eighth as many again, and again, until it says "met" or 700 are in.
FalseMet repeated(Interpretation interpretation, double leave_out, const std::function<std::size_t(double)>& exceeding,
                  int studies) {
  const CounterStream stream(31, StreamPurpose::sample);
  const AskedShare asked = asked_of_members(interpretation, kProbability, kConfidence, leave_out);
  const LookedAt at = looked_at_members(interpretation, leave_out);
  FalseMet met;
  for (int study = 0; study < studies; ++study) {
    std::vector<std::vector<double>> sizes;
    std::optional<FirstLook> first;
    bool judged = false, by_itself = false;
    for (std::size_t n = 50; n <= 700; n += n / 8) {
      while (sizes.size() < n)
        sizes.push_back(member(exceeding(stream.uniform(static_cast<std::uint64_t>(study), sizes.size()))));
      const EnsembleInTime members(sizes);
      const Judgement judgement = judgement_of(asked, at, n, first);
      if (!first) first = first_look_of(asked, at, n);
      judged = judged || members.compliance(interpretation, 2.0, kProbability, judgement, leave_out).met;
      by_itself = by_itself || members.compliance(interpretation, 2.0, kProbability, kConfidence, leave_out).met;
    }
    met.judged += judged;
    met.each_look_by_itself += by_itself;
  }
  met.judged /= studies;
  met.each_look_by_itself /= studies;
  std::printf("%s%s: false met %.3f (each look by itself: %.3f), nominal %.3f\n", to_string(interpretation),
              leave_out > 0.0 ? ", some left out" : "", met.judged, met.each_look_by_itself, kRisk);
  return met;
}

constexpr int kStudies = 400;

TEST(MemberLooks, AddingMembersUntilTheEnsembleSaysMetKeepsTheRisk) {
  const FalseMet met = repeated(Interpretation::ensemble, 0.0, a_little_or_nothing, kStudies);
  EXPECT_LE(met.judged, allowed(kStudies));
  EXPECT_GT(met.each_look_by_itself, allowed(kStudies));
}

TEST(MemberLooks, AddingMembersUntilTheTemporalOneSaysMetKeepsTheRisk) {
  EXPECT_LE(repeated(Interpretation::temporal, 0.0, all_or_nothing, kStudies).judged, allowed(kStudies));
  const FalseMet met = repeated(Interpretation::temporal, 0.05, all_or_nothing, kStudies);
  EXPECT_LE(met.judged, allowed(kStudies));
  EXPECT_GT(met.each_look_by_itself, allowed(kStudies));
}

TEST(MemberLooks, AddingMembersUntilTheMixedOneSaysMetKeepsTheRisk) {
  const FalseMet met = repeated(Interpretation::mixed, 0.0, all_or_nothing, kStudies);
  EXPECT_LE(met.judged, allowed(kStudies));
  EXPECT_GT(met.each_look_by_itself, met.judged + 0.04);
  EXPECT_LE(repeated(Interpretation::mixed, 0.0, some_of_the_time, kStudies).judged, allowed(kStudies));
}

// Exceeded by one member in a hundred where five were allowed, all the time.
TEST(MemberLooks, ARequirementMetWithRoomIsShownByALaterLook) {
  std::vector<std::vector<double>> sizes(800, member(0));
  for (std::size_t k = 0; k < sizes.size(); k += 100) sizes[k] = member(kTimes);
  const EnsembleInTime members(sizes);
  for (const Interpretation i : {Interpretation::ensemble, Interpretation::mixed}) {
    const AskedShare asked = asked_of_members(i, kProbability, kConfidence, 0.0);
    const LookedAt at = looked_at_members(i, 0.0);
    for (const std::uint64_t before : {20, 50}) {  // 45 could show something
      const Judgement again = judgement_of(asked, at, 800, first_look_of(asked, at, before));
      EXPECT_TRUE(members.compliance(i, 2.0, kProbability, again).met) << to_string(i) << " " << before;
      EXPECT_THAT(again.why, testing::HasSubstr(std::to_string(before) + " members before"));
    }
  }
}

TEST(MemberLooks, OfMembersThatAllKeepTheLimitTheTemporalOneIsNoWorseForLookingAgain) {
  const AskedShare asked = asked_of_members(Interpretation::temporal, kProbability, kConfidence, 0.0);
  const LookedAt at = looked_at_members(Interpretation::temporal, 0.0);
  const Judgement again = judgement_of(asked, at, 45, first_look_of(asked, at, 20));
  std::vector<std::vector<double>> sizes(45, member(0));
  EXPECT_TRUE(EnsembleInTime(sizes).compliance(Interpretation::temporal, 2.0, kProbability, again).met);
  // One that exceeds is an answer; what the others show is then a bound for any number of looks.
  sizes.front() = member(kTimes);
  const auto seen = EnsembleInTime(sizes).compliance(Interpretation::temporal, 2.0, kProbability, again);
  EXPECT_FALSE(seen.met);
  EXPECT_LT(seen.shown, clopper_pearson_lower(44, 45, kConfidence));
}

// What the fewest members are said to be is where "met" begins, with none above the limit.
TEST(MemberLooks, FewestMembersAreThoseThatShowIt) {
  for (const Interpretation i : {Interpretation::ensemble, Interpretation::mixed}) {
    const AskedShare asked = asked_of_members(i, kProbability, kConfidence, 0.0);
    const LookedAt at = looked_at_members(i, 0.0);
    for (const std::uint64_t before : {20, 46}) {
      const Judgement again = judgement_of(asked, at, 1000, first_look_of(asked, at, before));
      const auto met = [&](std::int64_t n) {
        return EnsembleInTime({static_cast<std::size_t>(n), member(0)}).compliance(i, 2.0, kProbability, again);
      };
      const std::int64_t fewest = met(100).fewest;
      EXPECT_TRUE(met(fewest).met) << to_string(i) << " " << before;
      EXPECT_FALSE(met(fewest - 1).met) << to_string(i) << " " << before;
    }
  }
}

}  // namespace member_looks_test
}  // namespace boresight
