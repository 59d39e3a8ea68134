// What the perturbation rung states of itself where a freedom that nothing drives leaves its home by far: the ideal motion is no deviation.
#include <gmock/gmock.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/perturbation/perturbation.hpp"
#include "scenes.hpp"

namespace boresight {
namespace undriven_error_test {

std::shared_ptr<const Mechanism> crank_that_nothing_drives(const char* duration) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml",
                                          {{"motion.duration", duration}, {"clearance.D.friction.coefficient", "0"}});
  for (JointDescription& joint : m.joints) joint.driven = false;
  m.motion.drives.clear();
  m.initial_rates.push_back({.joint = 0, .rate = 6.0, .origin = {}});
  return scenes::build(m);
}

// No journal rests in the envelope: what fails there is that no gap limits the crank.
TEST(StaticRungs, SayOfAFreedomThatNothingDrivesWhatEachOfThemLacks) {
  const auto mechanism = crank_that_nothing_drives("20 ms");
  const auto refusal = [&](const char* rung) {
    return [&mechanism, rung] { make_rung(rung, mechanism)->run(mechanism->parameters(), RunOptions()); };
  };
  using testing::AllOf, testing::HasSubstr, testing::Not, testing::ThrowsMessage;
  EXPECT_THAT(refusal("envelope"),
              ThrowsMessage<ComputationError>(AllOf(HasSubstr("departs from the ideal motion by what no gap limits"),
                                                    HasSubstr("use perturbation"), Not(HasSubstr("come to rest")))));
  EXPECT_THAT(refusal("quasistatic"), ThrowsMessage<ComputationError>(HasSubstr("journals come to rest only where")));
}

TEST(PerturbationError, OfACrankThatNothingDrivesIsNotTheWhole) {
  const auto mechanism = crank_that_nothing_drives("0.5 s");
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
