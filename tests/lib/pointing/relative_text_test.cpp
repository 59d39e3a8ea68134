#include "boresight/pointing/relative_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace relative_text_test {

TEST(RelativeText, IsAPercentageUpToTenTimesTheValue) {
  EXPECT_EQ(relative_text(0.0), "0 %");
  EXPECT_EQ(relative_text(0.00234), "0.23 %");
  EXPECT_EQ(relative_text(0.9937, 3), "99.4 %");
  EXPECT_EQ(relative_text(0.996), "100 %");
  EXPECT_EQ(relative_text(3.456), "346 %");
  EXPECT_EQ(relative_text(-3.456), "-346 %");
  EXPECT_EQ(relative_text(9.99, 3), "999 %");
}

TEST(RelativeText, IsAMultipleBeyondAndNeverHasAnExponent) {
  EXPECT_EQ(relative_text(10.0), "10 times the value itself");
  EXPECT_EQ(relative_text(1234.0, 2, "the bound"), "1234 times the bound");
  EXPECT_EQ(relative_text(1e9), "over 10000 times the value itself");
  EXPECT_EQ(relative_text(std::nan("")), "not known");
  EXPECT_EQ(relative_text(INFINITY), "not known");
  for (int k = -200; k <= 1600; ++k) {
    const std::string text = relative_text(std::pow(10.0, 0.01 * k));
    EXPECT_EQ(text.find("e+"), std::string::npos) << text;
  }
}

}  // namespace relative_text_test
}  // namespace boresight
