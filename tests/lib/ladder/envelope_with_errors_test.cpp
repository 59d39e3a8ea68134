// What the envelope states where standing errors displace the pose besides the play: it cannot know whether the play adds to them or takes from them.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace envelope_with_errors_test {

struct Scene {
  const char *file, *duration;
  double length;  // of each error, in turns to either side [m]
};
void PrintTo(const Scene& scene, std::ostream* out) {
  *out << scene.file << ", " << scene.duration << ", errors of " << 1e3 * scene.length << " mm";
}

class EnvelopeWithErrors : public testing::TestWithParam<Scene> {};

std::shared_ptr<const Mechanism> built(const Scene& scene) {
  const std::string file = std::string(BORESIGHT_EXAMPLES "/") + scene.file;
  return scenes::build(
      scenes::with_joints_off(read_mechanism(file, {{"motion.duration", scene.duration}}), scene.length));
}

TEST_P(EnvelopeWithErrors, StatesWhatItIsOffByWhicheverOfThemIsTheLarger) {
  const auto mechanism = built(GetParam());
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), options);
  const RunResult truth = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const double stated = bound.error.model_of(PointingQuantity::position_error);
  for (const auto statistic : {&Statistics::max, &Statistics::rms, &Statistics::mean}) {
    const double says = bound.index.position_error.*statistic, is = truth.index.position_error.*statistic;
    EXPECT_LE(std::abs(says - is), stated * says) << stated;
  }
  // Errors are known, and what the play adds is little beside large ones.
  if (GetParam().length >= 1e-3) {
    const double of_play = bound.error.of_play[0];
    EXPECT_LT(of_play, 0.3);
    EXPECT_LT(stated, 4.0 * of_play);
  }
}

INSTANTIATE_TEST_SUITE_P(Rungs, EnvelopeWithErrors,
                         testing::Values(Scene{"crank-slider/crank-slider.toml", "20 ms", 1e-5},
                                         Scene{"crank-slider/crank-slider.toml", "20 ms", 1e-4},
                                         Scene{"crank-slider/crank-slider.toml", "20 ms", 1e-3},
                                         Scene{"four-bar/four-bar.toml", "20 ms", 1e-5},
                                         Scene{"four-bar/four-bar.toml", "20 ms", 1e-4},
                                         Scene{"four-bar/four-bar.toml", "20 ms", 1e-3},
                                         Scene{"spatial-double-crank/spatial-double-crank.toml", "20 ms", 1e-3}));

}  // namespace envelope_with_errors_test
}  // namespace boresight
