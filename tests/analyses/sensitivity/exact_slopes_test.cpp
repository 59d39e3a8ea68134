// Exact slopes beside differences: where they agree, where there is none, and where they are withheld.
#include "boresight_analyses/sensitivity/exact_slopes.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"

namespace boresight {
namespace exact_slopes_test {

using testing::HasSubstr;

struct Study {
  std::shared_ptr<const Mechanism> mechanism;
  RandomInputs inputs;
  LocalResult local;
  IndexChoice index{"position_error", "rms"};
  RunOptions run;

  explicit Study(const std::string& duration, double restitution = 0.9)
      : mechanism(std::make_shared<const Mechanism>(read_mechanism(
            std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml",
            {{"motion.duration", duration}, {"clearance.A.contact.restitution", std::to_string(restitution)}}))) {
    for (const char* path : {"clearance.A.radial", "clearance.A.contact.restitution", "body.rod.mass"}) {
      RandomParameter p;
      p.paths = {path};
      p.places = {ParameterPath(mechanism->description(), path)};
      const double median = p.places.front().get(mechanism->parameters());
      p.distribution = make_uniform(0.9 * median, 1.1 * median);
      LocalSensitivity s;
      s.name = path;
      s.median = median;
      inputs.parameters.push_back(p);
      local.parameters.push_back(s);
    }
    run.integrator = "dopri5";
    run.tolerance = 1e-7;
    run.sample_spacing = 1e-5;
  }
  // Central differences over a share of the median, as the smallest of local_sensitivity.hpp.
  void take_differences(double share) {
    std::vector<double> medians;
    for (const LocalSensitivity& s : local.parameters) medians.push_back(s.median);
    for (std::size_t i = 0; i < medians.size(); ++i) {
      double value[2];
      for (int side = 0; side < 2; ++side) {
        std::vector<double> at = medians;
        at[i] *= side == 0 ? 1.0 + share : 1.0 - share;
        const RunResult result = make_rung("perturbation", mechanism)->run(inputs.parameters_with(*mechanism, at), run);
        value[side] = index.of(result.index);
      }
      local.parameters[i].derivative.back() = (value[0] - value[1]) / (2.0 * share * medians[i]);
      local.parameters[i].meaningful = true;
    }
  }
};

TEST(ExactSlopes, AgreeWithDifferencesWhereTheMotionIsPredictable) {
  Study study("20 ms");
  study.take_differences(1e-3);
  add_exact_slopes(study.mechanism, study.inputs, study.index, study.run, study.local);
  const LocalSensitivity& radial = study.local.parameters[0];
  EXPECT_TRUE(radial.exact_agrees) << radial.exact_note;
  EXPECT_NEAR(radial.exact, radial.derivative.back(), 0.02 * std::abs(radial.exact));
}

// Beside the play an error displaces the pose: its slope, of either sign, is that of small differences of the rung.
TEST(ExactSlopes, ByAStandingErrorAreThoseOfDifferences) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml",
                                          {{"motion.duration", "20 ms"}});
  for (const std::string joint : {"A", "B"}) {
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      if (m.joints[j].name != joint) continue;
      ErrorDescription e;
      e.name = joint + ".x";
      e.joint = static_cast<int>(j);
      e.body = m.joints[j].second;
      e.direction = Vec3(0.8, 0.0, 0.6);
      m.errors.push_back(e);
    }
  }
  ASSERT_FALSE(m.errors.empty());
  const auto mechanism = std::make_shared<const Mechanism>(m);
  for (const char* statistic : {"mean", "rms", "max"}) {
    const IndexChoice index{"position_error", statistic};
    RandomInputs inputs;
    LocalResult local;
    for (const ErrorDescription& e : m.errors) {
      RandomParameter p;
      p.paths = {"error." + e.name};
      p.places = {ParameterPath(m, p.paths.front())};
      p.distribution = make_normal(2e-5, 1e-5);
      inputs.parameters.push_back(p);
      LocalSensitivity s;
      s.median = 2e-5;
      local.parameters.push_back(s);
    }
    RunOptions run;
    run.integrator = "dopri5";
    run.tolerance = 1e-7;
    run.sample_spacing = 1e-5;
    const std::vector<double> medians(m.errors.size(), 2e-5);
    for (std::size_t i = 0; i < medians.size(); ++i) {
      double value[2];
      for (int side = 0; side < 2; ++side) {
        std::vector<double> at = medians;
        at[i] += side == 0 ? 1e-8 : -1e-8;
        value[side] =
            index.of(make_rung("perturbation", mechanism)->run(inputs.parameters_with(*mechanism, at), run).index);
      }
      local.parameters[i].derivative.back() = (value[0] - value[1]) / 2e-8;
      local.parameters[i].meaningful = true;
    }
    add_exact_slopes(mechanism, inputs, index, run, local);
    for (const LocalSensitivity& s : local.parameters) {
      EXPECT_GT(std::abs(s.exact), 0.01) << statistic;
      EXPECT_NEAR(s.exact, s.derivative.back(), 0.01 * std::abs(s.exact)) << statistic << ": " << s.exact_note;
    }
  }
}

TEST(ExactSlopes, AreThoseByNumbersOfContactsOnly) {
  Study study("20 ms");
  study.take_differences(1e-3);
  add_exact_slopes(study.mechanism, study.inputs, study.index, study.run, study.local);
  EXPECT_FALSE(std::isfinite(study.local.parameters[2].exact));
  EXPECT_THAT(study.local.parameters[2].exact_note, HasSubstr("contacts"));
}

// Of two parameters each of whose medians may be in a file: a play that reaches to the middle of its journal has no motion.
TEST(ExactSlopes, AreRefusedAtMediansThatNoFileMayHoldTogether) {
  Study study("20 ms");
  const double journal = study.mechanism->parameters().clearance[0].journal_radius;
  study.local.parameters[0].median = 1.5 * journal;
  add_exact_slopes(study.mechanism, study.inputs, study.index, study.run, study.local);
  for (int p = 0; p < 2; ++p) {
    EXPECT_FALSE(std::isfinite(study.local.parameters[p].exact));
    EXPECT_THAT(study.local.parameters[p].exact_note, HasSubstr("expected less than journal_radius"));
  }
}

TEST(ExactSlopes, AreWithheldBeyondTheHorizonOfPredictability) {
  Study study("100 ms", 0.999);
  add_exact_slopes(study.mechanism, study.inputs, study.index, study.run, study.local);
  for (int p = 0; p < 2; ++p) {
    EXPECT_FALSE(std::isfinite(study.local.parameters[p].exact));
    EXPECT_THAT(study.local.parameters[p].exact_note, HasSubstr("withheld: the motion is predictable for"));
  }
}

}  // namespace exact_slopes_test
}  // namespace boresight
