// The pilot on scenes that ask for different rungs.
#include "boresight_analyses/study/pilot.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/study/measurement.hpp"
#include "boresight_analyses/study/pilot_choice.hpp"
#include "boresight_analyses/study/rung_choice.hpp"

namespace boresight {
namespace pilot_test {

std::shared_ptr<const Mechanism> rrcpr(std::vector<Setting> settings) {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml", settings));
}

const PilotTrial& chosen(const PilotResult& result) { return result.trials[result.chosen]; }

PilotResult fly(const std::shared_ptr<const Mechanism>& mechanism, double accuracy, const IndexChoice& index) {
  PilotOptions options;
  options.accuracy = accuracy;
  options.index = index;
  return run_pilot(mechanism, {mechanism->parameters()}, options);
}

TEST(Pilot, TakesTheCheapestRungThatMeetsTheAccuracy) {
  const auto mechanism = rrcpr({{"motion.duration", "0.3 s"}});
  const PilotResult rough = fly(mechanism, 0.10, {"position_error", "rms"});
  EXPECT_TRUE(rough.met);
  // Which of the two that take no steps is cheaper, is a matter of the moment.
  EXPECT_TRUE(chosen(rough).rung == "quasistatic" || chosen(rough).rung == "envelope") << chosen(rough).rung;
  for (const PilotTrial& t : rough.trials)
    EXPECT_TRUE(!t.accepted || t.cpu_seconds >= chosen(rough).cpu_seconds) << t.rung;
  const PilotResult fine = fly(mechanism, 0.02, {"position_error", "rms"});
  EXPECT_TRUE(fine.met);
  EXPECT_EQ(chosen(fine).rung, "perturbation");
  EXPECT_LE(chosen(fine).error, 0.02);
  EXPECT_NE(fine.why.find("cheapest"), std::string::npos);
}

TEST(Pilot, TriesIntegratorsWithErrorControlWhereItIsAskedTo) {
  const auto mechanism = rrcpr({{"motion.duration", "0.1 s"}});
  RungQuestion question{.asked = "auto", .accuracy = 0.002, .index = {"position_error", "rms"}};
  for (bool integrators : {false, true}) {
    question.integrators = integrators;
    const RungChoice choice = choose_rung(question, mechanism, {mechanism->parameters()});
    ASSERT_TRUE(choice.pilot);
    bool tried = false;
    for (const PilotTrial& t : choice.pilot->trials) tried = tried || !t.integrator.empty();
    EXPECT_EQ(tried, integrators);
    // What is handed on is what was measured.
    RunOptions options;
    apply(choice, options);
    EXPECT_EQ(options.step, chosen(*choice.pilot).step);
    EXPECT_EQ(options.integrator, chosen(*choice.pilot).integrator);
    EXPECT_EQ(options.tolerance, chosen(*choice.pilot).tolerance);
    for (const PilotTrial& t : choice.pilot->trials)
      EXPECT_TRUE(!t.accepted || t.cpu_seconds >= chosen(*choice.pilot).cpu_seconds) << t.rung;
  }
}

TEST(Pilot, ClimbsWhereClearanceIsLarge) {
  // A gap of a hundredth of the lengths, and of small contact stiffness: the deviation is no longer small.
  const auto mechanism = rrcpr({{"motion.duration", "0.15 s"},
                                {"clearance.F1.radial", "8 mm"},
                                {"clearance.F1.cap_radius", "25 mm"},
                                {"clearance.F1.axial", "8 mm"}});
  const PilotResult result = fly(mechanism, 0.005, {"position_error", "max"});
  EXPECT_EQ(chosen(result).rung, "multibody");
  bool perturbation_failed = false;
  for (const PilotTrial& trial : result.trials)
    perturbation_failed = perturbation_failed || (trial.rung == "perturbation" && !trial.accepted);
  EXPECT_TRUE(perturbation_failed);
}

// By the deviation within the groups of three neighbours each at multibody's own step and at half of it: four degrees of freedom.
TEST(Pilot, SaysByHowMuchSingleMotionsScatterWithinTheirGroups) {
  const auto mechanism = rrcpr({{"motion.duration", "0.1 s"}});
  const IndexChoice index{"position_error", "max"};
  const PilotResult result = fly(mechanism, 0.9, index);  // an accuracy that three neighbours show
  const auto multibody = make_rung("multibody", mechanism);
  MeasureOptions options;
  options.index = index;
  RungSetup setup{.rung = "multibody"};
  double squares = 0.0, mean = 0.0;
  for (int group = 0; group < 2; ++group) {
    const Measurement m = measure(*multibody, mechanism->parameters(), setup, options);
    ASSERT_EQ(m.values.size(), 3u);
    ASSERT_EQ(m.integrator, "");
    mean = (m.values[0] + m.values[1] + m.values[2]) / 3.0;
    for (const double v : m.values) squares += (v - mean) * (v - mean);
    setup.step = 0.5 * m.step;
  }
  ASSERT_GT(squares, 0.0);
  EXPECT_NEAR(result.scatter, std::sqrt(squares / 4.0) / mean, 1e-9 * result.scatter);
}

TEST(Pilot, PassesOverRungsThatCannotFollowTheMotion) {
  // Nothing drives the crank: there is no rest, and the cheap rungs say so.
  MechanismDescription d = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml",
                                          {{"motion.duration", "0.03 s"}});
  for (JointDescription& j : d.joints) j.driven = false;
  d.motion.drives.clear();
  d.initial_rates.push_back({0, InitialRateDescription::Freedom::angle, 30.0, {}});
  const auto mechanism = std::make_shared<const Mechanism>(std::move(d));
  const PilotResult result = fly(mechanism, 0.05, {"position_error", "rms"});
  ASSERT_GE(result.trials.size(), 4u);
  EXPECT_TRUE(result.trials[0].reference);
  EXPECT_FALSE(result.trials[1].refusal.empty());
  EXPECT_FALSE(result.trials[2].refusal.empty());
  EXPECT_TRUE(chosen(result).rung == "perturbation" || chosen(result).rung == "multibody");
}

TEST(Pilot, SaysWhereTheReferenceItselfIsWorseThanTheAccuracy) {
  // Impacts make this motion one of many: neighbouring steps of multibody differ by tenths of a percent.
  const auto mechanism = rrcpr({{"motion.duration", "0.2 s"}});
  const PilotResult result = fly(mechanism, 5e-4, {"position_error", "max"});
  EXPECT_GT(result.reference_error, 5e-4);
  EXPECT_FALSE(result.met);
  for (const PilotTrial& t : result.trials) EXPECT_FALSE(t.accepted) << t.rung;
  EXPECT_NE(result.why.find("cannot be shown"), std::string::npos) << result.why;
  // Nothing is told from multibody there, so nothing as dear as it is taken.
  EXPECT_EQ(chosen(result).rung, "perturbation");
}

// Clearance, restitution and friction as the default study scatters them, by a net of fractions.
std::vector<Parameters> scattered(const Mechanism& mechanism, int count, double largest = 1.0) {
  std::vector<Parameters> samples;
  for (int k = 0; k < count; ++k) {
    const auto fraction = [k](double irrational) { return std::fmod(0.5 + k * irrational, 1.0); };
    Parameters p = mechanism.parameters();
    p.clearance[0].radial *= largest * (0.8 + 0.4 * fraction(0.754877666));
    p.clearance[0].contact.restitution = 0.7 + 0.25 * fraction(0.569840291);
    samples.push_back(p);
  }
  return samples;
}

PilotOptions of_scatter(double accuracy, ScatterStatistic statistic) {
  PilotOptions options;
  options.accuracy = accuracy;
  options.index = {"position_error", "max"};
  options.statistic = statistic;
  options.lanes = options.integrators = true;
  options.scene_varies = false;
  options.runs = 2000;
  return options;
}

TEST(PilotOfScatter, TakesLanesWhereTheyAnswerWhatTheStudyAsks) {
  const auto mechanism = rrcpr({{"motion.duration", "0.1 s"}});
  for (const double p : {0.0, 0.95}) {
    const PilotResult result = run_pilot(mechanism, scattered(*mechanism, 256), of_scatter(0.03, {p}));
    EXPECT_TRUE(result.met) << result.why;
    EXPECT_EQ(chosen(result).rung, "perturbation") << result.why;
    EXPECT_TRUE(chosen(result).lanes);
    EXPECT_GE(result.pairs, 6u);
    EXPECT_LE(chosen(result).error, 0.03);
    EXPECT_EQ(result.errors.size(), 6u);
    // What is stated holds what the reference is off by itself.
    EXPECT_GE(result.errors.back().error, result.reference_error);
    RungChoice choice{.name = chosen(result).rung, .why = "", .tolerance = chosen(result).tolerance};
    RunOptions run;
    apply(choice, run);
    EXPECT_EQ(run.tolerance, chosen(result).tolerance);
  }
}

// Perturbation chooses RODAS by itself, and has no step that all samples could take: it was passed over without a word, and multibody taken.
TEST(PilotOfScatter, TriesEveryRungWhateverItMayChoose) {
  const auto mechanism = rrcpr({{"motion.duration", "0.1 s"}});
  for (const bool lanes : {false, true})
    for (const bool integrators : {false, true}) {
      PilotOptions options = of_scatter(0.03, {});
      options.lanes = lanes;
      options.integrators = integrators;
      const PilotResult result = run_pilot(mechanism, scattered(*mechanism, 64), options);
      std::vector<std::string> tried;
      for (const PilotTrial& trial : result.trials) tried.push_back(trial.rung);
      for (const char* rung : {"envelope", "quasistatic", "perturbation"})
        EXPECT_THAT(tried, testing::Contains(rung)) << lanes << integrators;
      EXPECT_EQ(chosen(result).rung, "perturbation") << result.why;
    }
}

TEST(PilotOfScatter, ClimbsWhereClearanceIsLarge) {
  const auto mechanism = rrcpr({{"motion.duration", "0.1 s"},
                                {"clearance.F1.radial", "8 mm"},
                                {"clearance.F1.cap_radius", "25 mm"},
                                {"clearance.F1.axial", "8 mm"}});
  const PilotResult result = run_pilot(mechanism, scattered(*mechanism, 64), of_scatter(0.005, {}));
  EXPECT_EQ(chosen(result).rung, "multibody") << result.why;
}

TEST(PilotOfScatter, AnswersTheSameOnAnyNumberOfThreads) {
  const auto mechanism = rrcpr({{"motion.duration", "30 ms"}});
  PilotOptions options = of_scatter(0.05, {0.95});
  const PilotResult one = run_pilot(mechanism, scattered(*mechanism, 64), options);
  options.jobs = 3;
  const PilotResult three = run_pilot(mechanism, scattered(*mechanism, 64), options);
  EXPECT_EQ(one.reference, three.reference);
  EXPECT_EQ(one.reference_error, three.reference_error);
  EXPECT_EQ(one.pairs, three.pairs);
}

TEST(RungChoice, AsksNoPilotWhereThereIsNothingToChoose) {
  const auto mechanism = rrcpr({{"motion.duration", "0.1 s"}});
  EXPECT_EQ(choose_rung({.asked = "auto"}, mechanism, {mechanism->parameters()}).name, "multibody");
  EXPECT_EQ(choose_rung({.asked = "envelope"}, mechanism, {mechanism->parameters()}).name, "envelope");
  EXPECT_EQ(choose_rung({.asked = "envelope"}, mechanism, {}).why, "asked for by name");
  EXPECT_EQ(choose_rung({.asked = "envelope", .accuracy = 0.01}, mechanism, {}).why,
            "asked for by name: no pilot has compared it with multibody, to hold it against the 1 % asked for");
  EXPECT_EQ(
      choose_rung({.asked = "auto", .accuracy = 0.01, .wants_multibody = true}, mechanism, {mechanism->parameters()})
          .name,
      "multibody");
}

TEST(Pilot, SaysInWordsWhatItMeasured) {
  PilotResult result;
  result.accuracy = 0.01;
  result.index = "position error, RMS";
  result.reference_error = 0.002;
  PilotTrial cheap, dear;
  cheap.rung = "quasistatic";
  cheap.error = 0.2;
  cheap.cpu_seconds = 1.0;
  dear.rung = "perturbation";
  dear.error = 0.0035;
  dear.cpu_seconds = 2.0;
  dear.accepted = true;
  result.trials = {cheap, dear};
  conclude(result);
  EXPECT_EQ(chosen(result).rung, "perturbation");
  EXPECT_EQ(result.why,
            "the cheapest that comes within 1 % of multibody in the position error, RMS: off by 0.35 % at most "
            "(reference good to 0.2 %)");
  result.pairs = 24;
  conclude(result);
  EXPECT_NE(result.why.find("off by 0.35 % at most over 24 paired samples (reference"), std::string::npos)
      << result.why;
  result.trials[1].accepted = false;
  conclude(result);
  EXPECT_EQ(result.why.rfind("none is shown to come within 1 % of multibody", 0), 0u) << result.why;
  // Of an index that is next to nothing.
  result.trials[1].error = 3e9;
  result.trials[0].error = 4e9;
  result.reference_error = 2e8;
  conclude(result);
  EXPECT_NE(result.why.find("good to over 10000 times the value itself only"), std::string::npos) << result.why;
}

TEST(Pilot, SaysWhatSingleMotionsScatterByWhereThatIsWhyNothingCanBeShown) {
  PilotResult result;
  result.accuracy = 0.01;
  result.index = "position error, maximum";
  result.reference_error = 0.05;
  result.scatter = 0.034;
  PilotTrial trial;
  trial.rung = "perturbation";
  trial.error = 0.3;
  trial.difference = 0.25;
  result.trials = {trial};
  conclude(result);
  const std::string scattered = "; single motions scatter by 3.4 %, standard deviation";
  EXPECT_EQ(result.why,
            "an accuracy of 1 % cannot be shown: multibody itself is good to 5 % only in the position error, maximum" +
                scattered + "; this one comes nearest");
  result.pairs = 12;  // pairs scatter less: what single motions do is not the reason
  conclude(result);
  EXPECT_EQ(result.why.find(scattered), std::string::npos) << result.why;
  result.pairs = 0;
  result.scatter = 0.0005;
  conclude(result);
  EXPECT_EQ(result.why.find("single motions"), std::string::npos) << result.why;
}

// What is clear from the first pairs is not asked of more of them.
TEST(PilotOfScatter, TakesNoMorePairsThanTheAnswerNeeds) {
  const auto mechanism = rrcpr({{"motion.duration", "20 ms"}});
  const PilotResult result = run_pilot(mechanism, scattered(*mechanism, 64), of_scatter(0.5, {}));
  EXPECT_TRUE(result.met) << result.why;
  EXPECT_EQ(result.pairs, 6u);
}

TEST(PilotOfScatter, CountsItsRunsFromNone) {
  const auto mechanism = rrcpr({{"motion.duration", "20 ms"}});
  PilotOptions options = of_scatter(0.05, {0.95});
  std::vector<int> told;
  options.progress = [&](int runs) {
    told.push_back(runs);
    return told.size() < 3;
  };
  EXPECT_THROW(run_pilot(mechanism, scattered(*mechanism, 16), options), PilotInterrupted);
  EXPECT_EQ(told, (std::vector<int>{0, 1, 2}));
}

}  // namespace pilot_test
}  // namespace boresight
