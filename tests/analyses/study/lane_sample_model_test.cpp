// What lanes state of their own model where standing errors displace the pose by far more than the play does.
#include "boresight_analyses/study/lane_sample_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace lane_sample_model_test {

// The mechanism of a file with its lengths off by so much, in turns to either side; joints without errors of their own get them.
struct Built {
  std::shared_ptr<const Mechanism> mechanism;
  Parameters parameters;

  Built(const std::string& file, const std::string& duration, double length) {
    mechanism = scenes::build(scenes::with_joints_off(
        read_mechanism(BORESIGHT_EXAMPLES "/" + file, {{"motion.duration", duration}}), length));
    parameters = mechanism->parameters();
  }
  Outcome by_lanes() const {
    const LaneSampleModel model(
        mechanism, [this](std::span<const double>) { return parameters; }, {"position_error", "max"}, false);
    const Sample sample{.number = 0, .values = {}};
    Outcome outcome;
    model.evaluate({&sample, 1}, {&outcome, 1}, std::atomic<bool>{false});
    return outcome;
  }
  double exactly() const {
    RunOptions options;
    options.sample_spacing = 0.0;
    options.events = false;
    return make_rung("multibody", mechanism)->run(parameters, options).index.position_error.max;
  }
};

class LargeErrors : public testing::TestWithParam<std::pair<const char*, const char*>> {};

// Errors magnify no offset: that the whole deviation is many times the gap says nothing of the play.
TEST_P(LargeErrors, AreNotTakenForPlayThatTheMechanismMagnifies) {
  const Built built(GetParam().first, GetParam().second, 1e-3);
  const Outcome found = built.by_lanes();
  ASSERT_EQ(found.status, Outcome::Status::done) << found.message;
  const double off = std::abs(found.value / built.exactly() - 1.0);
  EXPECT_GE(found.model_error, off);
  EXPECT_LT(found.model_error, 0.1) << off;
}

INSTANTIATE_TEST_SUITE_P(Lanes, LargeErrors,
                         testing::Values(std::pair{"3-rrcpr/tolerances.toml", "10 ms"},
                                         std::pair{"crank-slider/crank-slider.toml", "20 ms"},
                                         std::pair{"four-bar/four-bar.toml", "20 ms"}));

// Where rods push what they should only guide, the deviation's size says little of what linear dynamics miss.
TEST(LaneSampleModel, StatesNoLessThanTheRungDoesOfTheMotionOfTheFile) {
  const std::pair<const char*, const char*> scenes[] = {{"spatial-slider-crank/spatial-slider-crank.toml", "50 ms"},
                                                        {"flores-slider-crank/flores-slider-crank.toml", "24 ms"}};
  for (const auto& [file, duration] : scenes) {
    const auto mechanism = std::make_shared<const Mechanism>(
        read_mechanism(std::string(BORESIGHT_EXAMPLES "/") + file, {{"motion.duration", duration}}));
    RunOptions options;
    options.sample_spacing = 0.0;
    options.events = false;
    options.integrator = "rosenbrock";
    const PointingIndices truth = make_rung("multibody", mechanism)->run(mechanism->parameters(), options).index;
    for (const char* statistic : {"max", "rms"}) {
      const IndexChoice index{"position_error", statistic};
      const LaneSampleModel model(
          mechanism, [&](std::span<const double>) { return mechanism->parameters(); }, index, false);
      const Sample sample{.number = 0, .values = {}};
      Outcome outcome;
      model.evaluate({&sample, 1}, {&outcome, 1}, std::atomic<bool>{false});
      EXPECT_GE(outcome.model_error, std::abs(outcome.value / index.of(truth) - 1.0)) << file << " " << statistic;
    }
  }
}

// Without errors all of the deviation is the play's.
TEST(LaneSampleModel, StatesOfPlayAloneItsShareOfTheMechanismTimesWhatMagnifiesIt) {
  const Built built("crank-slider/crank-slider.toml", "20 ms", 0.0);
  const Outcome found = built.by_lanes();
  ASSERT_EQ(found.status, Outcome::Status::done) << found.message;
  const double share = found.value / built.mechanism->characteristic_length();
  EXPECT_GE(found.model_error, share);
  EXPECT_LT(found.model_error, 10.0 * share);
}

}  // namespace lane_sample_model_test
}  // namespace boresight
