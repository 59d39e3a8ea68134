#include "boresight_analyses/budget/budget_plan.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace budget_plan_test {

using testing::AllOf;
using testing::HasSubstr;

class BudgetPlanTest : public testing::Test {
 protected:
  BudgetPlan read(const std::string& table, const std::string& quantity = "boresight_error",
                  bool scatter = true) const {
    const std::string random =
        scatter ? "[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { fit = \"20 H7/g6\" }\n" : "";
    Document document = Document::from_text(random + "[budget]\n" + table, "study.toml");
    Cursor root(document);
    Study study;
    study.index.quantity = quantity;
    return read_budget_plan(root, study, mechanism_->description(), mechanism_->duration(), [](const Setting&) {});
  }
  std::string fault(const std::string& table) const {
    try {
      read(table);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml"));
  const double arcsec_ = M_PI / 180.0 / 3600.0;
};

TEST_F(BudgetPlanTest, ReadsRequirementsAndContributorsWithTheirUnits) {
  const BudgetPlan plan = read(R"(
members = 50
attribution = 10
window = "50 ms"
separation = "0.2 s"
[[budget.requirement]]
index = "RPE"
axis = "y"
interpretation = "temporal"
limit = "30 arcsec"
probability = 0.9973
[[budget.contributor]]
name = "tracker"
class = "random"
value = "2 arcsec"
axes = ["y"]
[[budget.contributor]]
name = "gyro"
class = "drift"
distribution = { normal = { mean = "1 arcsec/s", sd = "0.5 arcsec/s" } }
group = "g"
)");
  ASSERT_EQ(plan.requirements.size(), 1u);
  EXPECT_EQ(plan.requirements[0].index, ErrorIndex::rpe);
  EXPECT_EQ(plan.requirements[0].axis, 1u);
  EXPECT_EQ(plan.requirements[0].interpretation, Interpretation::temporal);
  EXPECT_NEAR(plan.requirements[0].limit, 30 * arcsec_, 1e-15);
  ASSERT_EQ(plan.contributors.size(), 2u);
  EXPECT_FALSE(plan.contributors[0].parameter[0]);
  EXPECT_NEAR(plan.contributors[0].parameter[1]->mean(), 2 * arcsec_, 1e-15);
  EXPECT_EQ(plan.contributors[0].correlation_time, plan.sampling);
  EXPECT_NEAR(plan.contributors[1].parameter[0]->sd(), 0.5 * arcsec_, 1e-15);
  EXPECT_EQ(plan.indices(), (std::vector{ErrorIndex::ape, ErrorIndex::mpe, ErrorIndex::rpe, ErrorIndex::pde}));
}

TEST_F(BudgetPlanTest, WithoutRequirementItIsAboutTheApeOfTheHalfConeOrOfTheWholeLength) {
  const BudgetPlan plan = read("", "boresight_error", false);
  EXPECT_EQ(plan.headline(BudgetAxes(PointingQuantity::boresight_error)).axis, 2u);
  EXPECT_EQ(BudgetAxes(PointingQuantity::boresight_error).name(2), "half cone");
  EXPECT_EQ(plan.headline(BudgetAxes(PointingQuantity::position_error)).axis, 3u);
  EXPECT_EQ(BudgetAxes(PointingQuantity::position_error).name(3), "total");
  EXPECT_EQ(plan.inputs.size(), 0u);
}

TEST_F(BudgetPlanTest, WindowsRequirementsAndContributorsDoNotChangeTheRuns) {
  const std::string one = read("members = 20\n").sample_text({});
  EXPECT_EQ(read("members = 40\nwindow = \"50 ms\"\n[[budget.contributor]]\nname = \"b\"\nclass = \"bias\"\nvalue = "
                 "\"1 arcsec\"\n")
                .sample_text({}),
            one);
  EXPECT_NE(read("members = 20\nseed = 2\n").sample_text({}), one);
  EXPECT_NE(read("members = 20\nsampling = \"1 ms\"\n").sample_text({}), one);
  EXPECT_NE(read("members = 20\nstart = \"0.1 s\"\n").sample_text({}), one);
}

TEST_F(BudgetPlanTest, MistakesAreOneLineWithFileLineAndKey) {
  const auto says = [&](const std::string& table, const std::string& words) {
    EXPECT_THAT(fault(table), AllOf(HasSubstr("study.toml:"), HasSubstr("budget"), HasSubstr(words))) << table;
  };
  const std::string requirement = "[[budget.requirement]]\nlimit = \"1 arcsec\"\n";
  const std::string contributor = "[[budget.contributor]]\nname = \"a\"\n";
  says("members = 1\n", "2 to 5000");
  says("wndow = \"1 s\"\n", "window");
  says("window = \"2 s\"\n", "no longer than an observation");
  says("separation = \"0.2 s\"\n", "a window");
  says("window = \"0.5 ms\"\n", "at least two samples");
  says("start = \"3 s\"\n", "before the end of the motion");
  says(requirement + "index = \"RPE\"\n", "a window, which RPE needs");
  says(requirement + "axis = \"z\"\n", "half cone");
  says(requirement + "interpretation = \"mixd\"\n", "mixed");
  says("[[budget.requirement]]\nlimit = \"1 mm\"\n", "an angle");
  says(contributor + "class = \"wobble\"\nvalue = \"1 arcsec\"\n", "bias");
  says(contributor + "class = \"bias\"\n", "a distribution, or a value");
  says(contributor + "class = \"periodic\"\nvalue = \"1 arcsec\"\n", "a period");
  says(contributor + "class = \"bias\"\nvalue = \"1 arcsec\"\nperiod = \"1 s\"\n", "periodic");
  says(contributor + "class = \"drift\"\nvalue = \"1 arcsec\"\n", "an angular rate");
  says(contributor + "class = \"bias\"\nvalue = \"1 arcsec\"\naxes = [\"q\"]\n", "an axis of the error");
  says(contributor + "class = \"bias\"\nvalue = \"1 arcsec\"\n" + contributor +
           "class = \"bias\"\nvalue = \"1 arcsec\"\n",
       "a second time");
}

TEST_F(BudgetPlanTest, AnObservationMayTakeTheWholeMotionAndNoMore) {
  const std::string whole = std::to_string(mechanism_->duration()) + " s",
                    more = std::to_string(1.001 * mechanism_->duration()) + " s";
  EXPECT_EQ(read("observation = \"" + whole + "\"\n").windows.observation, mechanism_->duration());
  EXPECT_THAT(fault("observation = \"" + more + "\"\n"), HasSubstr("no longer than the motion"));
}

TEST_F(BudgetPlanTest, WithoutRequirementsIsAboutThePointingErrorOfAllAxesWithoutALimit) {
  const BudgetRequirement headline = read("").headline(BudgetAxes(PointingQuantity::boresight_error));
  EXPECT_EQ(headline.index, ErrorIndex::ape);
  EXPECT_EQ(headline.axis, 2u);
  EXPECT_EQ(headline.interpretation, Interpretation::mixed);
  EXPECT_EQ(headline.limit, 0.0);
  EXPECT_EQ(headline.probability, 0.95);
}

}  // namespace budget_plan_test
}  // namespace boresight
