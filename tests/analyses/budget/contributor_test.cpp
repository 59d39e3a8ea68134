// A contributor's course in time has the moments that its class has by formula, and begins anew where it is
// recalibrated.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight_analyses/budget/classical.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace contributor_test {

constexpr double kSpacing = 0.01;
constexpr std::size_t kSamples = 100;
const Windows kWindows{.window = 0.1, .separation = 0.25, .observation = 0.5, .revisit = 0.6};

Contributor contributor(ContributorClass kind, bool recalibrated = false) {
  return {.name = "c",
          .kind = kind,
          .parameter = {make_normal(1.0, 0.5)},
          .period = 0.08,
          .correlation_time = 0.03,
          .recalibrated = recalibrated};
}

TEST(Contributor, HasInItsCoursesTheMomentsOfItsClass) {
  for (const bool recalibrated : {false, true})
    for (const ContributorClass kind :
         {ContributorClass::bias, ContributorClass::random, ContributorClass::periodic, ContributorClass::drift}) {
      const Contributor c = contributor(kind, recalibrated);
      for (const ErrorIndex index : kErrorIndices) {
        double sum = 0.0, squares = 0.0, count = 0.0;
        for (std::uint64_t member = 0; member < 3000; ++member) {
          const PointingHistory h{kSpacing, course(c, 5, member, 0, kSpacing, kSamples, kWindows)};
          for (const Vec3& v : index_values(index, h, kWindows)) {
            sum += v.x();
            squares += v.x() * v.x();
            count += 1.0;
          }
        }
        const Moments expected = moments(c, 0, index, Interpretation::mixed, kWindows, 1.0);
        const double mean = sum / count, sd = std::sqrt(std::max(0.0, squares / count - mean * mean));
        const std::string what =
            std::string(to_string(kind)) + ' ' + to_string(index) + (recalibrated ? ", recalibrated" : "");
        // 3000 members scatter by 2 % of themselves; ten samples stand for a window, and MPE, RPE, PDE of an APE of 1
        // are seen at the window's places, of which a drift's first and last hold less of the motion.
        EXPECT_NEAR(mean, expected.mean, 0.04) << what;
        EXPECT_NEAR(sd, expected.sd, 0.05) << what;
      }
    }
}

// ECSS-E-ST-60-10C, Table B-1: of noise three times its deviation, whose own scatter over the ensemble counts three times too.
TEST(Contributor, OfNoiseEntersTheEnsembleWithThreeDeviations) {
  const Contributor noise{.name = "n", .kind = ContributorClass::random, .parameter = {make_normal(2.0, 0.1)}};
  const Moments m = moments(noise, 0, ErrorIndex::ape, Interpretation::ensemble, {}, 1.0);
  validation::PrintedTable table("ECSS-E-ST-60-10C, Table B-1", "moments of noise in the ensemble", 1e-9);
  table.expect("mean of noise", 6.0, m.mean);
  table.expect("deviation of noise", 0.3, m.sd);
}

// Table B-1: the worst of a distribution without ends is three deviations off its mean, on the side that is farther from zero.
TEST(Contributor, WithoutEndsIsThreeDeviationsOffAtItsWorst) {
  Contributor bias{
      .name = "b", .kind = ContributorClass::bias, .parameter = {make_normal(2.0, 0.1), make_normal(-2.0, 0.1)}};
  const auto worst = [&](int axis, ErrorIndex index) {
    return moments(bias, axis, index, Interpretation::temporal, {}, 1.0).mean;
  };
  EXPECT_NEAR(worst(0, ErrorIndex::ape), 2.3, 1e-9);
  EXPECT_NEAR(worst(1, ErrorIndex::ape), -2.3, 1e-9);
  bias.recalibrated = true;  // two observations differ by the whole width at most
  EXPECT_NEAR(worst(0, ErrorIndex::pre), 0.6, 1e-9);
}

// Every axis of every stream has a phase of its own, uniform over the members: eighths of a turn hold an eighth of them each.
TEST(Contributor, OfAPeriodBeginsAnywhereInIt) {
  Contributor c{.name = "p", .kind = ContributorClass::periodic, .period = 1.0};
  c.parameter.fill(make_discrete({1.0}, {1.0}));
  constexpr int kMembers = 1600, kParts = 8;
  // 3.5 deviations of a binomial: one of the 72 counts below would be off by more once in thirty seeds.
  const double expected = double(kMembers) / kParts, most = 3.5 * std::sqrt(expected * (1.0 - 1.0 / kParts));
  std::vector<std::vector<double>> phase(9);
  for (std::uint64_t stream = 0; stream < 3; ++stream)
    for (std::uint64_t member = 0; member < kMembers; ++member) {
      const std::vector<Vec3> e =
          course(c, 3, member, stream, 0.25, 2, {});  // a quarter of a period apart: sine and cosine
      for (int axis = 0; axis < 3; ++axis) {
        const double turn = std::atan2(e[0][axis], e[1][axis]) / (2.0 * M_PI) - 0.125;
        phase[3 * stream + static_cast<std::uint64_t>(axis)].push_back(turn - std::floor(turn));
      }
    }
  for (std::size_t k = 0; k < phase.size(); ++k) {
    std::vector<int> count(kParts, 0);
    for (const double turn : phase[k])
      ++count[std::min<std::size_t>(kParts - 1, static_cast<std::size_t>(kParts * turn))];
    for (const int n : count) EXPECT_NEAR(n, expected, most) << k;
    for (std::size_t other = 0; other < k; ++other) EXPECT_NE(phase[k], phase[other]) << k << ' ' << other;
  }
}

TEST(Contributor, SharesTheStreamOfTheFirstOfItsGroupWhereverThatStands) {
  std::vector<Contributor> all(5, contributor(ContributorClass::random));
  all[1].group = all[3].group = "thermal";
  all[2].group = all[4].group = "tracker";
  EXPECT_EQ(streams_of(all), (std::vector<std::uint64_t>{0, 1, 2, 1, 2}));
}

TEST(Contributor, OfOneGroupVariesTogetherAndOthersApart) {
  std::vector<Contributor> all(3, contributor(ContributorClass::random));
  all[0].group = all[2].group = "thermal";
  const std::vector<std::uint64_t> streams = streams_of(all);
  EXPECT_EQ(streams, (std::vector<std::uint64_t>{0, 1, 0}));
  const auto of = [&](std::size_t i) { return course(all[i], 1, 4, streams[i], kSpacing, kSamples, {}); };
  EXPECT_EQ(of(0), of(2));
  EXPECT_NE(of(0), of(1));
}

TEST(ClassicalTable, AddsMeansAndGroupsLinearlyAndTheRestByRootSumSquare) {
  const std::vector<ClassicalLine> lines = {{"a", "bias", "", {{1.0, 3.0}}},
                                            {"b", "bias", "", {{2.0, 4.0}}},
                                            {"c", "random", "thermal", {{0.0, 5.0}}},
                                            {"d", "random", "thermal", {{-0.5, 7.0}}}};
  const ClassicalTotal total = total_of(lines);
  EXPECT_DOUBLE_EQ(total.axes[0].mean, 2.5);
  EXPECT_DOUBLE_EQ(total.axes[0].sd, 13.0);  // 3, 4, 12
  EXPECT_DOUBLE_EQ(total.axis_level(0, 0.95), 28.5);
}

TEST(ClassicalTable, TwoCorrelatedNoisesAreUnsafeByRootSumSquareAndFairAsAGroup) {
  // What the levels are is simulated: two equal noises that are one.
  std::vector<Contributor> pair(2, contributor(ContributorClass::random));
  for (Contributor& c : pair) {
    c.parameter = {make_discrete({1.0}, {1.0})};
    c.group = "one";
  }
  const std::vector<std::uint64_t> streams = streams_of(pair);
  std::vector<std::vector<double>> sizes(100);
  for (std::uint64_t member = 0; member < sizes.size(); ++member) {
    const auto first = course(pair[0], 2, member, streams[0], kSpacing, 400, {}),
               second = course(pair[1], 2, member, streams[1], kSpacing, 400, {});
    for (std::size_t k = 0; k < first.size(); ++k) sizes[member].push_back(std::abs(first[k].x() + second[k].x()));
  }
  const double simulated = EnsembleInTime(std::move(sizes)).level(Interpretation::mixed, 0.95, 0.9).value;
  const auto by_rule = [&](const std::string& group) {
    std::vector<ClassicalLine> lines;
    for (const Contributor& c : pair)
      lines.push_back({c.name, "random", group, {moments(c, 0, ErrorIndex::ape, Interpretation::mixed, {}, 4.0)}});
    return total_of(lines).axis_level(0, 0.95);
  };
  EXPECT_EQ(standing_of(by_rule(""), simulated), RuleStanding::unsafe);
  EXPECT_EQ(standing_of(by_rule("one"), simulated), RuleStanding::fair);
}

// A history that begins late sees a drift that has gone on since the motion began, in the course and in the table.
TEST(Contributor, ADriftBeginsWithTheMotionAndNotWithTheHistory) {
  Contributor drift{.name = "drift", .kind = ContributorClass::drift};
  drift.parameter[0] = make_uniform(2.0, 2.0 + 1e-9);
  const Windows late{.window = 0.1, .start = 3.0};
  const std::vector<Vec3> seen = course(drift, 1, 0, 0, 0.01, 100, late);
  EXPECT_NEAR(seen.front().x(), 2.0 * 3.005, 1e-6);
  EXPECT_NEAR(seen.back().x(), 2.0 * 3.995, 1e-6);
  EXPECT_NEAR(moments(drift, 0, ErrorIndex::ape, Interpretation::mixed, late, 1.0).mean, 2.0 * 3.5, 1e-6);
  EXPECT_NEAR(moments(drift, 0, ErrorIndex::ape, Interpretation::ensemble, late, 1.0).mean, 2.0 * 4.0, 1e-6);
  EXPECT_NEAR(moments(drift, 0, ErrorIndex::mpe, Interpretation::ensemble, late, 1.0).mean, 2.0 * 3.95, 1e-6);
  EXPECT_NEAR(moments(drift, 0, ErrorIndex::rpe, Interpretation::mixed, late, 1.0).mean, 0.0, 1e-12);
  drift.recalibrated = true;
  EXPECT_NEAR(course(drift, 1, 0, 0, 0.01, 100, late).front().x(), 2.0 * 0.005, 1e-6);
}

// Of a drift that is reset with every observation, two windows in different ones differ by what it has been reset by since, however short
// the revisit: the table and the course agree.
TEST(Contributor, PreOfARecalibratedDriftKnowsOfTheReset) {
  Contributor drift{.name = "drift", .kind = ContributorClass::drift};
  drift.parameter[0] = make_uniform(1.0, 1.0 + 1e-9);
  drift.recalibrated = true;
  for (const double revisit : {0.1, 0.15, 0.3, 0.4, 0.5, 0.62, 0.7}) {
    const Windows windows{.window = 0.05, .observation = 0.4, .revisit = revisit};
    const PointingHistory history{0.001, course(drift, 1, 0, 0, 0.001, 80000, windows)};
    const std::vector<Vec3> seen = index_values(ErrorIndex::pre, history, windows);
    ASSERT_FALSE(seen.empty()) << revisit;
    double sum = 0.0, square = 0.0;
    for (const Vec3& value : seen) {
      sum += value.x();
      square += value.x() * value.x();
    }
    const auto count = static_cast<double>(seen.size());
    const Moments line = moments(drift, 0, ErrorIndex::pre, Interpretation::mixed, windows, 80.0);
    EXPECT_NEAR(line.mean, sum / count, 2e-3) << revisit;
    EXPECT_NEAR(line.sd, std::sqrt(std::max(0.0, square / count - sum / count * sum / count)), 2e-3) << revisit;
    double worst = 0.0;
    for (const Vec3& value : seen) worst = std::max(worst, std::abs(value.x()));
    EXPECT_NEAR(moments(drift, 0, ErrorIndex::pre, Interpretation::ensemble, windows, 80.0).mean, worst, 2e-3)
        << revisit;
  }
  // Windows as long as an observation lie in whole ones, of which each has the same mean.
  const Windows whole{.window = 0.4, .observation = 0.4};
  EXPECT_NEAR(moments(drift, 0, ErrorIndex::pre, Interpretation::mixed, whole, 80.0).mean, 0.0, 1e-9);
}

// Also where an observation is no whole number of samples: it begins with the samples that the index takes for its first.
TEST(Contributor, ADriftThatIsRecalibratedBeginsEveryObservationAtNothing) {
  Contributor drift{.name = "drift", .kind = ContributorClass::drift, .recalibrated = true};
  drift.parameter[0] = make_uniform(2.0, 2.0 + 1e-9);
  const double spacing = 0.55e-3;
  const std::vector<Vec3> seen = course(drift, 1, 0, 0, spacing, 2000, {.window = 1e-3, .observation = 20e-3});
  double least = 1.0, most = 0.0;
  for (const Vec3& e : seen) {
    least = std::min(least, e.x());
    most = std::max(most, e.x());
  }
  EXPECT_NEAR(least, 2.0 * 0.5 * spacing, 1e-9);
  EXPECT_NEAR(most, 2.0 * 35.5 * spacing, 1e-9);
}

// Whatever axes a scattering bias is drawn in, its worst case is no less, and no other one cancels it.
TEST(Contributor, TheWorstOfWhatScattersCancelsNothing) {
  Contributor bias{.name = "bias", .kind = ContributorClass::bias};
  bias.parameter[0] = bias.parameter[1] = make_uniform(-3.0, 3.0);
  const double c = std::sqrt(0.5);
  bias.frame << c, -c, 0.0, c, c, 0.0, 0.0, 0.0, 1.0;
  const AxesMoments turned = axes_moments(bias, ErrorIndex::ape, Interpretation::temporal, {}, 1.0);
  EXPECT_TRUE(turned.either_sign);
  EXPECT_NEAR(turned.mean[0], 6.0 * c, 1e-12);
  EXPECT_NEAR(turned.mean[1], 6.0 * c, 1e-12);
  const auto line = [](double mean, bool either) {
    return ClassicalLine{.name = "", .kind = "", .group = "", .axes = {{mean, 0.0}}, .either_sign = either};
  };
  const std::vector<ClassicalLine> lines = {line(-2.0, false), line(3.0, true)};
  EXPECT_NEAR(std::abs(total_of(lines).axes[0].mean), 5.0, 1e-12);
  // What is the same in all members keeps its sign.
  const std::vector<ClassicalLine> known = {line(-2.0, false), line(2.0, false)};
  EXPECT_NEAR(total_of(known).axes[0].mean, 0.0, 1e-12);
}

}  // namespace contributor_test
}  // namespace boresight
