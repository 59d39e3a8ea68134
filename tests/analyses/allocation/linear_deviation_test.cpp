// The deviation of gaps that a scene has, beside runs of the rung that it was taken from.
#include "boresight_analyses/allocation/linear_deviation.hpp"

#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"

namespace boresight {
namespace linear_deviation_test {

// The crank-slider with a target for its line of sight.
std::shared_ptr<const Mechanism> crank_slider() {
  MechanismDescription d = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml",
                                          {{"motion.duration", "0.1 s"}});
  for (const BodyDescription& b : d.bodies)
    if (b.boresight)
      d.line_of_sight = LineOfSightDescription{.from = b.center_of_mass, .target = Vec3(0.0, 3.0, 1.0), .origin = {}};
  return std::make_shared<const Mechanism>(std::move(d));
}

// Gaps of a fifth and of 1.7 times those that it was taken at, where it has not been tried.
TEST(LinearDeviation, FoundOnASceneIsItsQuasistaticRungForEveryQuantityAndGap) {
  const auto mechanism = crank_slider();
  const ParameterPath place(mechanism->description(), "clearance.A.radial");
  const double nominal = place.get(mechanism->parameters());
  constexpr std::size_t kInstants = 400;
  // Second order of the gap over the lengths, how far the contact gives way, which hangs on the gap a little,
  // and instants that fall beside the largest.
  constexpr double kClose = 0.01;
  for (const char* quantity : {"position_error", "orientation_error", "boresight_error", "line_of_sight_error"})
    for (const char* statistic : {"max", "rms"}) {
      const IndexChoice index{quantity, statistic};
      double misfit = -1.0;
      const LinearDeviation found = find_linear_deviation(mechanism, {{place}}, {nominal}, index, kInstants, misfit);
      EXPECT_GE(misfit, 0.0);
      EXPECT_LT(misfit, kClose) << quantity << ' ' << statistic;
      RunOptions options;
      options.events = false;
      options.sample_spacing = mechanism->duration() / kInstants;
      for (const double share : {0.2, 1.7}) {
        Parameters parameters = mechanism->parameters();
        place.set(parameters, share * nominal);
        const double truth = index.of(make_rung("quasistatic", mechanism)->run(parameters, options).index);
        ASSERT_GT(truth, 0.0) << quantity;
        EXPECT_NEAR(found.index(std::vector<double>{share * nominal}) / truth, 1.0, kClose)
            << quantity << ' ' << statistic << ' ' << share;
      }
    }
}

}  // namespace linear_deviation_test
}  // namespace boresight
