// The pilot where no joint has play: what is linear in the errors is taken as far as it holds, and no further.
#include <gtest/gtest.h>

#include <cmath>

#include "bearing_pair_scenes.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/setup_samples.hpp"
#include "boresight_analyses/study/study_error.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace pilot_of_geometry_test {

// A quarter of its motion: what its errors add up to shows in that as well.
std::shared_ptr<const Mechanism> hexapod(const std::vector<Setting>& settings = {{"motion.duration", "0.5 s"}}) {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/hexapod/hexapod.toml", settings));
}

// Its 42 dimensions within +- size [m], by a net of fractions.
std::vector<Parameters> scattered(const Mechanism& mechanism, int first, int count, double size) {
  std::vector<Parameters> samples;
  for (int k = first; k < first + count; ++k) {
    Parameters p = mechanism.parameters();
    for (std::size_t e = 0; e < p.error.size(); ++e)
      p.error[e] = size * (2.0 * std::fmod(0.5 + k * std::sqrt(2.0 + static_cast<double>(e)), 1.0) - 1.0);
    samples.push_back(p);
  }
  return samples;
}

RungQuestion asked(double accuracy, std::optional<ScatterStatistic> statistic) {
  return {.accuracy = accuracy, .index = {"boresight_error", "max"}, .lanes = true, .statistic = statistic};
}

const IndexChoice kIndex = {"boresight_error", "max"};

TEST(PilotOfGeometry, AddsSmallErrorsUpAndIsAsAccurateOnOtherSamplesAsItSays) {
  const auto mechanism = hexapod();
  const double accuracy = 0.002;
  const std::vector<Parameters> fresh = scattered(*mechanism, 1000, 40, 20e-6);
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < fresh.size(); ++k) all.push_back(k);
  SetupSamples exact(mechanism, fresh, {.rung = "multibody"}, kIndex, false);
  exact.compute(all, 1, {});
  for (const double probability : {0.0, 0.95}) {
    const RungChoice choice =
        choose_rung(asked(accuracy, ScatterStatistic{probability}), mechanism, scattered(*mechanism, 0, 256, 20e-6));
    ASSERT_TRUE(choice.pilot);
    EXPECT_EQ(choice.name, "quasistatic");
    EXPECT_TRUE(choice.pilot->met);
    EXPECT_NE(choice.why.find("linear"), std::string::npos) << choice.why;
    const PilotTrial& chosen = choice.pilot->trials[choice.pilot->chosen];
    EXPECT_GT(chosen.error, 0.0);

    SetupSamples linear(mechanism, fresh, {.rung = choice.name}, kIndex, false);
    linear.compute(all, 1, {});
    const ScatterDifference found = compare_scatter(linear.values(all), exact.values(all), {}, {probability});
    EXPECT_LE(std::abs(found.difference), accuracy);
    EXPECT_LT(10.0 * chosen.cpu_seconds, exact.cpu_seconds());
  }
}

TEST(PilotOfGeometry, ClosesTheJointsExactlyWhereErrorsAreTooLargeToAddUpAndSaysSo) {
  const auto mechanism = hexapod();
  // A hundredth of the legs' lengths.
  const RungChoice choice =
      choose_rung(asked(0.002, ScatterStatistic{0.95}), mechanism, scattered(*mechanism, 0, 64, 6e-3));
  ASSERT_TRUE(choice.pilot);
  EXPECT_EQ(choice.name, "multibody");
  EXPECT_TRUE(choice.pilot->met);
  EXPECT_NE(choice.why.find("do not just add up"), std::string::npos) << choice.why;
  const PilotTrial& linear = choice.pilot->trials.front();
  EXPECT_FALSE(linear.accepted);
  EXPECT_GT(std::abs(linear.difference), 0.002);
}

TEST(PilotOfGeometry, CountsTheSamplesWhoseJointsDoNotClose) {
  const auto mechanism = hexapod();
  // A tenth of the legs' lengths: some of the built mechanisms cannot follow their drives.
  const RungChoice choice =
      choose_rung(asked(0.5, ScatterStatistic{0.95}), mechanism, scattered(*mechanism, 0, 64, 60e-3));
  EXPECT_EQ(choice.name, "multibody");
  EXPECT_NE(choice.why.find("do not close in"), std::string::npos) << choice.why;
}

TEST(PilotOfGeometry, HoldsEachMotionByItselfWhereThatIsAsked) {
  const auto mechanism = hexapod();
  std::vector<Parameters> motions = scattered(*mechanism, 0, 3, 20e-6);
  motions.push_back(mechanism->parameters());  // no errors: nothing to be off by
  const RungChoice small = choose_rung(asked(0.002, {}), mechanism, motions);
  EXPECT_EQ(small.name, "quasistatic") << small.why;
  EXPECT_EQ(small.pilot->pairs, 0u);
  motions.push_back(scattered(*mechanism, 3, 1, 6e-3).front());  // one that is not like the others
  const RungChoice large = choose_rung(asked(0.002, {}), mechanism, motions);
  EXPECT_EQ(large.name, "multibody") << large.why;
}

TEST(PilotOfGeometry, SpeaksOfNoImpactsAndOfNoSteps) {
  const auto mechanism = hexapod();
  for (const double size : {20e-6, 6e-3}) {
    const RungChoice choice =
        choose_rung(asked(0.002, ScatterStatistic{0.95}), mechanism, scattered(*mechanism, 0, 64, size));
    EXPECT_TRUE(choice.pilot->geometry);
    for (const char* word : {"step", "impact", "flight", "clearance"})
      EXPECT_EQ(choice.why.find(word), std::string::npos) << choice.why;
    EXPECT_NE(choice.why.find("no joint has play"), std::string::npos) << choice.why;
  }
}

// Whatever the rung is called: runs at half a step were made, and the same numbers held against each other.
TEST(PilotOfGeometry, MeasuresNoStepsWherePosesTakeNone) {
  const auto mechanism = hexapod();
  for (const char* rung : {"quasistatic", "perturbation"}) {
    const StudyDiscretisation found =
        measure_study_discretisation(mechanism, scattered(*mechanism, 0, 8, 20e-6), {.rung = rung},
                                     {.index = kIndex, .statistic = {0.95}, .runs = 60});
    EXPECT_TRUE(found.measured);
    EXPECT_EQ(found.relative, 0.0);
    EXPECT_EQ(found.cpu_seconds, 0.0);
    EXPECT_NE(found.why.find("no steps"), std::string::npos) << found.why;
  }
}

TEST(PilotOfGeometry, LeavesTheChoiceAloneWhereNothingDeviates) {
  const auto mechanism = hexapod();
  const RungChoice choice =
      choose_rung(asked(0.01, ScatterStatistic{0.95}), mechanism, std::vector<Parameters>(8, mechanism->parameters()));
  EXPECT_FALSE(choice.pilot);
  EXPECT_NE(choice.why.find("no error is other than zero"), std::string::npos) << choice.why;
}

TEST(PilotOfGeometry, IsConfirmedOnTheOnlyRungThatIsNotLinearThere) {
  EXPECT_EQ(next_rung_up("quasistatic", *hexapod()), "multibody");
  EXPECT_EQ(next_rung_up("quasistatic", *scenes::build(scenes::rrcpr())), "perturbation");
}

TEST(PilotOfGeometry, NamesTheJointThatErrorsStrain) {
  // Two coaxial bearings without play hold one shaft: the seat of one of them sits beside its place, and nothing gives.
  MechanismDescription gimbal = scenes::gimbal({}, JournalAxes::parallel);
  gimbal.errors.push_back(
      scenes::frame_error(gimbal, ErrorDescription::Kind::translation, "E2", "tube", Vec3::UnitZ()));
  const auto mechanism = scenes::build(gimbal);
  std::vector<Parameters> samples(8, mechanism->parameters());
  for (std::size_t k = 0; k < samples.size(); ++k) samples[k].error[0] = 1e-5 * static_cast<double>(k + 1);
  try {
    choose_rung(asked(0.01, ScatterStatistic{0.95}), mechanism, samples);
    FAIL() << "a rung was found that strains no joint";
  } catch (const ComputationError& refused) {
    EXPECT_NE(std::string(refused.what()).find("E2"), std::string::npos) << refused.what();
  }
}

}  // namespace pilot_of_geometry_test
}  // namespace boresight
