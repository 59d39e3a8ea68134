// What a batch spent, divided among its samples as they end.
#include "boresight_analyses/study/shared_time.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace shared_time_test {

TEST(SharedTime, DividesPreparationEquallyAndMotionsByTheirSteps) {
  SharedTime time(100.0);
  time.begin(4, 108.0, 0.0);                           // 2 s for each
  EXPECT_DOUBLE_EQ(time.end(10.0, 20.0, 110.0), 3.0);  // half of the steps so far, of 2 s
  EXPECT_DOUBLE_EQ(time.end(20.0, 30.0, 111.0), 4.0);  // all that are not paid for yet, of 2 s
  EXPECT_DOUBLE_EQ(time.end(30.0, 60.0, 117.0), 8.0);
  EXPECT_DOUBLE_EQ(time.end(0.0, 60.0, 117.0), 2.0);
  EXPECT_DOUBLE_EQ(time.unpaid(117.0), 0.0);
}

TEST(SharedTime, AddsUpToWhatEveryGroupSpent) {
  SharedTime time(0.0);
  double sum = 0.0;
  time.begin(2, 1.0, 0.0);
  sum += time.end(7.0, 11.0, 4.0);
  sum += time.end(9.0, 16.0, 6.5);
  time.begin(1, 8.0, 16.0);  // what lies in between is the second group's
  sum += time.end(5.0, 21.0, 10.0);
  EXPECT_DOUBLE_EQ(sum, 10.0);
}

}  // namespace shared_time_test
}  // namespace boresight
