// What a matching's table may say.
#include "boresight_analyses/matching/matching_plan.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace matching_plan_test {

MechanismDescription mechanism() { return read_mechanism(BORESIGHT_EXAMPLES "/crank-slider/crank-slider.toml"); }

MatchingPlan read(const std::string& table, const std::string& starts = "0.1 mm") {
  Document document = Document::from_text(
      "[match]\nminimise = \"free_flight_share\"\n" + table +
          "\n[[match.variable]]\nparameter = \"clearance.A.axial\"\nfrom = \"0.05 mm\"\nto = \"0.5 mm\"\n"
          "starts = [\"" +
          starts + "\"]\n",
      "study.toml");
  Cursor root(document);
  return read_matching_plan(root, Study{}, mechanism(), [](const Setting&) {});
}

std::string fault(const std::string& table, const std::string& starts = "0.1 mm") {
  try {
    read(table, starts);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(MatchingPlan, TakesNumbersUpToTheEndsThatItNames) {
  EXPECT_EQ(read("front = 0").front, 0);
  EXPECT_EQ(read("front = 100").front, 100);
  EXPECT_EQ(read("map = 0").map, 0);
  EXPECT_EQ(read("map = 200").map, 200);
  EXPECT_THAT(fault("front = 101"), testing::HasSubstr("0 to 100"));
  EXPECT_THAT(fault("front = -1"), testing::HasSubstr("0 to 100"));
  EXPECT_THAT(fault("map = 1"), testing::HasSubstr("0, or 2 to 200"));
}

TEST(MatchingPlan, VariablesStartAnywhereBetweenTheirEndsTheseIncluded) {
  EXPECT_NEAR(read("", "0.05 mm").variables[0].starts[0], 0.05e-3, 1e-18);
  EXPECT_NEAR(read("", "0.5 mm").variables[0].starts[0], 0.5e-3, 1e-18);
  EXPECT_THAT(fault("", "0.049 mm"), testing::HasSubstr("values between from and to"));
  EXPECT_THAT(fault("", "0.51 mm"), testing::HasSubstr("values between from and to"));
}

TEST(MatchingPlan, NamesTheCornerOfItsBoxThatNoMechanismMayBe) {
  const std::string file = BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml";
  const MechanismDescription rrcpr = read_mechanism(file);
  Document document = Document::from_text(
      "[match]\nminimise = \"index\"\n"
      "[[match.variable]]\nparameter = \"clearance.F1.cap_radius\"\nfrom = \"12 mm\"\nto = \"16 mm\"\n"
      "[[match.variable]]\nparameter = \"clearance.F1.journal_radius\"\nfrom = \"8 mm\"\nto = \"13 mm\"\n",
      "study.toml");
  Cursor root(document);
  const AcceptsSettings accepts = [&](const std::vector<Setting>& settings) { read_mechanism(file, settings); };
  try {
    read_matching_plan(
        root, Study{}, rrcpr, [&](const Setting& one) { accepts({one}); }, accepts);
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("clearance.F1.cap_radius: found \"12 mm\" at the point"),
                               testing::HasSubstr("clearance.F1.journal_radius = 13 mm")));
  }
}

TEST(MatchingPlan, KeepsTheUnitsThatAreWritten) {
  EXPECT_EQ(read("").variables[0].unit, "mm");
  Document document = Document::from_text(
      "[match]\nminimise = \"free_flight_share\"\n[[match.constraint]]\nmeasure = \"index\"\nat_most = \"20 arcsec\"\n"
      "[[match.variable]]\nparameter = \"clearance.A.axial\"\nfrom = \"0.05 mm\"\nto = \"0.5 mm\"\n",
      "study.toml");
  Cursor root(document);
  Study study;
  study.index = {"boresight_error", "max"};
  EXPECT_EQ(read_matching_plan(root, study, mechanism(), [](const Setting&) {}).constraints[0].unit, "arcsec");
}

}  // namespace matching_plan_test
}  // namespace boresight
