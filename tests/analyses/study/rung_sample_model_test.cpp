// A study with an integrator gives each sample its own steps, as a single run does.
#include "boresight_analyses/study/rung_sample_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/study/rung_choice.hpp"

namespace boresight {
namespace rung_sample_model_test {

std::shared_ptr<const Mechanism> scene() {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml", {{"motion.duration", "50 ms"}}));
}

class WithIntegrator : public testing::TestWithParam<const char*> {};

TEST_P(WithIntegrator, EachSampleTakesTheStepsOfItsOwnRun) {
  const auto mechanism = scene();
  RunOptions options;
  options.integrator = GetParam();
  EXPECT_EQ(common_step("perturbation", mechanism, {mechanism->parameters()}, options), 0.0);
  apply({.name = "perturbation", .why = "", .step = 1e-4}, options);
  EXPECT_EQ(options.step, 0.0) << "a step found with rk4 is none of another integrator's";

  const auto parameters_of = [&](std::span<const double> values) {
    Parameters p = mechanism->parameters();
    p.clearance[0].radial = values[0];
    return p;
  };
  const IndexChoice index{"position_error", "max"};
  const RungSampleModel model("perturbation", mechanism, parameters_of, index, options, false);
  const std::atomic<bool> stop{false};
  for (const double clearance : {0.6e-4, 1.0e-4, 1.4e-4}) {
    const std::vector<double> values = {clearance};
    const Sample sample{0, values};
    Outcome outcome;
    model.evaluate({&sample, 1}, {&outcome, 1}, stop);
    ASSERT_EQ(outcome.status, Outcome::Status::done) << outcome.message;
    options.sample_spacing = 0.0;
    EXPECT_EQ(outcome.value, index.of(make_rung("perturbation", mechanism)->run(parameters_of(values), options).index));
  }
}
INSTANTIATE_TEST_SUITE_P(Integrators, WithIntegrator, testing::Values("dopri5", "rosenbrock"));

// 100,000 t on a journal of 10 mm: no rung has an answer, and a study of them fails sample by sample, on lanes and off.
TEST(SampleModel, FailsWhereAContactIsDeeperThanItsJournalIsThick) {
  const auto mechanism =
      std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml",
                                                       {{"motion.duration", "20 ms"}, {"initial.journals", "rest"}}));
  const auto parameters_of = [&](std::span<const double> values) {
    Parameters p = mechanism->parameters();
    p.payload_mass = values[0];
    return p;
  };
  const std::atomic<bool> stop{false};
  for (const char* rung : {"quasistatic", "perturbation"}) {
    const auto model = sample_model(rung, mechanism, parameters_of, {"position_error", "max"}, {}, false);
    for (const double mass : {10.0, 1e8}) {
      const std::vector<double> values = {mass};
      const Sample sample{0, values};
      Outcome outcome;
      model->evaluate({&sample, 1}, {&outcome, 1}, stop);
      EXPECT_EQ(outcome.status, mass < 1e3 ? Outcome::Status::done : Outcome::Status::failed) << rung << mass;
      EXPECT_EQ(outcome.message.find("no contact law holds there") != std::string::npos, mass > 1e3)
          << rung << outcome.message;
    }
  }
}

// Each number alone may be in the file; a draw of several may be a mechanism that no reader takes. Its neighbours are none the worse for it.
TEST(SampleModel, FailsWhereTheReaderWouldRefuseTheNumbersTogether) {
  const auto mechanism = scene();
  const auto parameters_of = [&](std::span<const double> values) {
    Parameters p = mechanism->parameters();
    p.clearance[0].radial = values[0];
    p.clearance[0].cap_radius = values[1];
    return p;
  };
  const std::atomic<bool> stop{false};
  const std::vector<std::vector<double>> drawn = {{1e-4, 12e-3}, {3e-3, 12e-3}, {2e-4, 12e-3}, {1e-4, 10.05e-3}};
  for (const char* rung : {"quasistatic", "perturbation"}) {
    const auto model = sample_model(rung, mechanism, parameters_of, {"position_error", "max"}, {}, false);
    std::vector<Sample> samples;
    for (const std::vector<double>& values : drawn) samples.push_back({samples.size(), values});
    std::vector<Outcome> together(samples.size());
    std::vector<std::size_t> reached;
    model->evaluate_each(samples, together, stop, [&](std::size_t k) { reached.push_back(k); });
    std::sort(reached.begin(), reached.end());
    EXPECT_EQ(reached, (std::vector<std::size_t>{0, 1, 2, 3})) << rung;
    for (const std::size_t k : {0, 2}) {
      Outcome alone;
      model->evaluate({&samples[k], 1}, {&alone, 1}, stop);
      EXPECT_EQ(together[k].status, Outcome::Status::done) << rung << together[k].message;
      EXPECT_EQ(together[k].value, alone.value) << rung;
    }
    for (const std::size_t k : {1, 3}) {
      EXPECT_EQ(together[k].status, Outcome::Status::failed) << rung;
      EXPECT_NE(together[k].message.find("expected more than journal_radius + radial"), std::string::npos)
          << rung << together[k].message;
    }
  }
}

// What rosenbrock took where it took over is no step for rk4: each sample then goes the way of its own run.
TEST(CommonStep, IsNoneWhereRosenbrockTakesOver) {
  const auto mechanism =
      std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml",
                                                       {{"motion.duration", "20 ms"},
                                                        {"initial.journals", "rest"},
                                                        {"clearance.F1.contact.minimum_impact_speed", "1e-6 m/s"}}));
  const std::vector<Parameters> samples(2, mechanism->parameters());
  EXPECT_EQ(common_step("multibody", mechanism, samples, {}), 0.0);
  EXPECT_EQ(common_step("perturbation", mechanism, samples, {}), 0.0);
  RunOptions steps;
  steps.integrator = "rk4";
  EXPECT_GT(common_step("perturbation", mechanism, samples, steps), 0.0);
}

TEST(CommonStep, TakesWhatAnEarlierStartFoundAndFliesTheOthersOnly) {
  const auto mechanism = scene();
  const std::vector<Parameters> samples(3, mechanism->parameters());
  RunOptions options;
  std::vector<std::size_t> flown;
  std::vector<double> steps;
  const auto found = [&](std::size_t k, double step) { flown.push_back(k), steps.push_back(step); };
  const double own = common_step("perturbation", mechanism, samples, options, {}, found);
  EXPECT_EQ(flown, (std::vector<std::size_t>{0, 1, 2}));
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0], own);
  flown.clear();
  EXPECT_EQ(common_step("perturbation", mechanism, samples, options, {own, 0.5 * own, 0.0}, found), 0.5 * own)
      << "the smallest";
  EXPECT_EQ(flown, (std::vector<std::size_t>{2}));
}

// Beside a draw that no file may hold, of whose motion nobody asks.
TEST(CommonStep, IsThatOfTheSamplesThatAreFollowed) {
  const auto mechanism = scene();
  std::vector<Parameters> samples(2, mechanism->parameters());
  const double alone = common_step("perturbation", mechanism, samples, {});
  samples[1].clearance[0].radial = 30e-3;
  std::vector<std::size_t> flown;
  EXPECT_EQ(common_step("perturbation", mechanism, samples, {}, {}, [&](std::size_t k, double) { flown.push_back(k); }),
            alone);
  EXPECT_EQ(flown, (std::vector<std::size_t>{0}));
}

TEST(Failures, TellTheReasonOfTheFirstSampleWhateverTheOrder) {
  Outcome bad{.status = Outcome::Status::failed, .message = "later"}, good{.status = Outcome::Status::done};
  Failures failures;
  failures.see(1, good);
  failures.see(7, bad);
  bad.message = "first";
  failures.see(3, bad);
  bad.message = "last";
  failures.see(9, bad);
  EXPECT_EQ(failures.count, 3u);
  EXPECT_EQ(failures.first, 3u);
  EXPECT_EQ(failures.reason, "first");
}

// A plan that divides CPU time over rungs goes by what is counted, and a study that was killed goes on with the same plan.
TEST(RungSampleModel, CountsTheSameForASampleWhateverItRanBefore) {
  for (const bool scatters_errors : {false, true}) {
    const auto mechanism =
        scatters_errors
            ? std::make_shared<const Mechanism>(read_mechanism(
                  std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/tolerances.toml", {{"motion.duration", "50 ms"}}))
            : scene();
    const auto parameters_of = [&](std::span<const double> values) {
      Parameters p = mechanism->parameters();
      p.clearance[0].radial *= values[0];
      if (scatters_errors) p.error[0] = 1e-6 * values[0];
      return p;
    };
    const auto counted = [&](const RungSampleModel& model, double share) {
      const std::vector<double> values = {share};
      const Sample sample{0, values};
      Outcome outcome;
      const std::atomic<bool> stop{false};
      model.evaluate({&sample, 1}, {&outcome, 1}, stop);
      EXPECT_EQ(outcome.status, Outcome::Status::done) << outcome.message;
      return outcome.evaluations;
    };
    for (const std::string rung : {"envelope", "quasistatic", "perturbation", "multibody"}) {
      const auto fresh = [&] {
        return RungSampleModel(rung, mechanism, parameters_of, {"position_error", "max"}, {}, false);
      };
      const RungSampleModel first = fresh(), later = fresh();
      const double alone = counted(first, 1.01);
      counted(later, 0.99);
      EXPECT_EQ(counted(later, 1.01), alone) << rung;
      EXPECT_EQ(counted(later, 1.01), alone) << rung << ", once more";
      EXPECT_GT(alone, 0.0) << rung;
    }
  }
}

}  // namespace rung_sample_model_test
}  // namespace boresight
