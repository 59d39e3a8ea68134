#include "boresight_analyses/budget/member_bootstrap.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace boresight {
namespace member_bootstrap_test {

// A share as a budget has it, E[a] / E[a + b] of members whose mean squares are skewed: a of one, b of another external error.
TEST(MemberBootstrap, HoldsAShareAsOftenAsItClaims) {
  constexpr int kTrials = 300;
  constexpr double kConfidence = 0.9, kTruth = 0.25;  // E u^2 = 1/3 each, b three times as large
  const CounterStream draw(5, StreamPurpose::sample);
  for (const std::size_t members : {24, 100}) {
    int held = 0;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
      std::vector<double> a, b;
      for (std::uint64_t k = 0; k < members; ++k) {
        a.push_back(std::pow(draw.uniform(trial, k, 1), 2));
        b.push_back(3.0 * std::pow(draw.uniform(trial, k, 2), 2));
      }
      const auto share = [&](const std::vector<std::uint32_t>& times) {
        double part = 0.0, all = 0.0;
        for (std::size_t k = 0; k < members; ++k) {
          part += times[k] * a[k];
          all += times[k] * (a[k] + b[k]);
        }
        return part / all;
      };
      const MemberBootstrap bootstrap(members, trial, 1);
      std::vector<double> values;
      for (std::uint64_t r = 0; r < MemberBootstrap::kResamples; ++r) values.push_back(share(bootstrap.times(r)));
      const MemberInterval i =
          expanded_percentiles(values, share(std::vector<std::uint32_t>(members, 1)), members, kConfidence);
      held += i.low <= kTruth && kTruth <= i.high;
    }
    EXPECT_GE(double(held) / kTrials, kConfidence - 2.0 * std::sqrt(0.09 / kTrials)) << members;
    EXPECT_LE(double(held) / kTrials, 0.98) << members;
  }
}

TEST(MemberBootstrap, DrawsAsManyMembersAsThereAre) {
  const MemberBootstrap bootstrap(7, 1, 0);
  for (std::uint64_t r = 0; r < 20; ++r) {
    const std::vector<std::uint32_t> times = bootstrap.times(r);
    EXPECT_EQ(std::accumulate(times.begin(), times.end(), 0u), 7u);
  }
  EXPECT_NE(bootstrap.times(0), bootstrap.times(1));
}

TEST(MemberBootstrap, SaysNothingOfFewerThanFiveMembers) {
  const MemberInterval i = expanded_percentiles({1.0, 2.0, 3.0}, 2.0, 4, 0.9);
  EXPECT_TRUE(std::isinf(i.low) && std::isinf(i.high));
}

}  // namespace member_bootstrap_test
}  // namespace boresight
