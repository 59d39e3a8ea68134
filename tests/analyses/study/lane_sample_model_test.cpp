// What lanes state of their own model where standing errors displace the pose by far more than the play does; what each sample of a batch
// is said to have taken.
#include "boresight_analyses/study/lane_sample_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/rungs/cpu_clock.hpp"
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

// Of 32 samples of one batch: scenes of their own, where masses scatter, are all prepared before the first motion ends.
TEST(LaneSampleModel, SharesAmongSamplesWhatTheirBatchSpent) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml", {{"motion.duration", "50 ms"}}));
  for (const bool scene_varies : {false, true}) {
    const LaneSampleModel model(
        mechanism,
        [&](std::span<const double> values) {
          Parameters p = mechanism->parameters();
          p.clearance[0].radial = values[0];
          if (scene_varies) p.payload_mass = 1e5 * values[0];
          return p;
        },
        {"position_error", "max"}, scene_varies);
    std::vector<double> radial(32);
    std::vector<Sample> samples;
    for (double& value : radial) {
      value = 1e-4 + 2e-6 * static_cast<double>(samples.size());
      samples.push_back({samples.size(), {&value, 1}});
    }
    const std::atomic<bool> stop{false};
    Outcome first;
    model.evaluate({samples.data(), 1}, {&first, 1}, stop);  // what is looked at once for all
    std::vector<Outcome> outcomes(samples.size());
    const double start = thread_cpu_seconds();
    model.evaluate(samples, outcomes, stop);
    const double spent = thread_cpu_seconds() - start;
    double sum = 0.0, most = 0.0;
    for (const Outcome& outcome : outcomes) {
      ASSERT_EQ(outcome.status, Outcome::Status::done) << outcome.message;
      sum += outcome.cpu_seconds;
      most = std::max(most, outcome.cpu_seconds);
    }
    EXPECT_NEAR(sum, spent, 0.2 * spent) << scene_varies;
    EXPECT_LT(most, 0.25 * spent) << scene_varies;
  }
}

}  // namespace lane_sample_model_test
}  // namespace boresight
