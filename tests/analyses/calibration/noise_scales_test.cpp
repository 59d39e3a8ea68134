// The scale of the noise integrated out beside suspects whose prior does not grow with it, against sums over a grid of both.
#include "boresight_analyses/calibration/noise_scales.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace boresight {
namespace noise_scales_test {

double log_sum(const std::vector<double>& logs) {
  const double most = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double x : logs) sum += std::exp(x - most);
  return most + std::log(sum);
}

double log_of(const std::vector<NoiseScale>& scales) {
  std::vector<double> logs;
  for (const NoiseScale& scale : scales) logs.push_back(scale.log_weight);
  return log_sum(logs);
}

ScaledResiduals one_suspect(double rr, double g, double lambda, double m, double values) {
  return {.rr = rr,
          .g = VecX::Constant(1, g),
          .lambda = VecX::Constant(1, lambda),
          .m = VecX::Constant(1, m),
          .values = values};
}

// Over log s and c, whatever the density's form.
double by_grid(const ScaledResiduals& of) {
  constexpr double kStep = 0.02, kStepOfC = 0.02;
  std::vector<double> logs;
  for (double t = -6.0; t < 12.0; t += kStep)
    for (double c = -12.0; c < 12.0; c += kStepOfC) {
      const double rr = of.rr + 2.0 * of.g[0] * c + of.lambda[0] * c * c;
      logs.push_back(-0.5 * (2.0 * t * of.values + rr * std::exp(-2.0 * t) + of.known - 2.0 * of.m[0] * c + c * c));
    }
  return log_sum(logs) + std::log(kStep * kStepOfC / std::sqrt(2.0 * M_PI));
}

TEST(NoiseScales, MeetAGridOfTheNoiseAndASuspect) {
  // What the data say of c, -g / lambda, is 0, 3 and 5 prior deviations off.
  for (const double off : {0.0, 3.0, 5.0})
    for (const double m : {0.0, 0.7}) {
      const double lambda = 6.0;
      const ScaledResiduals of = one_suspect(10.0 + lambda * off * off, -lambda * off, lambda, m, 12.0);
      EXPECT_NEAR(log_of(noise_scales(of)), by_grid(of), 1e-4) << off << ' ' << m;
    }
}

TEST(NoiseScales, WithoutSuspectsLeaveThePriorsOutOfTheResiduals) {
  ScaledResiduals of{.rr = 10.0, .g = {}, .lambda = {}, .known = 0.0, .m = {}, .values = 12.0};
  const double alone = log_of(noise_scales(of)), scale = noise_scales(of).front().square;
  of.known = 9.0;
  EXPECT_NEAR(log_of(noise_scales(of)) - alone, -4.5, 1e-12);
  EXPECT_EQ(noise_scales(of).front().square, scale);
  of.rr = 20.0;
  EXPECT_NEAR(log_of(noise_scales(of)) - alone, -4.5 - 6.0 * std::log(2.0), 1e-12);
}

TEST(NoiseScales, IsTheToldOneWhereTheDataLeaveNothing) {
  ScaledResiduals of = one_suspect(10.0, 1.0, 2.0, 0.0, 2.0);
  of.told = 4.0;
  const std::vector<NoiseScale> scales = noise_scales(of);
  ASSERT_EQ(scales.size(), 1u);
  EXPECT_EQ(scales.front().square, 4.0);
}

}  // namespace noise_scales_test
}  // namespace boresight
