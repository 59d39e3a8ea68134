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

// A mass of 0 is at the end of its range, and nothing weighs less.
TEST(EndsAtNothing, OnlyWhereNothingIsLess) {
  DesignVariable v;
  v.paths = {"payload.mass"};
  v.si_unit = "kg";
  v.to = 5.0;
  EXPECT_TRUE(ends_at_nothing(v, 0.0));
  EXPECT_FALSE(ends_at_nothing(v, 5.0));
  v.paths = {"payload.center_of_mass.x"};
  v.si_unit = "m";
  EXPECT_FALSE(ends_at_nothing(v, 0.0));
  v.paths = {"clearance.F1.radial"};
  EXPECT_TRUE(ends_at_nothing(v, 0.0));
  v.from = 1e-5;
  EXPECT_FALSE(ends_at_nothing(v, 1e-5));
}

}  // namespace match_report_test
}  // namespace boresight::app
