#include "boresight_analyses/matching/design_slopes.hpp"

#include <gmock/gmock.h>

#include "valley.hpp"

namespace boresight {
namespace design_slopes_test {

TEST(DesignSlopes, AreOfNumbersOfContactsAboveZeroInOneMotionsIndexWithoutLimits) {
  MatchingPlan p = valley_plan();
  p.variables[0].paths = {"clearance.F1.radial", "clearance.A1.radial"};
  p.variables[0].from = 1e-5;
  EXPECT_EQ(why_no_slopes(p), "");
  const auto why_not = [&](auto change) {
    MatchingPlan other = p;
    change(other);
    return why_no_slopes(other);
  };
  using testing::HasSubstr;
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.variables[0].paths[1] = "payload.mass"; }),
              HasSubstr("payload.mass is none"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.variables[0].from = 0.0; }), HasSubstr("may be zero"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.objective.measure = Measure::free_flight_share; }),
              HasSubstr("only the index"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.objective.over = Over::mean; }), HasSubstr("one motion"));
  EXPECT_THAT(why_not([](MatchingPlan& q) { q.constraints.push_back({q.objective, 1.0}); }), HasSubstr("limits"));
}

}  // namespace design_slopes_test
}  // namespace boresight
