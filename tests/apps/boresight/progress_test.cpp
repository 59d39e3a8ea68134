#include "terminal/progress.hpp"

#include <gmock/gmock.h>

namespace boresight::app {
namespace progress_test {

using testing::HasSubstr;
using testing::Not;

TEST(ProgressLine, ShowsBarRateTimeLeftAndEstimate) {
  EXPECT_EQ(progress_line(0.5, 2.0, "s of motion", 10.0, "error 0.2 mm"),
            "[#####---------------]  25 %  0.5 of 2 s of motion, 0.05/s, 30 s left; error 0.2 mm");
}

TEST(ProgressLine, SaysHowLongItHasTakenBeforeTheFirstIsDone) {
  EXPECT_EQ(progress_line(0.0, 2.0, "points", 7.2, ""), "[--------------------]   0 %  0 of 2 points, 7 s so far");
  EXPECT_EQ(progress_line(1.0, 2.0, "points", 7.2, "", 1.0), "[##########----------]  50 %  1 of 2 points, 7 s so far");
  EXPECT_EQ(progress_line(2.0, 2.0, "points", 7.2, "checking"),
            "[####################] 100 %  2 of 2 points, 7 s so far; checking");
}

TEST(ProgressLine, OfAShareThatCountsNothingIsShareAndTimeLeft) {
  EXPECT_EQ(progress_line(0.25, 1.0, "", 10.0, "horizon 30 %"),
            "[#####---------------]  25 %  30 s left; horizon 30 %");
  EXPECT_EQ(progress_line(0.0, 1.0, "", 7.2, ""), "[--------------------]   0 %  7 s so far");
}

TEST(ProgressLine, NeverLeavesTheBar) {
  const std::string line = progress_line(3.0, 2.0, "points", 1.0, "");
  EXPECT_THAT(line, HasSubstr("[####################] 100 %  3 points, 1 s so far"));
  EXPECT_THAT(line, Not(HasSubstr("of 2")));
}

TEST(ProgressLine, LongTimesAreInMinutesAndHours) {
  EXPECT_THAT(progress_line(1.0, 11.0, "points", 60.0, ""), HasSubstr("10 min left"));
  EXPECT_THAT(progress_line(1.0, 101.0, "points", 360.0, ""), HasSubstr("10.0 h left"));
}

TEST(Progress, IsSilentWhenQuiet) {
  std::FILE* file = std::tmpfile();
  {
    Progress progress(Progress::Style::silent, 1.0, "points", file);
    progress.update(1.0, "");
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

}  // namespace progress_test
}  // namespace boresight::app
