#include "boresight/math/quintic_spline.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace quintic_spline_test {

QuinticSpline sine(int intervals) {
  std::vector<double> value, rate, acceleration;
  for (int k = 0; k <= intervals; ++k) {
    const double t = 2.0 * k / intervals;
    value.push_back(std::sin(3.0 * t));
    rate.push_back(3.0 * std::cos(3.0 * t));
    acceleration.push_back(-9.0 * std::sin(3.0 * t));
  }
  return {0.0, 2.0 / intervals, 1, value, rate, acceleration};
}

double largest_error(int intervals) {
  const QuinticSpline spline = sine(intervals);
  double worst = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 2.0 * i / 1000;
    worst = std::max(worst, std::abs(spline.at(t, 0).value - std::sin(3.0 * t)));
  }
  return worst;
}

TEST(QuinticSpline, ErrorFallsWithTheSixthPowerOfTheSpacing) {
  // h^6 max|f^(6)| / 46080 = (2/8)^6 729 / 46080 at 8 intervals.
  EXPECT_NEAR(largest_error(8), std::pow(0.25, 6) * 729.0 / 46080.0, 0.05 * std::pow(0.25, 6) * 729.0 / 46080.0);
  EXPECT_NEAR(std::log2(largest_error(8) / largest_error(16)), 6.0, 0.05);
}

TEST(QuinticSpline, MeetsValueRateAndAccelerationAtItsKnots) {
  const QuinticSpline spline = sine(7);
  for (int k = 0; k <= 7; ++k) {
    const double t = 2.0 * k / 7;
    const TimeValue x = spline.at(t, 0);
    EXPECT_NEAR(x.value, std::sin(3.0 * t), 1e-14);
    EXPECT_NEAR(x.rate, 3.0 * std::cos(3.0 * t), 1e-13);
    EXPECT_NEAR(x.acceleration, -9.0 * std::sin(3.0 * t), 1e-11);
  }
}

}  // namespace quintic_spline_test
}  // namespace boresight
