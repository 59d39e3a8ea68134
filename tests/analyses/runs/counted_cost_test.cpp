// What samples cost by count, from the table that the header prints.
#include "boresight_analyses/runs/counted_cost.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/runs/scene_cost.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"

namespace boresight {
namespace counted_cost_test {

std::shared_ptr<const Mechanism> scene() {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml", {{"motion.duration", "20 ms"}}));
}

TEST(CountedCost, OfAnEvaluationIsTheTablesForBodiesAndClearances) {
  const auto microseconds = [](const char* rung, bool lanes, std::size_t bodies, std::size_t clearances) {
    return 1e6 * nominal_seconds_an_evaluation(rung, lanes, bodies, clearances);
  };
  EXPECT_NEAR(microseconds("envelope", false, 7, 3), 15.0, 1e-9);
  EXPECT_NEAR(microseconds("quasistatic", false, 7, 3), 3.0, 1e-9);
  EXPECT_NEAR(microseconds("perturbation", false, 7, 3), 0.84 + 0.96, 1e-9);
  EXPECT_NEAR(microseconds("perturbation", true, 7, 3), 0.45, 1e-9);
  EXPECT_NEAR(microseconds("multibody", false, 7, 3), 2.1 + 2.7, 1e-9);
  // A mechanism without clearances costs as one with one.
  EXPECT_NEAR(microseconds("multibody", false, 7, 0), 2.1 + 0.9, 1e-9);
  EXPECT_THROW(nominal_seconds_an_evaluation("static", false, 1, 1), std::invalid_argument);
}

// The scene of a sample: shared where contacts scatter, tables of its own where masses do, a whole one where these lie elsewhere.
TEST(CountedCost, OfASceneIsThatOfWhatASampleHasToPrepare) {
  const auto mechanism = scene();
  const auto microseconds = [&](const char* rung, bool lanes, const std::function<void(Parameters&, double)>& set) {
    std::vector<Parameters> samples(3, mechanism->parameters());
    for (std::size_t k = 0; k < samples.size(); ++k) set(samples[k], 1.0 + static_cast<double>(k));
    return 1e6 * counted_scene_cost(rung, lanes, *mechanism, samples);
  };
  const auto radial = [](Parameters& p, double k) { p.clearance[0].radial = 5e-5 * k; };
  const auto mass = [](Parameters& p, double k) { p.payload_mass = 100.0 * k; };
  const auto center = [](Parameters& p, double k) { p.payload_center.x() += 1e-3 * k; };
  for (const bool lanes : {false, true}) {
    EXPECT_EQ(microseconds("perturbation", lanes, radial), 0.0);
    const double of_mass = microseconds("perturbation", lanes, mass);
    EXPECT_GT(of_mass, 50.0);
    EXPECT_GT(microseconds("perturbation", lanes, center), 2.0 * of_mass);
  }
  EXPECT_GT(microseconds("quasistatic", false, mass), 50.0);
  // Whose drives tell all of the ideal motion.
  EXPECT_EQ(microseconds("multibody", false, mass), 0.0);
}

// Of two scatters that are followed alike, the one that has each scene prepared anew is counted dearer; and always the same.
TEST(CountedCost, OfASampleHasItsSceneInIt) {
  const auto mechanism = scene();
  const auto counted = [&](const char* path) {
    RandomParameter p;
    p.paths = {path};
    p.places = {ParameterPath(mechanism->description(), path)};
    const double middle = path == std::string("payload.mass") ? 200.0 : p.places.front().get(mechanism->parameters());
    p.distribution = make_uniform(0.9 * middle, 1.1 * middle);
    RandomInputs inputs;
    inputs.parameters.push_back(p);
    const auto model = sample_model(
        "perturbation", mechanism,
        [&](std::span<const double> values) { return inputs.parameters_with(*mechanism, values); },
        {"position_error", "max"}, {}, scene_varies(inputs));
    return counted_cost(*model, *mechanism, inputs, SamplingDesign({}, 1));
  };
  const double of_mass = counted("payload.mass");
  EXPECT_GT(of_mass, 2.0 * counted("clearance.F1.radial"));
  EXPECT_EQ(counted("payload.mass"), of_mass);
}

}  // namespace counted_cost_test
}  // namespace boresight
