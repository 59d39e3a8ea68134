#include "sweep/drawn_combinations.hpp"

#include <gmock/gmock.h>

namespace boresight::app {
namespace drawn_combinations_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SweepAxis axis(const std::string& name, std::size_t count) {
  SweepAxis made{.parameters = {name}, .si_unit = "kg", .values = {}, .unit = "kg"};
  for (std::size_t i = 0; i < count; ++i) made.values.push_back(1.0 + static_cast<double>(i));
  return made;
}

TEST(DrawnCombinations, AreAllOfAFew) {
  for (const SweepPlan& plan : {SweepPlan{.axes = {axis("x", 50)}, .findings = ""},
                                SweepPlan{.axes = {axis("x", 50), axis("a", 8)}, .findings = ""},
                                SweepPlan{.axes = {axis("x", 50), axis("a", 2), axis("b", 4)}, .findings = ""}}) {
    const DrawnCombinations drawn = drawn_combinations(plan);
    EXPECT_EQ(drawn.combinations.size(), drawn.all);
    EXPECT_THAT(drawn.sentence(plan), IsEmpty());
  }
}

TEST(DrawnCombinations, SpreadOverTheWholeOfALongAxisAndAreNamed) {
  const SweepPlan plan{.axes = {axis("x", 3), axis("payload.mass", 22)}, .findings = ""};
  const DrawnCombinations drawn = drawn_combinations(plan);
  EXPECT_THAT(drawn.combinations, ElementsAre(0, 3, 6, 9, 12, 15, 18, 21));
  EXPECT_THAT(drawn.sentence(plan), HasSubstr("Of the 22 combinations of the other parameters the charts draw 8: "
                                              "payload.mass = 1 kg, 4 kg, 7 kg, 10 kg, 13 kg, 16 kg, 19 kg, 22 kg"));
}

TEST(DrawnCombinations, HoldBothEndsOfEachOfSeveralAxes) {
  const SweepPlan plan{.axes = {axis("x", 3), axis("a", 5), axis("b", 20)}, .findings = ""};
  const DrawnCombinations drawn = drawn_combinations(plan);
  ASSERT_LE(drawn.combinations.size(), kMostOverlaid);
  EXPECT_THAT(drawn.values, ElementsAre(ElementsAre(0, 4), ElementsAre(0, 6, 13, 19)));
  EXPECT_EQ(drawn.combinations.back(), drawn.all - 1);
  EXPECT_THAT(drawn.sentence(plan), HasSubstr("a = 1 kg, 5 kg (of 5 values); b = 1 kg"));
}

TEST(DrawnCombinations, NameTheValueOfAnAxisThatThereIsNoRoomFor) {
  const SweepPlan plan{.axes = {axis("x", 3), axis("a", 2), axis("b", 2), axis("c", 2), axis("d", 9)}, .findings = ""};
  const DrawnCombinations drawn = drawn_combinations(plan);
  EXPECT_EQ(drawn.combinations.size(), 8u);
  EXPECT_THAT(drawn.sentence(plan), HasSubstr("d = 1 kg (of 9 values)"));
}

}  // namespace drawn_combinations_test
}  // namespace boresight::app
