#include "boresight/contact/turn_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace turn_range_test {

ClearanceDescription free_play(GuideShape guide) {
  ClearanceDescription description;
  description.axes = JournalAxes::free;
  description.guide = guide;
  return description;
}

ClearanceParameters slider(double width, double length, double gap) {
  ClearanceParameters p;
  p.width = width;
  p.height = 0.1 * width;
  p.length = length;
  p.width_gap = gap;
  return p;
}

// Where l sin(turn) + w cos(turn) = w + gap.
double exact_turn(double w, double l, double gap) { return std::asin((w + gap) / std::hypot(w, l)) - std::atan2(w, l); }

TEST(TurnRange, IsWhatTheExactTurnOfASliderDiffersBy) {
  const ClearanceDescription guide = free_play(GuideShape::rectangular);
  for (const double gap : {0.01e-3, 0.03e-3, 0.1e-3}) {
    const ClearanceParameters p = slider(200e-3, 20e-3, gap);
    const double l = 0.5 * p.length, off = exact_turn(0.5 * p.width, l, gap) / (gap / l) - 1.0;
    const double missed = missed_of_turns(guide, JointType::prismatic, p);
    EXPECT_NEAR(missed / off, 1.0, 2.5 * missed) << gap;  // of second order in the turn, and no more
  }
}

TEST(TurnRange, IsSaidOfShortWideOnesAlone) {
  const ClearanceDescription guide = free_play(GuideShape::rectangular), round = free_play(GuideShape::round);
  EXPECT_FALSE(turn_warning("G", guide, JointType::prismatic, slider(40e-3, 60e-3, 0.05e-3)));
  const auto warning = turn_warning("G", guide, JointType::prismatic, slider(200e-3, 20e-3, 0.1e-3));
  ASSERT_TRUE(warning);
  for (const char* part : {"G:", "200 mm wide", "20 mm long", "about 5 %"})
    EXPECT_NE(warning->find(part), std::string::npos) << *warning;

  ClearanceParameters bearing;
  bearing.radial = 0.05e-3;
  bearing.journal_radius = 150e-3;
  bearing.sleeve_length = 20e-3;
  // A journal that is longer than its sleeve: (R + c) cos(turn) - l sin(turn) = R, turned the other way round.
  const double exact = -exact_turn(150.05e-3, 10e-3, -0.05e-3);
  EXPECT_NEAR(missed_of_turns(round, JointType::revolute, bearing) / (1.0 - exact / 5e-3), 1.0, 0.1);
  ASSERT_TRUE(turn_warning("B", round, JointType::revolute, bearing));
  EXPECT_NE(turn_warning("B", round, JointType::revolute, bearing)->find("300 mm thick"), std::string::npos);
  bearing.sleeve_length = 200e-3;
  EXPECT_FALSE(turn_warning("B", round, JointType::revolute, bearing));
}

TEST(TurnRange, IsSaidToItsEndOfAJointWithALongName) {
  std::string name;
  for (int k = 0; k < 100; ++k) name += "φ";
  const auto warning =
      turn_warning(name, free_play(GuideShape::rectangular), JointType::prismatic, slider(200e-3, 20e-3, 0.1e-3));
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->substr(0, name.size() + 1), name + ":");
  EXPECT_EQ(warning->back(), '%') << *warning;
}

TEST(TurnRange, IsNoneWhereNothingTurns) {
  ClearanceDescription parallel = free_play(GuideShape::rectangular);
  parallel.axes = JournalAxes::parallel;
  EXPECT_EQ(missed_of_turns(parallel, JointType::prismatic, slider(200e-3, 20e-3, 0.1e-3)), 0.0);
  EXPECT_EQ(missed_of_turns(free_play(GuideShape::round), JointType::spherical, slider(200e-3, 20e-3, 0.1e-3)), 0.0);
}

// About its axis too: a strip that is wide and thin is held by its faces, one after the other.
TEST(TurnRange, KnowsTheTurnAboutTheAxis) {
  ClearanceParameters p = slider(40e-3, 400e-3, 0.1e-3);
  p.height_gap = 2e-3;  // so that the faces across the width meet first
  const double missed = missed_of_turns(free_play(GuideShape::rectangular), JointType::prismatic, p);
  EXPECT_NEAR(missed, 0.5 * 20e-3 * 0.1e-3 / (2e-3 * 2e-3), 1e-12);
}

}  // namespace turn_range_test
}  // namespace boresight
