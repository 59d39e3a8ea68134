// Which designs a matching's rung is chosen by, and as what: as they are evaluated.
#include "boresight_analyses/matching/designs_tried.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/built_mechanism.hpp"

namespace boresight {
namespace designs_tried_test {

std::shared_ptr<const Mechanism> hexapod() {
  return std::make_shared<const Mechanism>(
      read_mechanism(BORESIGHT_EXAMPLES "/hexapod/hexapod.toml", {{"motion.duration", "20 ms"}}));
}

// Two legs whose lengths scatter about the drawing's, and a variable by which nothing deviates unless it is an error itself.
MatchingPlan plan(
    const Mechanism& mechanism, const std::string& over, const std::string& sd,
    const std::string& variable = "parameter = \"gravity.z\"\nfrom = \"-10 m/s^2\"\nto = \"-9 m/s^2\"\n") {
  std::string text = "[match]\nminimise = \"index\"\nover = \"" + over + "\"\n";
  if (over != "nominal") text += "samples = 50\n";
  text += "[[match.variable]]\n" + variable;
  if (over != "nominal")
    for (const char* leg : {"leg1a", "leg2b"})
      text += std::string("[[random]]\nparameter = \"error.") + leg +
              ".length\"\ndistribution = { normal = { mean = \"0 mm\", sd = \"" + sd + "\" } }\n";
  Document document = Document::from_text(text, "study.toml");
  Cursor root(document);
  return read_matching_plan(root, Study{}, mechanism.description(), [](const Setting&) {});
}

RungChoice choice_of(const std::shared_ptr<const Mechanism>& mechanism, const MatchingPlan& matching) {
  const StudyRun run(mechanism, {.accuracy = 0.01, .index = {"boresight_error", "max"}});
  return run.rung_of_designs(designs_tried(matching, *mechanism, 100.0), "none.db");
}

TEST(DesignsTried, AreJudgedByDrawsOfWhatScattersNotByErrorsAtTheirMedianWhichIsZero) {
  const auto mechanism = hexapod();
  const MatchingPlan mean = plan(*mechanism, "mean", "20 um");
  for (const Parameters& motion : median_motions(mean, *mechanism)) EXPECT_FALSE(has_errors(motion));
  const DesignsTried tried = designs_tried(mean, *mechanism, 100.0);
  ASSERT_EQ(tried.samples.size(), 3u);  // the middle and two corners
  for (const std::vector<Parameters>& samples : tried.samples)
    for (const Parameters& sample : samples) EXPECT_TRUE(has_errors(sample));
  EXPECT_EQ(tried.samples[1][0].gravity.z(), -10.0);
  EXPECT_EQ(tried.samples[2][0].gravity.z(), -9.0);
  // The same draws for every design, as the search has it.
  EXPECT_EQ(tried.samples[1][7].error, tried.samples[2][7].error);
  EXPECT_EQ(tried.runs, 5000u);
}

TEST(DesignsTried, AskOfTheScatterWhatTheObjectiveAsks) {
  const auto mechanism = hexapod();
  EXPECT_EQ(designs_tried(plan(*mechanism, "mean", "20 um"), *mechanism, 1.0).statistic->probability, 0.0);
  EXPECT_EQ(designs_tried(plan(*mechanism, "quantile", "20 um"), *mechanism, 1.0).statistic->probability, 0.95);
  EXPECT_NEAR(designs_tried(plan(*mechanism, "worst", "20 um"), *mechanism, 1.0).statistic->probability, 0.98, 1e-15);
  const DesignsTried nominal = designs_tried(plan(*mechanism, "nominal", ""), *mechanism, 1.0);
  EXPECT_FALSE(nominal.statistic);  // motions, each by itself
  EXPECT_EQ(nominal.samples[0].size(), 1u);
}

TEST(DesignsTried, HaveAPilotFlownOfStandingErrorsWithoutPlay) {
  const auto mechanism = hexapod();
  const RungChoice small = choice_of(mechanism, plan(*mechanism, "mean", "20 um"));
  ASSERT_TRUE(small.pilot) << small.why;
  EXPECT_EQ(small.name, "quasistatic") << small.why;
  EXPECT_TRUE(small.pilot->met);
}

// As lanes judge them: the paper's mechanism took multibody, at a hundred times the cost.
TEST(DesignsTried, HaveLanesTriedWhereTheseJudgeThem) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml", {{"motion.duration", "100 ms"}}));
  const auto plan_of = [&](const std::string& more) {
    Document document = Document::from_text(
        "[match]\nminimise = \"free_flight_share\"\nover = \"mean\"\nsamples = 48\n" + more +
            "[[match.variable]]\nparameter = \"payload.mass\"\nfrom = \"0 kg\"\nto = \"150 kg\"\n[[random]]\nparameter "
            "= "
            "\"clearance.F1.contact.restitution\"\ndistribution = { uniform = { min = 0.85, max = 0.95 } }\n",
        "study.toml");
    Cursor root(document);
    return read_matching_plan(root, Study{}, mechanism->description(), [](const Setting&) {});
  };
  const MatchingPlan flights = plan_of("");
  ASSERT_TRUE(designs_tried(flights, *mechanism, 85.0).lanes);
  const StudyRun run(mechanism, {.accuracy = 0.03, .index = {"position_error", "max"}});
  const RungChoice choice = run.rung_of_designs(designs_tried(flights, *mechanism, 85.0), "none.db");
  ASSERT_TRUE(choice.pilot) << choice.why;
  EXPECT_EQ(choice.name, "perturbation") << choice.why;
  EXPECT_TRUE(choice.pilot->trials[choice.pilot->chosen].lanes);
  EXPECT_FALSE(
      designs_tried(
          plan_of("[[match.constraint]]\nmeasure = \"peak_acceleration\"\nover = \"mean\"\nat_most = \"100 m/s^2\"\n"),
          *mechanism, 85.0)
          .lanes)
      << "lanes say no accelerations";
}

TEST(DesignsTried, TakeTheRungThatTheDesignWhichAsksForMostNeeds) {
  const auto mechanism = hexapod();
  // One leg is as drawn at one corner of the box and wrong by a fiftieth of its length at the other.
  const RungChoice choice = choice_of(
      mechanism,
      plan(*mechanism, "mean", "20 um", "parameter = \"error.leg3a.length\"\nfrom = \"0 mm\"\nto = \"12 mm\"\n"));
  EXPECT_EQ(choice.name, "multibody") << choice.why;
  EXPECT_THAT(choice.why, testing::HasSubstr("asks for most, of 3 tried"));
}

}  // namespace designs_tried_test
}  // namespace boresight
