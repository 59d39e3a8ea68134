#include "boresight_analyses/budget/budget_plan.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "boresight/io/expression.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/contributor_size.hpp"

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
  // As many as the sampling: every sample of a member is the same.
  says("sampling = \"5 ms\"\n" + contributor + "class = \"periodic\"\nvalue = \"1 arcsec\"\nperiod = \"5 ms\"\n",
       "more than two samples of the histories, 0.01 s");
  says(contributor +
           "class = \"bias\"\nvalue = \"1 arcsec\"\nthrough = [{ loop = { numerator = [-1, 20], denominator = [1, "
           "0], seen_by = \"sensor\" } }]\n",
       "grows without bound");
  says(contributor + "class = \"drift\"\nvalue = \"1 arcsec\"\n", "an angular rate");
  says(contributor + "class = \"bias\"\nvalue = \"1 arcsec\"\naxes = [\"q\"]\n", "an axis of the error");
  says(contributor + "class = \"bias\"\nvalue = \"1 arcsec\"\n" + contributor +
           "class = \"bias\"\nvalue = \"1 arcsec\"\n",
       "a second time");
}

TEST_F(BudgetPlanTest, ReadsSpectraWithTheirUnitsAndWhatTheyGoThrough) {
  const BudgetPlan plan = read(R"(
window = "50 ms"
[[budget.contributor]]
name = "gyro"
spectrum = { white = "4 arcsec^2/Hz", flicker = "2 arcsec^2/Hz", exponent = 1.5, lower = "0.1 Hz", upper = "100 Hz" }
axes = ["y"]
factor = { uniform = { min = 0.5, max = 1.5 } }
[[budget.contributor]]
name = "wind"
spectrum = { white = "9 (N m)^2/Hz", of = "N m" }
through = [{ ratio = { numerator = [1], denominator = [2, 0.5, 800] } }, { sensitivity = { frequency = "2 Hz", damping = 0.7 } }]
)");
  ASSERT_EQ(plan.contributors.size(), 2u);
  const Contributor &gyro = plan.contributors[0], &wind = plan.contributors[1];
  EXPECT_EQ(gyro.kind, ContributorClass::spectrum);
  EXPECT_FALSE(gyro.parameter[0]);
  EXPECT_NEAR(gyro.parameter[1]->sd(), 1.0 / std::sqrt(12.0), 1e-9);
  EXPECT_NEAR(gyro.noise->at(4.0) / (arcsec_ * arcsec_), 4.0 + 2.0 / 8.0, 1e-9);
  EXPECT_EQ(gyro.noise->at(0.09), 0.0);
  const double w = 2.0 * M_PI * 3.0;
  EXPECT_NEAR(wind.noise->at(3.0) / (9.0 * TransferFunction::sensitivity(2.0, 0.7).power(3.0) /
                                     (std::pow(800.0 - 2.0 * w * w, 2) + 0.25 * w * w)),
              1.0, 1e-9);
  EXPECT_EQ(wind.noise_course->samples(), 2000u);
  // Another spectrum is another question of the requirements.
  const std::string asked = question_of(plan, {});
  BudgetPlan other = plan;
  other.contributors[0].noise = std::make_shared<const Noise>(PowerDensity{.white = 1e-12, .upper = 10.0});
  EXPECT_NE(question_of(other, {}), asked);
}

TEST_F(BudgetPlanTest, MistakesInASpectrumAreOneLineWithFileLineAndKey) {
  const auto says = [&](const std::string& lines, const std::string& words) {
    EXPECT_THAT(fault("[[budget.contributor]]\nname = \"a\"\n" + lines + "\n"),
                AllOf(HasSubstr("study.toml:"), HasSubstr("budget.contributor.a"), HasSubstr(words)))
        << lines;
  };
  const std::string white = "spectrum = { white = \"1 arcsec^2/Hz\" }\n";
  const std::string band = "spectrum = { white = \"1 arcsec^2/Hz\", upper = \"9 Hz\" }\n";
  says(white, "an upper frequency, without which the variance has no bound");
  says("spectrum = { flicker = \"1 arcsec^2/Hz\", upper = \"9 Hz\" }", "a lower frequency");
  says(white + "through = [{ sensitivity = { frequency = \"2 Hz\", damping = 0.7 } }]", "an upper frequency");
  says("spectrum = { white = \"1 arcsec/Hz\" }", "a power spectral density");
  says("spectrum = { white = \"1 um^2/Hz\" }", "a power spectral density");
  says("spectrum = {}", "white, flicker or table");
  says("spectrum = { white = \"1 arcsec^2/Hz\", lower = \"9 Hz\", upper = \"9 Hz\" }", "more than lower");
  says("spectrum = { white = \"1 arcsec^2/Hz\", exponent = 1, upper = \"9 Hz\" }", "flicker beside it");
  says("spectrum = { white = \"1 N2/Hz\", of = \"N\" }", "through beside it");
  says("spectrum = { white = \"1 N2/Hz\", of = \"bogus\" }\nthrough = [{ first_order = { bandwidth = \"1 Hz\" } }]",
       "a unit, such as");
  says(band + "class = \"bias\"", "spectrum without it");
  says(band + "value = \"1 arcsec\"", "spectrum without it");
  says(band + "through = [{ ratio = { numerator = [1], denominator = [1, -1] } }]", "negative real parts");
  says(band + "through = [{ ratio = { numerator = [1, 0, 0], denominator = [1, 1] } }]", "no higher power");
  says(band + "through = [{ ratio = { numerator = [0], denominator = [1, 1] } }]", "a coefficient that is not zero");
  says(band + "through = [{}]", "one of first_order, second_order");
  says(band + "through = [{ loop = { numerator = [10], denominator = [1, 0], seen_by = \"wind\" } }]", "disturbance");
  says("spectrum = { table = { file = \"none.csv\", frequency = \"f\", density = \"s\", unit = \"arcsec^2/Hz\" } }",
       "none.csv");
}

TEST_F(BudgetPlanTest, RequirementsByExposureTimeAreOneEachWithAWindowOfTheirOwn) {
  const BudgetPlan plan = read(R"(
[[budget.requirement]]
index = "RPE"
axis = "x"
exposures = ["2 ms", "20 ms", "0.2 s"]
limits = ["1 arcsec", "2 arcsec", "3 arcsec"]
probability = 0.9
)");
  ASSERT_EQ(plan.requirements.size(), 3u);
  EXPECT_EQ(plan.requirements[1].exposure, 0.02);
  EXPECT_NEAR(plan.requirements[1].limit, 2 * arcsec_, 1e-15);
  EXPECT_EQ(plan.windows_of(plan.requirements[1]).window, 0.02);
  // Shares are of an index over all of the budget: none of these.
  EXPECT_EQ(plan.headline(BudgetAxes(PointingQuantity::boresight_error)).index, ErrorIndex::ape);
  EXPECT_NE(question_of(plan, plan.requirements[0]), question_of(plan, plan.requirements[1]));
  const auto says = [&](const std::string& lines, const std::string& words) {
    EXPECT_THAT(fault("[[budget.requirement]]\n" + lines),
                AllOf(HasSubstr("study.toml:"), HasSubstr("budget"), HasSubstr(words)));
  };
  const std::string both = "exposures = [\"2 ms\"]\nlimits = [\"1 arcsec\"]\n";
  says(both, "with index = \"RPE\" only");
  says("index = \"RPE\"\n" + both + "limit = \"1 arcsec\"\n", "limits, one for each exposure");
  says("index = \"RPE\"\nexposures = [\"2 ms\", \"3 ms\"]\nlimits = [\"1 arcsec\"]\n", "one for each exposure");
  says("index = \"RPE\"\nexposures = [\"0.6 ms\"]\nlimits = [\"1 arcsec\"]\n", "at least two samples");
  says("index = \"RPE\"\nexposures = [\"9 s\"]\nlimits = [\"1 arcsec\"]\n", "no longer than an observation");
  says("index = \"RPE\"\nlimits = [\"1 arcsec\"]\n", "exposures beside it");
  says("index = \"APE\"\n", "limit");
}

TEST_F(BudgetPlanTest, PartsMakeATree) {
  const std::string contributors =
      "[[budget.contributor]]\nname = \"a\"\nclass = \"bias\"\nvalue = \"1 arcsec\"\n"
      "[[budget.contributor]]\nname = \"b\"\nclass = \"bias\"\nvalue = \"1 arcsec\"\n";
  const BudgetPlan plan = read(contributors + R"(
[[budget.part]]
name = "all"
allocated = "9 arcsec"
[[budget.part]]
name = "inner"
within = "all"
contributors = ["b"]
mechanism = true
)");
  ASSERT_EQ(plan.parts.size(), 2u);
  EXPECT_NEAR(plan.parts[0].allocated, 9 * arcsec_, 1e-15);
  EXPECT_EQ(plan.parts[1].contributors, (std::vector<std::size_t>{1}));
  EXPECT_TRUE(plan.parts[1].mechanism);
  const auto says = [&](const std::string& parts, const std::string& words) {
    EXPECT_THAT(fault(contributors + parts),
                AllOf(HasSubstr("study.toml:"), HasSubstr("budget.part"), HasSubstr(words)))
        << parts;
  };
  const std::string part = "[[budget.part]]\nname = \"p\"\n", other = "[[budget.part]]\nname = \"q\"\n";
  says(part, "contributors, the mechanism or parts within it");
  says(part + "contributors = [\"c\"]\n", "the name of a contributor");
  says(part + "contributors = [\"a\"]\n" + other + "contributors = [\"a\"]\n", "each contributor in one part");
  says(part + "mechanism = true\n" + other + "mechanism = true\n", "the mechanism in one part");
  says(part + "mechanism = true\nwithin = \"z\"\n", "the name of a part");
  says(part + "within = \"q\"\n" + other + "within = \"p\"\n", "a part that is not");
  says(part + "mechanism = true\n" + part + "mechanism = true\n", "each part once");
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

TEST_F(BudgetPlanTest, ReadsTheColumnsOfAMeasuredCourseForTheAxesThatItActsOn) {
  const std::string file = testing::TempDir() + "boresight_floor.csv";
  std::ofstream(file) << "t,a,b\n0,1,-4\n10,3,-8\n";
  const auto contributor = [&](const std::string& axes, const std::string& columns) {
    return read(R"([[budget.contributor]]
name = "floor"
axes = )" + axes +
                R"(
measured = { file = ")" +
                file + R"(", time = "t", columns = )" + columns + R"(, unit = "arcsec", ends = "held" })")
        .contributors.at(0);
  };
  const Contributor both = contributor(R"(["x", "y"])", R"(["a", "b"])");
  ASSERT_TRUE(both.measured);
  EXPECT_TRUE(both.measured->acts_on(0) && both.measured->acts_on(1) && !both.measured->acts_on(2));
  EXPECT_NEAR(both.measured->record().value[0][1], 3.0 * arcsec_, 1e-18);
  EXPECT_NEAR(both.measured->record().value[1][1], -8.0 * arcsec_, 1e-18);
  const Contributor across = contributor(R"(["y"])", R"(["a"])");
  EXPECT_FALSE(across.measured->acts_on(0));
  EXPECT_NEAR(across.measured->record().value[1][0], 1.0 * arcsec_, 1e-18);
  std::filesystem::remove(file);
}

TEST_F(BudgetPlanTest, ColumnsBelongToTheAxesInTheOrderInWhichTheseAreNamed) {
  const std::string file = testing::TempDir() + "boresight_turned_floor.csv";
  std::ofstream(file) << "t,a,b\n0,1,-4\n10,3,-8\n";
  const auto text = [&](const std::string& axes) {
    return "[[budget.contributor]]\nname = \"floor\"\naxes = " + axes + "\nmeasured = { file = \"" + file +
           "\", time = \"t\", columns = [\"a\", \"b\"], unit = \"arcsec\", ends = \"held\" }";
  };
  const Contributor turned = read(text(R"(["y", "x"])")).contributors.at(0);
  EXPECT_NEAR(turned.measured->record().value[1][1], 3.0 * arcsec_, 1e-18);
  EXPECT_NEAR(turned.measured->record().value[0][1], -8.0 * arcsec_, 1e-18);
  EXPECT_THAT(fault(text(R"(["x", "x"])")), HasSubstr("each axis once"));
  std::filesystem::remove(file);
}

// Their squares, which every interpretation takes, are no numbers.
TEST_F(BudgetPlanTest, ErrorsOfASizeThatNothingHasAreRefusedWhereTheyAreGiven) {
  const std::string file = testing::TempDir() + "boresight_wild_floor.csv";
  std::ofstream(file) << "t,a,b\n0,1,1e300\n10,-1,-1e300\n";
  const auto measured = [&](const std::string& column, const std::string& more = "") {
    return "measured = { file = \"" + file + "\", time = \"t\", columns = [\"" + column +
           "\"], unit = \"rad\", ends = \"held\"" + more + " }\n";
  };
  const std::string gain = "through = [{ ratio = { numerator = [1e300], denominator = [1.0, 1.0] } }]\n";
  const auto of = [](const std::string& text) {
    return "[[budget.contributor]]\nname = \"wild\"\naxes = [\"x\"]\n" + text;
  };
  for (const auto& [key, text] : std::vector<std::pair<std::string, std::string>>{
           {"value", "class = \"bias\"\nvalue = \"1e300 rad\"\n"},
           {"distribution", "class = \"bias\"\ndistribution = { normal = { mean = \"0 rad\", sd = \"1e300 rad\" } }\n"},
           {"value", "class = \"random\"\nvalue = \"1e160 rad\"\n"},
           {"value", "class = \"random\"\nvalue = \"1 rad\"\ncorrelation_time = \"1 ms\"\n" + gain},
           {"value", "class = \"periodic\"\nvalue = \"1e300 rad\"\nperiod = \"0.1 s\"\n"},
           {"value", "class = \"drift\"\nvalue = \"1e300 rad/s\"\n"},
           {"spectrum", "spectrum = { white = \"1e300 rad^2/Hz\", upper = \"100 Hz\" }\n"},
           {"measured", measured("b")},
           {"measured", measured("a") + "factor = { uniform = { min = 0.0, max = 1e300 } }\n"},
           {"measured", measured("a", ", of = \"rad\"") + gain}})
    EXPECT_THAT(fault(of(text)), AllOf(HasSubstr("budget.contributor.wild." + key + ": found errors"),
                                       HasSubstr("none above 1e+09 rad")))
        << text;
  EXPECT_EQ(fault(of(measured("a"))), "no fault");
  EXPECT_EQ(fault(of("class = \"drift\"\nvalue = \"1 deg/s\"\n")), "no fault");
  std::filesystem::remove(file);
}

TEST(ContributorSize, OfAStandingErrorIsThatOfItsCourseAndItsValue) {
  Contributor c;
  c.of_error = ErrorCourse{};
  c.of_error->si_unit = "K";
  c.of_error->course = parse_expression("5*t", {});
  c.of_error->factor = make_uniform(-2.0, 1.0);
  c.of_error->value = make_discrete({-3.0}, {1.0});
  Windows windows;
  windows.start = 1.0;
  EXPECT_NEAR(largest_size(c, windows, 2.0, 10), 2.0 * 15.0 + 3.0, 1e-12);
  c.of_error->value = make_discrete({1e300}, {1.0});
  EXPECT_GT(largest_size(c, windows, 2.0, 10), kLargestExternalError);
}

// A second window that would lie in two observations wherever the first one is, is no index.
TEST_F(BudgetPlanTest, ARevisitHasToLeadFromOneObservationIntoOneOther) {
  EXPECT_THAT(fault("window = \"0.3 s\"\nobservation = \"0.4 s\"\nrevisit = \"0.65 s\"\n"), HasSubstr("revisit"));
  EXPECT_THAT(fault("window = \"0.4 s\"\nobservation = \"0.4 s\"\nrevisit = \"0.5 s\"\n"), HasSubstr("revisit"));
  EXPECT_EQ(read("window = \"0.1 s\"\nobservation = \"0.4 s\"\nrevisit = \"0.6 s\"\n").windows.revisit, 0.6);
  EXPECT_EQ(read("window = \"0.1 s\"\nobservation = \"0.4 s\"\n").windows.window, 0.1);
}

}  // namespace budget_plan_test
}  // namespace boresight
