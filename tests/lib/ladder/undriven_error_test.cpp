// What the perturbation rung states of itself where a freedom that nothing drives leaves its home by far: the ideal motion is no deviation.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/perturbation/perturbation.hpp"
#include "scenes.hpp"

namespace boresight {
namespace undriven_error_test {

TEST(PerturbationError, OfACrankThatNothingDrivesIsNotTheWhole) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml",
                                          {{"motion.duration", "0.5 s"}, {"clearance.D.friction.coefficient", "0"}});
  for (JointDescription& joint : m.joints) joint.driven = false;
  m.motion.drives.clear();
  m.initial_rates.push_back({.joint = 0, .rate = 6.0, .origin = {}});
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 0.0;
  const auto run = [&](const char* rung) { return make_rung(rung, mechanism)->run(mechanism->parameters(), options); };
  const RunResult linear = run("perturbation"), exact = run("multibody");
  const double stated = linear.error.model_of(PointingQuantity::position_error);
  EXPECT_LT(stated, 0.3);
  const double a = linear.index.position_error.rms, b = exact.index.position_error.rms;
  EXPECT_LT(std::abs(a - b), stated * b) << a << ' ' << b;
}

}  // namespace undriven_error_test
}  // namespace boresight
