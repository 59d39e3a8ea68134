#include "match/match_report.hpp"

#include <gtest/gtest.h>

namespace boresight::app {
namespace match_report_test {

TEST(SearchText, SaysHowFarAnInterruptedSearchCame) {
  MatchingResult result;
  EXPECT_EQ(search_text(result), "interrupted in the search of the box, before any descent");
  result.global = "direct";
  EXPECT_EQ(search_text(result), "search of the box: direct, interrupted in the first descent");
  result.local = "bobyqa";
  EXPECT_EQ(search_text(result), "search of the box: direct, descent: bobyqa");
}

TEST(ObjectiveText, HasTheUnitOfWhatItIsHeldAgainst) {
  const MatchingPlan plan;
  const IndexChoice turn{"boresight_error", "max"};
  EXPECT_EQ(objective_text(plan, turn, 0.0002094, 0.0002091), "0.2094 mrad");
  EXPECT_EQ(objective_text(plan, turn, 0.00009, 0.0002091), "0.09 mrad");
}

}  // namespace match_report_test
}  // namespace boresight::app
