// What the rungs at rest state of themselves is measured by a motion beside them, which may be stopped as they may.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace stopped_comparison_test {

// A run whose error is not measured because its caller wants an end would state the whole of itself, and be kept for a result.
TEST(StoppedComparison, IsNoResult) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "50 ms"}}));
  for (const char* rung : {"envelope", "quasistatic"}) {
    // The comparison reports the whole time and no error so far.
    bool compares = false;
    RunOptions options;
    options.sample_spacing = 0.0;
    options.model_look = ModelLook::shares;
    options.progress = [&](const RunProgress& p) {
      compares = p.t == p.duration && p.position_error_max_so_far == 0.0;
      return !compares;
    };
    const auto stopped = make_rung(rung, mechanism);
    EXPECT_TRUE(stopped->run(mechanism->parameters(), options).interrupted) << rung;
    EXPECT_TRUE(compares) << rung;
    // Once nobody stops it, it measures.
    options.progress = {};
    const RunResult whole = stopped->run(mechanism->parameters(), options);
    EXPECT_FALSE(whole.interrupted) << rung;
    EXPECT_LT(whole.error.model_of(PointingQuantity::position_error), 1.0) << rung;
  }
}

// The same of the motions under what its forces miss, by which perturbation states its error.
TEST(StoppedComparison, OfPushedMotionsIsNoResultEither) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "50 ms"}}));
  bool compares = false;
  RunOptions options;
  options.sample_spacing = 0.0;
  options.progress = [&](const RunProgress& p) {
    compares = p.t == p.duration;
    return !compares;
  };
  const auto rung = make_rung("perturbation", mechanism);
  EXPECT_TRUE(rung->run(mechanism->parameters(), options).interrupted);
  EXPECT_TRUE(compares);
  options.progress = {};
  EXPECT_FALSE(rung->run(mechanism->parameters(), options).interrupted);
}

}  // namespace stopped_comparison_test
}  // namespace boresight
