// Fits of journals, and of sliders in rectangular guides, against the sizes in the mechanism file.
#include "boresight_analyses/random/fit_size.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace fit_size_test {

// A journal of 20 mm, a slider of 40 mm by 25 mm, and a pad.
MechanismDescription three_joints() {
  MechanismDescription m;
  m.joints.resize(3);
  m.joints[0].name = "hinge";
  m.joints[1].name = "rail";
  m.joints[2].name = "table";
  m.clearances.resize(3);
  for (int c = 0; c < 3; ++c) m.clearances[static_cast<std::size_t>(c)].joint = c;
  m.clearances[0].parameters.journal_radius = 10e-3;
  m.clearances[0].parameters.radial = 0.02e-3;
  m.clearances[1].guide = GuideShape::rectangular;
  m.clearances[1].parameters.width = 40e-3;
  m.clearances[1].parameters.height = 25e-3;
  m.clearances[1].parameters.length = 60e-3;
  m.clearances[2].parameters.pad_radius = 30e-3;
  return m;
}

TEST(FitSize, IsThatOfTheJournalOrOfTheSliderAcrossTheGap) {
  const MechanismDescription m = three_joints();
  const struct {
    const char *path, *right, *wrong, *expected;
  } cases[] = {
      {"clearance.hinge.radial", "20 H7/g6", "25 H7/g6",
       "a fit of nominal size 20 mm, twice the mechanism file's journal_radius"},
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
}

TEST(FitSize, OfAllJointsIsAskedOfThoseThatHaveTheGap) {
  const std::vector<JournalSize> sizes = journal_sizes(three_joints(), "clearance.*.radial");
  ASSERT_EQ(sizes.size(), 1u);
  EXPECT_EQ(sizes[0].joint, "hinge");
}

}  // namespace fit_size_test
}  // namespace boresight
