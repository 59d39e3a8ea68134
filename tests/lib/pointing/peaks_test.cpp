#include "boresight/pointing/peaks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace boresight {
namespace peaks_test {

struct Instant {
  double time;
  PoseError error;
  double t() const { return time; }
};

// Walks along `position` at the instants and returns what was handed on.
std::vector<Instant> walk(const std::function<double(double)>& position, const std::vector<double>& times,
                          double start = 0.0, int* looks = nullptr) {
  const auto at = [&](double t) {
    Instant instant{t, {}};
    instant.error.position = position(t);
    return instant;
  };
  std::vector<Instant> taken;
  PeakSeeker<Instant> seeker(
      start, [&](double t, const Instant&) { return (looks ? ++*looks : 0), at(t); },
      [&](const Instant& i) { taken.push_back(i); });
  for (const double t : times) seeker.accept(at(t));
  seeker.finish();
  return taken;
}

std::vector<double> grid(double spacing, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(i * spacing);
  return times;
}

Instant largest(const std::vector<Instant>& taken) {
  return *std::max_element(taken.begin(), taken.end(),
                           [](const Instant& a, const Instant& b) { return a.error.position < b.error.position; });
}

TEST(PeakSeeker, FindsAPeakBetweenInstantsToAllDigits) {
  const auto taken = walk([](double t) { return 2.0 + std::cos(7.0 * (t - 0.4321)); }, grid(0.05, 20));
  EXPECT_NEAR(largest(taken).error.position, 3.0, 1e-14);
  EXPECT_NEAR(largest(taken).time, 0.4321, 1e-8);
}

TEST(PeakSeeker, FindsTheSamePeakWhateverTheInstants) {
  const auto position = [](double t) { return std::exp(-t) * std::abs(std::sin(11.0 * t)); };
  const double coarse = largest(walk(position, grid(0.03, 30))).error.position;
  EXPECT_NEAR(largest(walk(position, grid(0.00917, 100))).error.position, coarse, 1e-14);
}

TEST(PeakSeeker, FindsTheEdgeOfAJump) {
  constexpr double kEdge = 0.30303;
  const auto taken = walk([](double t) { return t < kEdge ? 1.0 + t : 0.5; }, grid(0.05, 20));
  EXPECT_NEAR(largest(taken).error.position, 1.0 + kEdge, 0.1 * std::exp2(-25));
}

TEST(PeakSeeker, HandsEveryInstantOnInOrderOfTime) {
  const std::vector<double> times = grid(0.05, 20);
  const auto taken = walk([](double t) { return std::sin(20.0 * t); }, times);
  for (std::size_t i = 1; i < taken.size(); ++i) EXPECT_LT(taken[i - 1].time, taken[i].time);
  for (const double t : times)
    EXPECT_EQ(std::count_if(taken.begin(), taken.end(), [&](const Instant& i) { return i.time == t; }), 1) << t;
}

TEST(PeakSeeker, LooksForNoneInWhatStaysTheSame) {
  int looks = 0;
  for (const double value : {0.0, 1.0}) walk([&](double) { return value; }, grid(0.05, 20), 0.0, &looks);
  EXPECT_EQ(looks, 0);
}

TEST(PeakSeeker, LeavesOutWhatComesBeforeTheStart) {
  const auto position = [](double t) { return std::exp(-100.0 * (t - 0.21) * (t - 0.21)); };
  const std::vector<double> times = grid(0.05, 20);
  EXPECT_EQ(walk(position, times, 0.5).size(), times.size());
  EXPECT_GT(walk(position, times, 0.0).size(), times.size());
}

}  // namespace peaks_test
}  // namespace boresight
