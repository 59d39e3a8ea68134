// Indices of sampled histories, held against the exact filters of windows and against errors whose indices are plain.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "boresight_analyses/budget/contributor.hpp"

namespace boresight {
namespace window_test {

constexpr double kPi = std::numbers::pi;

PointingHistory history_of(double duration, std::size_t samples, const std::function<Vec3(double)>& e) {
  PointingHistory h{duration / static_cast<double>(samples), {}};
  for (std::size_t k = 0; k < samples; ++k) h.error.push_back(e((static_cast<double>(k) + 0.5) * h.spacing));
  return h;
}

double mean_square(const std::vector<Vec3>& values) {
  double sum = 0.0;
  for (const Vec3& v : values) sum += v.squaredNorm();
  return sum / static_cast<double>(values.size());
}

// Whole periods of the sinusoid under the windows' beginnings, so that the mean over places is the mean over phases.
TEST(WindowFilter, IsWhatSampledWindowsKeepOfASinusoid) {
  for (const double period : {0.05, 0.13, 0.4, 1.0}) {
    const Windows windows{.window = 0.1, .separation = 0.23, .observation = 0.0, .revisit = 0.0};
    const double omega = 2.0 * kPi / period;
    for (const ErrorIndex index : {ErrorIndex::ape, ErrorIndex::mpe, ErrorIndex::rpe, ErrorIndex::pde}) {
      const double reach = index == ErrorIndex::ape ? 0.0 : index == ErrorIndex::pde ? 0.33 : 0.1;
      const double whole = std::round(20.0 / period) * period;
      const auto samples = static_cast<std::size_t>(std::round((whole + reach) / 0.0005));
      const PointingHistory h = history_of(0.0005 * static_cast<double>(samples), samples,
                                           [&](double t) { return Vec3(std::sin(omega * t), 0, 0); });
      EXPECT_NEAR(mean_square(index_values(index, h, windows)), 0.5 * kept_of_sinusoid(index, omega, windows), 0.004)
          << to_string(index) << ", period " << period;
    }
  }
}

// A history of first-order noise: means over many windows against the autocovariance integrated twice.
TEST(WindowFilter, IsWhatSampledWindowsKeepOfNoise) {
  const Windows windows{.window = 0.1, .separation = 0.15};
  for (const double tau : {0.01, 0.1}) {
    const Contributor noise{.name = "n",
                            .kind = ContributorClass::random,
                            .parameter = {make_discrete({2.0}, {1.0})},
                            .correlation_time = tau};
    PointingHistory h{0.0005, {}};
    h.error = course(noise, 7, 0, 0, h.spacing, 400'000, windows);
    for (const ErrorIndex index : {ErrorIndex::ape, ErrorIndex::mpe, ErrorIndex::rpe, ErrorIndex::pde}) {
      const double expected = 4.0 * kept_of_noise(index, tau, windows);
      // 200 s hold at least 1000 correlation times.
      EXPECT_NEAR(mean_square(index_values(index, h, windows)) / expected, 1.0, 0.1)
          << to_string(index) << ", tau " << tau;
    }
  }
}

TEST(WindowFilter, HasTheLimitsOfShortAndLongWindows) {
  EXPECT_NEAR(kept_of_sinusoid(ErrorIndex::mpe, 1e-6, {.window = 1.0}), 1.0, 1e-12);
  EXPECT_NEAR(kept_of_sinusoid(ErrorIndex::mpe, 2.0 * kPi, {.window = 1.0}), 0.0, 1e-12);
  EXPECT_NEAR(kept_of_noise(ErrorIndex::mpe, 1e6, {.window = 1.0}), 1.0, 1e-6);
  EXPECT_NEAR(kept_of_noise(ErrorIndex::mpe, 1e-3, {.window = 1.0}), 2e-3, 1e-5);  // 2 tau / window
  // Two windows far apart share no noise.
  EXPECT_NEAR(kept_of_noise(ErrorIndex::pde, 0.01, {.window = 1.0, .separation = 5.0}),
              2.0 * kept_of_noise(ErrorIndex::mpe, 0.01, {.window = 1.0}), 1e-12);
}

TEST(ErrorIndexOfAHistory, OfABiasIsTheBiasInApeAndMpeAndNothingInTheOthers) {
  const PointingHistory h = history_of(1.0, 1000, [](double) { return Vec3(1, -2, 3); });
  const Windows windows{.window = 0.1, .separation = 0.2, .observation = 0.5};
  for (const ErrorIndex index : kErrorIndices)
    for (const Vec3& v : index_values(index, h, windows)) {
      const bool kept = index == ErrorIndex::ape || index == ErrorIndex::mpe;
      EXPECT_LT((v - (kept ? Vec3(1, -2, 3) : Vec3::Zero())).norm(), 1e-12);
    }
}

// An exposure that ends just after a step sees all of it but its own share in the mean, whenever the step comes.
TEST(ErrorIndexOfAHistory, OfAStepIsAsLargeWheneverItComes) {
  for (const double window : {1.0, 0.5})
    for (const double at : {2.25, 2.49, 2.5, 2.031, 3.2}) {
      const PointingHistory h = history_of(5.0, 5000, [&](double t) { return Vec3(t < at ? 0.0 : 1.0, 0, 0); });
      double most = 0.0;
      for (const Vec3& v : index_values(ErrorIndex::rpe, h, {.window = window})) most = std::max(most, std::abs(v.x()));
      EXPECT_GT(most, 1.0 - 1.0 / 15.0) << window << ", " << at;
      EXPECT_LE(most, 1.0);
    }
}

TEST(ErrorIndexOfAHistory, OfADriftIsTheDriftOverTheSeparation) {
  const PointingHistory h = history_of(1.0, 1000, [](double t) { return Vec3(2.0 * t, 0, 0); });
  const Windows windows{.window = 0.1, .separation = 0.2, .observation = 0.5, .revisit = 0.6};
  for (const Vec3& v : index_values(ErrorIndex::pde, h, windows)) EXPECT_NEAR(v.x(), 0.4, 1e-12);
  for (const Vec3& v : index_values(ErrorIndex::pre, h, windows)) EXPECT_NEAR(v.x(), 1.2, 1e-12);
  double most = 0.0;
  for (const Vec3& v : index_values(ErrorIndex::rpe, h, windows)) most = std::max(most, std::abs(v.x()));
  EXPECT_NEAR(most, 0.1, 1e-12);  // rate times half the window
}

// Samples stand in the middle of their parts of a window; however few they are, and where they do not divide it, its ends are seen.
TEST(ErrorIndexOfAHistory, OfADriftIsRateTimesHalfTheWindowInRpe) {
  for (const double window : {0.1, 0.037, 0.5})
    for (const double samples : {4.0, 10.0, 20.0, 23.4, 90.0}) {
      const double spacing = window / samples;
      const PointingHistory h = history_of(spacing * std::floor(1.0 / spacing), static_cast<std::size_t>(1.0 / spacing),
                                           [](double t) { return Vec3(2.0 * t, 0, 0); });
      double most = 0.0;
      const std::vector<Vec3> values = index_values(ErrorIndex::rpe, h, {.window = window});
      for (const Vec3& v : values) most = std::max(most, std::abs(v.x()));
      EXPECT_NEAR(most / window, 1.0, 1e-9) << window << ", " << samples;
      if (samples < 10.0) continue;
      EXPECT_NEAR(mean_square(values) / (window * window), 1.0 / 3.0, 0.02) << samples;
    }
}

TEST(ErrorIndexOfAHistory, WindowsStayWithinAnObservationAndPreLooksAcrossTwo) {
  // One value in the first observation, another in the second: no index within one sees a change.
  const PointingHistory h = history_of(1.0, 1000, [](double t) { return Vec3(t < 0.5 ? 1.0 : 4.0, 0, 0); });
  const Windows windows{.window = 0.1, .separation = 0.2, .observation = 0.5};
  for (const ErrorIndex index : {ErrorIndex::rpe, ErrorIndex::pde})
    for (const Vec3& v : index_values(index, h, windows)) EXPECT_NEAR(v.x(), 0.0, 1e-12);
  const std::vector<Vec3> across = index_values(ErrorIndex::pre, h, windows);
  EXPECT_EQ(across.size(), 401u);
  for (const Vec3& v : across) EXPECT_NEAR(v.x(), 3.0, 1e-12);
}

TEST(ErrorIndexOfAHistory, PreLooksFromEveryWindowOfEveryObservationIntoTheNext) {
  // Three observations of 100 samples, 1, 4 and 16: 91 whole windows of ten samples in each of the first two.
  const PointingHistory h = history_of(1.5, 300, [](double t) {
    return Vec3(t < 0.5 ? 1.0 : t < 1.0 ? 4.0 : 16.0, 0, 0);
  });
  std::vector<Vec3> across = index_values(ErrorIndex::pre, h, {.window = 0.05, .observation = 0.5});
  ASSERT_EQ(across.size(), 182u);
  for (std::size_t k = 0; k < across.size(); ++k) EXPECT_NEAR(across[k].x(), k < 91 ? 3.0 : 12.0, 1e-12) << k;
}

TEST(ErrorIndexOfAHistory, PreOfARevisitWithinAnObservationTakesWhatLiesInTwo) {
  // Ten samples, the squares of 0 to 9, two observations of five; three samples apart, 2 to 4 and 5 to 7 lie in both.
  const PointingHistory h =
      history_of(1.0, 10, [](double t) { return Vec3(std::pow(std::floor(10.0 * t + 1e-6), 2), 0, 0); });
  const std::vector<Vec3> across =
      index_values(ErrorIndex::pre, h, {.window = 0.1, .observation = 0.5, .revisit = 0.3});
  ASSERT_EQ(across.size(), 3u);
  for (std::size_t k = 0; k < across.size(); ++k)
    EXPECT_NEAR(across[k].x(), std::pow(k + 5.0, 2) - std::pow(k + 2.0, 2), 1e-9);
}

TEST(ErrorIndexOfAHistory, SaysWhatItNeeds) {
  EXPECT_EQ(Windows{}.missing_for(ErrorIndex::ape, 1.0), "");
  EXPECT_EQ(Windows{}.missing_for(ErrorIndex::mpe, 1.0), "a window");
  EXPECT_EQ((Windows{.window = 2.0}.missing_for(ErrorIndex::rpe, 1.0)), "a window no longer than an observation");
  EXPECT_EQ((Windows{.window = 0.1}.missing_for(ErrorIndex::pde, 1.0)), "a separation");
  EXPECT_EQ((Windows{.window = 0.1}.missing_for(ErrorIndex::pre, 1.0)), "an observation");
  EXPECT_EQ((Windows{.window = 0.1, .observation = 0.95}.missing_for(ErrorIndex::pre, 1.0)),
            "two observations in the motion");
  EXPECT_THROW(index_values(ErrorIndex::mpe, history_of(1.0, 10, [](double) { return Vec3::Zero(); }), {}),
               std::invalid_argument);
}

// The window slides over a sinusoid: the largest distance from the mean of any window that the instant lies in.
TEST(WindowFilter, KnowsTheLargestRelativeErrorOfASinusoid) {
  for (const double window : {0.02, 0.1, 0.35, 0.5, 0.9, 1.0, 1.3, 2.7}) {
    double most = 0.0;
    constexpr int kPhases = 400, kPlaces = 400;
    for (int i = 0; i < kPhases; ++i) {
      const double phase = 2.0 * M_PI * i / kPhases, omega = 2.0 * M_PI;
      const double mean = (std::cos(phase) - std::cos(phase + omega * window)) / (omega * window);
      for (int k = 0; k <= kPlaces; ++k)
        most = std::max(most, std::abs(std::sin(phase + omega * window * k / kPlaces) - mean));
    }
    EXPECT_NEAR(peak_of_sinusoid(ErrorIndex::rpe, 2.0 * M_PI, {.window = window}), most, 2e-3) << window;
  }
  // A tenth of the period; sqrt(1 - s^2), what the mean square keeps, is 0.180.
  EXPECT_NEAR(peak_of_sinusoid(ErrorIndex::rpe, 2.0 * M_PI, {.window = 0.1}), 0.311, 5e-4);
  EXPECT_NEAR(peak_of_sinusoid(ErrorIndex::mpe, 2.0 * M_PI, {.window = 0.1}), std::sin(0.1 * M_PI) / (0.1 * M_PI),
              1e-12);
}

// Lengths that fit into the motion fit into its history, though samples do not divide them: 3333 of 0.3 ms in a second.
TEST(ErrorIndexOfAHistory, HasPlaceForWhatTheMotionHasPlaceFor) {
  const PointingHistory h = history_of(0.9999, 3333, [](double t) { return Vec3(t < 0.5 ? 1.0 : 4.0, 0, 0); });
  const std::vector<Vec3> halves = index_values(ErrorIndex::pre, h, {.window = 0.5, .observation = 0.5});
  ASSERT_FALSE(halves.empty());
  EXPECT_NEAR(halves.front().x(), 3.0, 0.01);
  EXPECT_EQ(index_values(ErrorIndex::mpe, h, {.window = 1.0}).size(), 1u);
  EXPECT_FALSE(index_values(ErrorIndex::pde, h, {.window = 0.4, .separation = 0.6}).empty());
  EXPECT_THROW(index_values(ErrorIndex::pre, h, {.window = 0.5, .observation = 0.501}), std::invalid_argument);
}

}  // namespace window_test
}  // namespace boresight
