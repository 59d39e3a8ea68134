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

// An antenna on two axes, with an error of what lies between them and one of the azimuth's zero.
std::shared_ptr<const Mechanism> antenna(const std::string& elevation, const std::string& duration) {
  return std::make_shared<const Mechanism>(read_mechanism_text(R"x(
format = 1
name = "antenna"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
body = [
  { name = "yoke", mass = "30 kg", center_of_mass = ["0 m", "0 m", "0.8 m"], inertia = ["8 kg m^2", "6 kg m^2", "6 kg m^2"] },
  { name = "tube", mass = "12 kg", center_of_mass = ["0 m", "0 m", "1.5 m"], inertia = ["4 kg m^2", "0.8 kg m^2", "4 kg m^2"], boresight = [0, 1, 0] },
]
joint = [
  { name = "azimuth", type = "revolute", connects = ["ground", "yoke"], point = ["0 m", "0 m", "0 m"], axis = [0, 0, -1], driven = true },
  { name = "elevation", type = "revolute", connects = ["yoke", "tube"], point = ["0 m", "0 m", "1.5 m"], axis = [1, 0, 0], driven = true },
]
error = [
  { name = "NPAE", joint = "elevation", body = "yoke", rotation = [0, 1, 0] },
  { name = "IA", drive = "azimuth" },
]
motion.drives.azimuth = "0.3*sin(2*pi*t)"
)x"
                                                               "motion.duration = \"" +
                                                                   duration + "\"\nmotion.drives.elevation = \"" +
                                                                   elevation + "\"\n",
                                                               "antenna.toml"));
}

// Each error alone and both, against the rung itself. Within an instant of 125 to a motion, or of two draws to each of its stretches.
void expect_followed(const std::shared_ptr<const Mechanism>& mechanism, const IndexChoice& index) {
  std::vector<std::vector<ParameterPath>> places;
  for (const char* path : {"error.NPAE", "error.IA"}) places.push_back({ParameterPath(mechanism->description(), path)});
  double misfit = 1.0;
  const LinearDeviation found = find_linear_deviation(mechanism, places, {1e-3, 1e-3}, index, 125, misfit);
  EXPECT_LT(misfit, 0.01) << index.title();
  for (const std::vector<double>& errors : {std::vector{1e-3, 0.0}, std::vector{0.0, 1e-3}, std::vector{1e-3, -2e-3}}) {
    Parameters parameters = mechanism->parameters();
    for (std::size_t j = 0; j < 2; ++j) places[j][0].set(parameters, errors[j]);
    RunOptions options;
    options.start = index.start;
    const double truth = index.of(make_rung("quasistatic", mechanism)->run(parameters, options).index);
    ASSERT_GT(truth, 1e-5);
    EXPECT_NEAR(found.index(errors) / truth, 1.0, 0.01) << index.title() << ' ' << errors[0] << ' ' << errors[1];
  }
}

TEST(LinearDeviation, CountsFromTheStartOfTheIndexOn) {
  for (const char* statistic : {"max", "rms", "mean"})
    expect_followed(antenna("1.2*(1 - t/2)^4", "2 s"), {"boresight_error", statistic, 1.0});
}

// 125 equal instants of 125 periods would all find it at the same angle.
TEST(LinearDeviation, MeetsAMotionThatTurnsBackAndForthAtAllItsAngles) {
  for (const char* statistic : {"max", "rms"})
    expect_followed(antenna("1.2*sin(2*pi*t)", "125 s"), {"boresight_error", statistic});
  for (const char* duration : {"250 s", "62.5 s"})
    expect_followed(antenna("1.2*sin(2*pi*t)", duration), {"boresight_error", "max"});
}
TEST(LinearDeviationNight, MeetsAMotionThatTurnsBackAndForthAtAllItsAngles) {
  for (const char* duration : {"250 s", "62.5 s"})
    expect_followed(antenna("1.2*sin(2*pi*t)", duration), {"boresight_error", "rms"});
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
