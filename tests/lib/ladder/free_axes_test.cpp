// Journals that tilt in their sleeves: figures of the default scene, and the formulations and rungs against each other.
#include <gtest/gtest.h>

#include <algorithm>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace free_axes_test {

std::shared_ptr<const Mechanism> with_free_axes(const char* sleeve_length, const char* duration = "1 s") {
  MechanismDescription d =
      scenes::rrcpr({{"clearance.F1.sleeve_length", sleeve_length}, {"motion.duration", duration}});
  d.clearances[0].axes = JournalAxes::free;
  return scenes::build(std::move(d));
}

RunResult run(const Mechanism& mechanism, const Rung& rung, double step, const char* formulation = "") {
  RunOptions options;
  options.step = step;
  options.sample_spacing = 0.0;
  options.formulation = formulation;
  return rung.run(mechanism.parameters(), options);
}

struct Median {
  double max, rms;
};
Median boresight_error(const Mechanism& mechanism, const Rung& rung, double step, const char* formulation = "") {
  std::vector<double> max, rms;
  for (double share : {1.0, 0.98, 0.96}) {
    const RunResult result = run(mechanism, rung, share * step, formulation);
    max.push_back(result.index.boresight_error.max);
    rms.push_back(result.index.boresight_error.rms);
  }
  std::sort(max.begin(), max.end());
  std::sort(rms.begin(), rms.end());
  return {max[1], rms[1]};
}

// The figure of lib/README.md, 2.39 mrad, and that perturbation comes to it. Impacts scatter it: medians over neighbouring steps.
TEST(FreeAxesLong, TurnThePlatformOfTheDefaultSceneByMilliradians) {
  const auto mechanism = with_free_axes("120 mm");
  const Median exact = boresight_error(*mechanism, *make_rung("multibody", mechanism), 1e-5);
  EXPECT_NEAR(exact.max / 2.39e-3, 1.0, 0.01);
  EXPECT_NEAR(exact.rms / 1.60e-3, 1.0, 0.02);  // of the project's first prototype, of which these digits are left
  const Median cheap = boresight_error(*mechanism, *make_rung("perturbation", mechanism), 1e-5);
  EXPECT_NEAR(cheap.max / exact.max, 1.0, 0.02);
  EXPECT_NEAR(cheap.rms / exact.rms, 1.0, 0.02);
}

// A sleeve a quarter as long lets its journal tilt four times as far, and rattle chaotically besides.
TEST(FreeAxesLong, OfAShortSleeveTurnItFiveTimesAsFar) {
  const auto mechanism = with_free_axes("30 mm");
  const Median exact = boresight_error(*mechanism, *make_rung("multibody", mechanism), 1e-5);
  EXPECT_NEAR(exact.max / 14e-3, 1.0, 0.10);  // of the prototype too
  EXPECT_NEAR(exact.rms / 7.6e-3, 1.0, 0.05);
  const double ratio = exact.rms / 1.60e-3;  // which the test above holds the longer one to
  EXPECT_GT(ratio, 4.0);
  EXPECT_LT(ratio, 5.5);
}

TEST(FreeAxesNight, TurnThePlatformAsFarInBothFormulations) {
  for (const bool rattles : {false, true}) {
    const auto mechanism = with_free_axes(rattles ? "30 mm" : "120 mm");
    const auto rung = make_rung("multibody", mechanism);
    const Median tree = boresight_error(*mechanism, *rung, 1e-5),
                 paper = boresight_error(*mechanism, *rung, 1e-5, "paper");
    EXPECT_NEAR(paper.max / tree.max, 1.0, rattles ? 0.10 : 0.01);
    EXPECT_NEAR(paper.rms / tree.rms, 1.0, rattles ? 0.05 : 0.01);
  }
}

TEST(FreeAxes, GiveTheSameMotionInBothFormulations) {
  const auto mechanism = with_free_axes("120 mm", "0.1 s");
  const auto rung = make_rung("multibody", mechanism);
  const RunResult tree = run(*mechanism, *rung, 1e-5), paper = run(*mechanism, *rung, 1e-5, "paper");
  ASSERT_GE(tree.events.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(tree.events[k].place, paper.events[k].place);
    EXPECT_NEAR(tree.events[k].start, paper.events[k].start, 1e-8);
    EXPECT_NEAR(tree.events[k].start_speed / paper.events[k].start_speed, 1.0, 1e-4);
  }
  EXPECT_NEAR(tree.index.boresight_error.max / paper.index.boresight_error.max, 1.0, 3e-3);
  EXPECT_NEAR(tree.index.boresight_error.rms / paper.index.boresight_error.rms, 1.0, 3e-3);
}

TEST(FreeAxes, GiveTheSameFirstContactsInPerturbationAndMultibody) {
  const auto mechanism = with_free_axes("120 mm", "0.03 s");
  const RunResult exact = run(*mechanism, *make_rung("multibody", mechanism), 1e-5);
  const RunResult cheap = run(*mechanism, *make_rung("perturbation", mechanism), 1e-5);
  ASSERT_GE(exact.events.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(cheap.events[k].place, exact.events[k].place);
    EXPECT_NEAR(cheap.events[k].start, exact.events[k].start, 5e-6);
    EXPECT_NEAR(cheap.events[k].start_speed / exact.events[k].start_speed, 1.0, 0.01);
  }
}

TEST(FreeAxes, AreStaticallyBalancedByTheQuasistaticRungAndBoundedByTheEnvelope) {
  for (const char* sleeve : {"30 mm", "120 mm"}) {
    const auto mechanism = with_free_axes(sleeve);
    const PointingIndices rest = run(*mechanism, *make_rung("quasistatic", mechanism), 0.0).index;
    const PointingIndices bound = run(*mechanism, *make_rung("envelope", mechanism), 0.0).index;
    const PointingIndices dynamic = run(*mechanism, *make_rung("perturbation", mechanism), 2e-5).index;
    // The short sleeve hardly ever rests.
    EXPECT_NEAR(rest.boresight_error.rms / dynamic.boresight_error.rms, 1.0, sleeve[0] == '1' ? 0.05 : 0.2) << sleeve;
    EXPECT_GE(bound.boresight_error.max, rest.boresight_error.max * (1.0 - 1e-3))
        << sleeve;  // second order in the error
    EXPECT_GE(bound.position_error.max, rest.position_error.max * (1.0 - 1e-9)) << sleeve;
    EXPECT_LE(bound.boresight_error.max, 1.3 * rest.boresight_error.max) << sleeve;
  }
}

}  // namespace free_axes_test
}  // namespace boresight
