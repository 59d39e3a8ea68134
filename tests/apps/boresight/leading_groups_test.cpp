#include "sensitivity/leading_groups.hpp"

#include <gtest/gtest.h>

namespace boresight::app {
namespace leading_groups_test {

MeasuredGroup group(const std::string& name, double value, double half) {
  return {name, {value, value - half, value + half, 0.95, 0.95, false, "", "replicated"}};
}

std::string plain(double x) { return std::to_string(x).substr(0, 4); }

TEST(LeadingGroups, AreAllWhoseIntervalsReachTheFirstOnes) {
  const auto leading = leading_groups({group("a", 0.1, 0.05), group("x", 0.49, 0.05), group("y", 0.51, 0.05)});
  EXPECT_EQ(names_of(leading), "y and x");
  EXPECT_EQ(measures_of(leading, plain), "0.51 (0.46 to 0.56) and 0.49 (0.44 to 0.54)");
}

TEST(LeadingGroups, IsOneWhereNoOtherReachesIt) {
  const auto leading = leading_groups({group("x", 0.30, 0.02), group("y", 0.51, 0.05)});
  EXPECT_EQ(names_of(leading), "y");
  // What is wide reaches it although its value is small.
  EXPECT_EQ(names_of(leading_groups({group("x", 0.30, 0.2), group("y", 0.51, 0.05)})), "y and x");
}

TEST(LeadingGroups, NamesAFewOfMany) {
  std::vector<MeasuredGroup> many;
  for (int k = 0; k < 4; ++k) many.push_back(group("p" + std::to_string(k), 0.3 - 0.01 * k, 0.1));
  EXPECT_EQ(names_of(leading_groups(many)), "p0, p1, p2 and p3");
  for (int k = 4; k < 10; ++k) many.push_back(group("p" + std::to_string(k), 0.3 - 0.01 * k, 0.1));
  EXPECT_EQ(names_of(leading_groups(many)), "p0, p1, p2 and 7 others");
}

}  // namespace leading_groups_test
}  // namespace boresight::app
