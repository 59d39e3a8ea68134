// Fixed steps meet the samples and the end.
#include "boresight/stepping/even_steps.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace even_steps_test {

void expect_whole(const EvenSteps& steps, double duration) {
  double sum = 0.0;
  for (long i = 0; i < steps.count(); ++i) {
    EXPECT_NEAR(steps.start(i), sum, 1e-12);
    EXPECT_GT(steps.length(i), 0.0);
    sum += steps.length(i);
  }
  EXPECT_NEAR(sum, duration, 1e-12);
  EXPECT_NEAR(steps.start(steps.count()), duration, 1e-12);
}

TEST(EvenSteps, AreOfOneLengthWhereNoSampleAsksForMore) {
  const EvenSteps steps(1.0, 0.3, 0.0);
  EXPECT_EQ(steps.count(), 4);
  EXPECT_EQ(steps.h(), 0.25);
  EXPECT_EQ(steps.length(3), 0.25);
  expect_whole(steps, 1.0);
}

// Samples every 0.2 s, which one second is made of: 0.1 s does; samples every 0.3 s, which it is not: all but the last step are what was wanted.
TEST(EvenSteps, MeetSamplesThatDoNotDivideTheDurationAndEndWithAShorterOne) {
  expect_whole(EvenSteps(1.0, 0.1, 0.2), 1.0);
  EXPECT_NEAR(EvenSteps(1.0, 0.1, 0.2).h(), 0.1, 1e-15);
  const EvenSteps steps(1.0, 0.15, 0.3);
  EXPECT_EQ(steps.count(), 7);
  EXPECT_EQ(steps.h(), 0.15);
  EXPECT_NEAR(steps.length(6), 0.1, 1e-12);
  EXPECT_NEAR(steps.start(4), 0.6, 1e-12);
  expect_whole(steps, 1.0);
}

TEST(EvenSteps, AreOneWhereTheWholeIsShorter) {
  expect_whole(EvenSteps(0.01, 0.1, 0.2), 0.01);
  EXPECT_EQ(EvenSteps(0.01, 0.1, 0.2).count(), 1);
}

}  // namespace even_steps_test
}  // namespace boresight
