// The rungs against each other on the default scene.
#include "boresight/ladder/ladder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "boresight/mechanism/error.hpp"
#include "scenes.hpp"

namespace boresight {
namespace ladder_test {

RunResult run(const Rung& rung, const Mechanism& mechanism, double clearance, double payload, double step) {
  Parameters p = mechanism.parameters();
  p.clearance[0].radial = p.clearance[0].axial = clearance;
  p.payload_mass = payload;
  RunOptions options;
  options.step = step;
  options.sample_spacing = 0.0;
  return rung.run(p, options);
}

// Single impacts set the maximum and scatter it by a percent: medians over neighbouring steps.
Statistics converged(const Rung& rung, const Mechanism& mechanism, double clearance, double payload) {
  std::vector<double> max, rms;
  for (double share : {1.0, 0.98, 0.96}) {
    const Statistics s = run(rung, mechanism, clearance, payload, share * 1e-5).index.position_error;
    max.push_back(s.max);
    rms.push_back(s.rms);
  }
  std::sort(max.begin(), max.end());
  std::sort(rms.begin(), rms.end());
  Statistics median;
  median.max = max[1];
  median.rms = rms[1];
  return median;
}

void expect_agreement(const std::vector<std::pair<double, double>>& clearances_and_loads) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const auto cheap = make_rung("perturbation", mechanism), exact = make_rung("multibody", mechanism);
  for (const auto& [clearance, payload] : clearances_and_loads) {
    const Statistics a = converged(*cheap, *mechanism, clearance, payload);
    const Statistics b = converged(*exact, *mechanism, clearance, payload);
    std::printf("%.1f mm, %3.0f kg: maximum %+.2f %%, RMS %+.2f %%\n", 1e3 * clearance, payload,
                100.0 * (a.max / b.max - 1.0), 100.0 * (a.rms / b.rms - 1.0));
    EXPECT_NEAR(a.max / b.max, 1.0, 0.01) << clearance << " m, " << payload << " kg";
    EXPECT_NEAR(a.rms / b.rms, 1.0, 0.005) << clearance << " m, " << payload << " kg";
  }
}

// Corners of the published table; at night the others and its middle.
TEST(PerturbationLong, AgreesWithMultibodyOverClearancesAndLoads) { expect_agreement({{1e-4, 500.0}, {3e-4, 0.0}}); }
TEST(PerturbationNight, AgreesWithMultibodyOverClearancesAndLoads) {
  expect_agreement({{1e-4, 0.0}, {2e-4, 250.0}, {3e-4, 500.0}});
}

TEST(Perturbation, FollowsMultibodyThroughTheFirstContacts) {
  // Up to 12 ms both rungs take the same flight and the same first impacts; the difference is the second order in the offset.
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.012 s"}}));
  const RunResult a = run(*make_rung("perturbation", mechanism), *mechanism, 1e-4, 0.0, 1e-5);
  const RunResult b = run(*make_rung("multibody", mechanism), *mechanism, 1e-4, 0.0, 1e-5);
  ASSERT_EQ(a.events.size(), b.events.size());
  ASSERT_GE(a.events.size(), 2u);
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    EXPECT_EQ(a.events[k].place, b.events[k].place);
    EXPECT_NEAR(a.events[k].start, b.events[k].start, 2e-6);
    EXPECT_NEAR(a.events[k].start_speed / b.events[k].start_speed, 1.0, 0.005);
  }
}

TEST(Perturbation, HalfTheClearanceAtLeastHalvesTheModelError) {
  // In flight, where no impact blurs the comparison: deviation of the two rungs' poses when the offset reaches a given size.
  const auto mechanism = scenes::build(
      scenes::rrcpr({{"motion.duration", "0.03 s"}, {"clearance.F1.radial", "5 mm"}, {"clearance.F1.axial", "9 mm"}}));
  RunOptions options;
  options.step = 2.5e-5;
  options.sample_spacing = 5e-4;
  const RunResult a = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
  const RunResult b = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const auto model_error_at = [&](double size) {
    for (std::size_t k = 0; k < b.time.size(); ++k)
      if (b.boresight.samples[k].error.position >= size)
        return (a.boresight.samples[k].pose.p - b.boresight.samples[k].pose.p).norm() /
               b.boresight.samples[k].error.position;
    return -1.0;
  };
  const double coarse = model_error_at(2e-3), fine = model_error_at(1e-3), finest = model_error_at(5e-4);
  ASSERT_GT(finest, 0.0) << "largest error " << b.index.position_error.max;
  ASSERT_GT(coarse, 0.0);
  EXPECT_LT(coarse, 0.02);  // relative to an error of 2 mm, ten times that of the default clearance
  EXPECT_LT(fine, 0.75 * coarse);
  EXPECT_LT(finest, 0.75 * fine);
}

TEST(Perturbation, APayloadSweepOnOneSceneEqualsAScenePerPayload) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"}}));
  const auto shared = make_rung("perturbation", mechanism);
  for (const char* payload : {"3 kg", "250 kg"}) {
    const auto rebuilt = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"}, {"payload.mass", payload}}));
    const double mass = rebuilt->parameters().payload_mass;
    const double a = run(*shared, *mechanism, 1e-4, mass, 5e-5).index.position_error.rms;
    const double b = run(*make_rung("perturbation", rebuilt), *rebuilt, 1e-4, mass, 5e-5).index.position_error.rms;
    EXPECT_NEAR(a / b, 1.0, 1e-10);
  }
}

TEST(Perturbation, ChoosesAStepThatItsContactsBear) {
  // A light slider on a stiff pin asks for a far smaller step than the default scene does.
  const auto mechanism =
      scenes::build(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml"));
  RunOptions coarse;
  coarse.step = 1e-3;
  EXPECT_THROW(make_rung("perturbation", mechanism)->run(mechanism->parameters(), coarse), ComputationError);
  const double a = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {}).index.position_error.rms;
  const double b = make_rung("multibody", mechanism)->run(mechanism->parameters(), {}).index.position_error.rms;
  EXPECT_NEAR(a / b, 1.0, 0.01);
}

TEST(Quasistatic, HasTheMeanErrorOfMultibody) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  for (double payload : {0.0, 250.0, 500.0}) {
    const double a = run(*make_rung("quasistatic", mechanism), *mechanism, 1e-4, payload, 0.0).index.position_error.rms;
    const double b = run(*make_rung("multibody", mechanism), *mechanism, 1e-4, payload, 1e-4).index.position_error.rms;
    EXPECT_NEAR(a / b, 1.0, 0.03) << payload << " kg";
  }
}

TEST(Envelope, IsNeverBelowTheQuasistaticMaximum) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  for (double clearance : {2e-5, 1e-4, 3e-4}) {
    for (double payload : {0.0, 250.0, 500.0}) {
      const PointingIndices bound = run(*make_rung("envelope", mechanism), *mechanism, clearance, payload, 0.0).index;
      const PointingIndices rest = run(*make_rung("quasistatic", mechanism), *mechanism, clearance, payload, 0.0).index;
      EXPECT_GE(bound.position_error.max, rest.position_error.max * (1.0 - 1e-9));
      EXPECT_GE(bound.line_of_sight_error.max,
                rest.line_of_sight_error.max * (1.0 - 1e-3));  // second order in the error
      EXPECT_LE(bound.position_error.max, 1.2 * rest.position_error.max) << "a bound far above says nothing";
    }
  }
}

TEST(SceneRungs, RefuseAMechanismWithoutClearance) {
  MechanismDescription description = scenes::rrcpr({{"motion.duration", "0.05 s"}});
  description.clearances.clear();
  const auto mechanism = scenes::build(description);
  for (const char* name : {"envelope", "quasistatic", "perturbation"})
    EXPECT_THROW(make_rung(name, mechanism)->run(mechanism->parameters(), {}), ComputationError) << name;
}

}  // namespace ladder_test
}  // namespace boresight
