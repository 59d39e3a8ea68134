// Courses that samples tell, and such as they do not.
#include "boresight_analyses/budget/between_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boresight_analyses/budget/measured_course.hpp"

namespace boresight {
namespace between_samples_test {

// A sine with so many samples a period, about a bias.
double share_of(double samples_a_period, double bias = 3.0) {
  return share_between_samples(
      [&](double t) {
        return std::array<double, 3>{0.0, bias + std::sin(2.0 * std::numbers::pi * t / samples_a_period), 0.0};
      },
      5.0, 1.0, 4001);
}

TEST(BetweenSamples, ASineIsToldByItsSamplesAsFarAsThereAreMany) {
  // A chord of w = 2 pi / n misses w^2 / 2 s (1 - s) of the sine at s, the mean of whose square is w^4 / 120.
  for (const double n : {12.0, 40.0, 100.0}) {
    const double w = 2.0 * std::numbers::pi / n;
    EXPECT_NEAR(share_of(n) / (std::pow(w, 4) / 120.0), 1.0, 0.1) << n;
  }
  EXPECT_GT(share_of(4.0), 0.03);
  // Folded to none: all of it is missed.
  EXPECT_NEAR(share_of(1.0), 1.0, 0.02);
  EXPECT_NEAR(share_of(0.5), 1.0, 0.02);
  EXPECT_GT(share_of(0.97), 0.5);
}

TEST(BetweenSamples, WhatDoesNotVaryIsTold) {
  EXPECT_EQ(share_between_samples([](double) { return std::array<double, 3>{1e-6, 0.1, 7.0}; }, 0.0, 1e-3, 1000), 0.0);
  EXPECT_EQ(share_between_samples([](double t) { return std::array<double, 3>{t, 0.0, 0.0}; }, 0.0, 1e-3, 1), 0.0);
}

TEST(BetweenSamples, ARecordIsHeldAgainstTheGridOfTheHistories) {
  MeasuredCourse::Record record;
  record.ends = MeasuredCourse::Ends::held;
  for (int k = 0; k <= 4000; ++k) {
    record.time.push_back(0.25e-3 * k);
    record.value[1].push_back(std::sin(2.0 * std::numbers::pi * 1000.0 * record.time.back()));
  }
  EXPECT_GT(MeasuredCourse(record, std::nullopt, 1e-3, 900, 0.0).share_between_samples(), 0.5);
  EXPECT_LT(MeasuredCourse(record, std::nullopt, 0.05e-3, 900, 0.0).share_between_samples(), 0.02);
}

}  // namespace between_samples_test
}  // namespace boresight
