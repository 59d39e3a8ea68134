// Fits of journals, balls, and sliders in rectangular guides, against the sizes in the mechanism file.
#include "boresight_analyses/random/fit_size.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace fit_size_test {

// A journal of 20 mm, a slider of 40 mm by 25 mm, a pad, and a ball of 16 mm.
MechanismDescription four_joints() {
  MechanismDescription m;
  m.joints.resize(4);
  m.joints[1].type = JointType::prismatic;
  m.joints[2].type = JointType::planar;
  m.joints[3].type = JointType::spherical;
  m.joints[3].name = "tip";
  m.joints[0].name = "hinge";
  m.joints[1].name = "rail";
  m.joints[2].name = "table";
  m.clearances.resize(4);
  for (int c = 0; c < 4; ++c) m.clearances[static_cast<std::size_t>(c)].joint = c;
  m.clearances[0].parameters.journal_radius = 10e-3;
  m.clearances[0].parameters.radial = 0.02e-3;
  m.clearances[1].guide = GuideShape::rectangular;
  m.clearances[1].parameters.width = 40e-3;
  m.clearances[1].parameters.height = 25e-3;
  m.clearances[1].parameters.length = 60e-3;
  m.clearances[2].parameters.pad_radius = 30e-3;
  m.clearances[3].parameters.journal_radius = 8e-3;
  m.clearances[3].parameters.radial = 0.02e-3;
  return m;
}

TEST(FitSize, IsThatOfTheJournalOrOfTheSliderAcrossTheGap) {
  const MechanismDescription m = four_joints();
  const struct {
    const char *path, *right, *wrong, *expected;
  } cases[] = {
      {"clearance.hinge.radial", "20 H7/g6", "25 H7/g6",
       "a fit of nominal size 20 mm, twice the mechanism file's journal_radius"},
      {"clearance.tip.radial", "16 H7/g6", "20 H7/g6",
       "a fit of nominal size 16 mm, twice the mechanism file's journal_radius"},
      {"clearance.rail.width_gap", "40 H7/g6", "25 H7/g6", "a fit of nominal size 40 mm, the mechanism file's width"},
      {"clearance.rail.height_gap", "25 H7/g6", "40 H7/g6",
       "a fit of nominal size 25 mm, the mechanism file's height"}};
  for (const auto& c : cases) {
    const std::vector<JournalSize> sizes = journal_sizes(m, c.path);
    ASSERT_EQ(sizes.size(), 1u) << c.path;
    EXPECT_TRUE(is_of_size(parse_fit(c.right), sizes[0])) << c.path;
    EXPECT_FALSE(is_of_size(parse_fit(c.wrong), sizes[0])) << c.path;
    EXPECT_EQ(expected_size(sizes[0]), c.expected);
  }
  EXPECT_EQ(found_size(parse_fit("25 H7/g6"), journal_sizes(m, "clearance.rail.width_gap")[0]),
            "\"25 H7/g6\" of nominal size 25 mm, where the slider of rail has a width of 40 mm");
  EXPECT_EQ(found_size(parse_fit("20 H7/g6"), journal_sizes(m, "clearance.tip.radial")[0]),
            "\"20 H7/g6\" of nominal size 20 mm, where the ball of tip has a diameter of 16 mm");
}

TEST(FitSize, OfAllJointsIsAskedOfThoseThatHaveTheGap) {
  const std::vector<JournalSize> sizes = journal_sizes(four_joints(), "clearance.*.radial");
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_EQ(sizes[0].joint, "hinge");
  EXPECT_EQ(sizes[1].joint, "tip");
}

}  // namespace fit_size_test
}  // namespace boresight
