// Bonett's interval of a standard deviation, beside his equation worked out by hand.
#include "boresight_analyses/statistics/bonett.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace bonett_test {

// n = 10; of 1 to 9 and 20 the trimmed mean leaves out two on either side: 5.5. Squares about the mean 6.5 sum up to 262.5, fourth powers about 5.5 to
// 45,003.625; so the kurtosis is 6.531, c = 10 / (10 - 1.960), and its error 1.0011.
TEST(Bonett, IsHisEquationOfTenValues) {
  const LogSdInterval interval = bonett_interval({1, 2, 3, 4, 5, 6, 7, 8, 9, 20}, 0.95);
  EXPECT_NEAR(interval.low, -0.8720293008786986, 1e-9);
  EXPECT_NEAR(interval.high, 1.090180831157083, 1e-9);
}

TEST(Bonett, IsOfNoWidthWhereNothingScattersAndOpenWhereTooFewDo) {
  const LogSdInterval none = bonett_interval({2, 2, 2, 2, 2, 2}, 0.95);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_EQ(none.high, 0.0);
  // No more values than normal deviations of the confidence.
  EXPECT_TRUE(std::isinf(bonett_interval({1, 2, 3, 4, 5}, 1.0 - 1e-8).high));
}

}  // namespace bonett_test
}  // namespace boresight
