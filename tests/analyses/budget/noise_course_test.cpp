// Simulated courses of a noise have in their indices what the windows' filters say.
#include "boresight_analyses/budget/noise_course.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "boresight_analyses/budget/budget_runs.hpp"
#include "boresight_analyses/budget/spectral_level.hpp"

namespace boresight {
namespace noise_course_test {

using Complex = std::complex<double>;

constexpr double kSpacing = 0.002;
constexpr std::size_t kSamples = 500;
const Windows kWindows{.window = 0.08, .separation = 0.3, .observation = 0.5, .revisit = 0.6};

struct Named {
  const char* name;
  Noise noise;
};

std::vector<Named> noises() {
  return {
      {"white through a loop", Noise({.white = 1.0}, {TransferFunction::second_order(5.0, 0.3)})},
      {"white within a band", Noise({.white = 1.0, .lower = 2.0, .upper = 60.0})},
      {"flicker", Noise({.flicker = 1.0, .lower = 0.01, .upper = 200.0})},
      {"flicker through a loop", Noise({.flicker = 1.0, .lower = 1e-3}, {TransferFunction::second_order(5.0, 0.3)})},
      {"random walk", Noise({.flicker = 1.0, .exponent = 2.0, .lower = 0.01})},
      {"of first order", Noise({.deviation = 2.0, .correlation_time = 0.03})},
      {"disturbance of a loop", Noise({.flicker = 1.0, .upper = 100.0}, {TransferFunction::sensitivity(2.0, 0.7)})}};
}

double mean_square(const std::vector<double>& course, ErrorIndex index) {
  PointingHistory history{kSpacing, {}};
  for (const double e : course) history.error.emplace_back(e, 0.0, 0.0);
  double sum = 0.0;
  const std::vector<Vec3> values = index_values(index, history, kWindows);
  for (const Vec3& v : values) sum += v.x() * v.x();
  return sum / static_cast<double>(values.size());
}

// A sinusoid after the other with the amplitudes (1, 0) and (0, 1): their mean squares add up to the expectation over all members.
TEST(NoiseCourse, HasInExpectationWhatTheFiltersKeep) {
  for (const Named& of : noises()) {
    const NoiseCourse course(of.noise, kSpacing, kSamples);
    std::uint64_t asked = 0;
    course.drawn([&](std::uint64_t k) {
      asked = std::max(asked, k);
      return Complex(0.0);
    });
    double expected[5] = {};
    for (std::uint64_t k = 0; k <= asked; ++k)
      for (const Complex unit : {Complex(1.0, 0.0), Complex(0.0, 1.0)}) {
        bool any = false;
        const std::vector<double> one = course.drawn([&](std::uint64_t other) {
          any = any || other == k;
          return other == k ? unit : Complex(0.0);
        });
        if (any)
          for (const ErrorIndex index : kErrorIndices) expected[static_cast<int>(index)] += mean_square(one, index);
      }
    for (const ErrorIndex index : kErrorIndices) {
      const double by_filter = of.noise.variance(index, kWindows);
      RecordProperty(std::string(of.name) + " " + to_string(index),
                     std::to_string(expected[static_cast<int>(index)] / by_filter));
      EXPECT_NEAR(std::sqrt(expected[static_cast<int>(index)] / by_filter), 1.0, 0.005)
          << of.name << ' ' << to_string(index);
    }
  }
}

// The root mean square of so many members scatters by at most 1 / sqrt(2 members) of itself: within is 2.2 times that.
void expect_filtered_variance(int members, double within) {
  for (const Named& of : noises()) {
    const NoiseCourse course(of.noise, kSpacing, kSamples);
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal;
    double sum[5] = {};
    for (int member = 0; member < members; ++member) {
      const std::vector<double> one = course.drawn([&](std::uint64_t) {
        const double real = normal(engine);
        return Complex(real, normal(engine));
      });
      for (const ErrorIndex index : kErrorIndices) sum[static_cast<int>(index)] += mean_square(one, index) / members;
    }
    for (const ErrorIndex index : kErrorIndices)
      EXPECT_NEAR(std::sqrt(sum[static_cast<int>(index)] / of.noise.variance(index, kWindows)), 1.0, within)
          << of.name << ' ' << to_string(index);
  }
}
TEST(NoiseCourse, MadeMemberByMemberHasThatWithinFourPerCent) { expect_filtered_variance(1500, 0.04); }
TEST(NoiseCourseNight, MadeMemberByMemberHasThatWithinTwoPerCent) { expect_filtered_variance(6000, 0.02); }

TEST(NoiseCourse, HasTheWholeVarianceAlsoOfWhatItsSamplesAreTooFarApartFor) {
  const Noise fast({.deviation = 2.0, .correlation_time = 0.3e-3});
  const NoiseCourse course(fast, kSpacing, kSamples);
  EXPECT_NEAR(course.variance(), 4.0, 4e-6);
  // Of first order: 2 / pi atan(2 pi f tau) below f.
  EXPECT_NEAR(course.power_above_sampling(), 1.0 - 2.0 / M_PI * std::atan(2.0 * M_PI * 250.0 * 0.3e-3), 1e-6);
}

// The end of a history knows as little of its beginning as the spectrum says.
TEST(NoiseCourse, DoesNotReturnToWhereItBegan) {
  const Noise loop({.white = 1.0}, {TransferFunction::second_order(20.0, 0.5)});
  const NoiseCourse course(loop, kSpacing, kSamples);
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  double product = 0.0, square = 0.0;
  constexpr int kMembers = 4000;
  for (int member = 0; member < kMembers; ++member) {
    const std::vector<double> one = course.drawn([&](std::uint64_t) {
      const double real = normal(engine);
      return Complex(real, normal(engine));
    });
    product += one.front() * one.back();
    square += one.front() * one.front();
  }
  EXPECT_NEAR(product / square, 0.0, 4.0 / std::sqrt(kMembers));
}

BudgetPlan plan_of(const Noise& noise, std::uint64_t seed, std::uint64_t members, const Windows& windows) {
  BudgetPlan plan;
  plan.seed = seed;
  plan.members = members;
  plan.sampling = 0.01;
  plan.duration = 1.0;
  plan.windows = windows;
  Contributor c{.name = "noise", .kind = ContributorClass::spectrum};
  c.parameter[0] = c.parameter[1] = make_discrete({1.0}, {1.0});
  c.noise = std::make_shared<const Noise>(noise);
  c.noise_course = std::make_shared<const NoiseCourse>(noise, plan.sampling, samples_of(plan));
  plan.contributors = {c};
  return plan;
}

// A budget in which nothing differs flags something once in a hundred times. Of 400 budgets at 1 % nine flags or more come up
// once in fifty.
TEST(SpectralLevels, RaiseNoMoreFalseFlagsThanTheySay) {
  const Windows windows{.window = 0.2, .separation = 0.4};
  for (const std::uint64_t members : {4u, 30u}) {
    int flagged = 0;
    constexpr int kBudgets = 400;
    for (std::uint64_t seed = 1; seed <= kBudgets; ++seed) {
      bool any = false;
      const Noise noise = seed % 2 == 0 ? Noise({.white = 1.0}, {TransferFunction::second_order(4.0, 0.3)})
                                        : Noise({.flicker = 1.0, .lower = 0.01, .upper = 8.0});
      for (const SpectralLevel& level : spectral_levels(plan_of(noise, seed, members, windows)))
        any = any || level.differs;
      flagged += any;
    }
    RecordProperty("flags_of_400_with_" + std::to_string(members), flagged);
    EXPECT_LE(flagged, 8) << members;
  }
}

TEST(SpectralLevels, FlagWhereTheSamplesAreTooFarApartForTheWindow) {
  // Three samples in a window, and half of the power above what they can hold: a mean of instants keeps more of it than a mean over time.
  const Noise fast({.white = 1.0, .upper = 100.0});
  const std::vector<SpectralLevel> levels = spectral_levels(plan_of(fast, 1, 200, {.window = 0.03, .separation = 0.1}));
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_FALSE(levels[0].differs);  // APE
  EXPECT_TRUE(levels[1].differs);   // MPE
  EXPECT_NEAR(levels[1].above_sampling, 0.5, 1e-9);
  EXPECT_GT(levels[1].simulated, 1.1 * levels[1].by_filter);
}

}  // namespace noise_course_test
}  // namespace boresight
