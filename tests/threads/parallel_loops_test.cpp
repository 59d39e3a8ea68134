// Every loop that runs on threads, with four of them: the same bits as on one, and (preset tsan) no two threads at one place
// unordered. Motions are of 20 ms, for the sanitiser slows them tenfold.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "boresight/io/expression.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight_analyses/montecarlo/montecarlo.hpp"
#include "boresight_analyses/runs/parallel_evaluation.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/sweep/sweep.hpp"
#include "closed_form.hpp"

namespace boresight {
namespace {

constexpr int kThreads = 4;

const std::shared_ptr<const Mechanism>& scene() {
  static const auto read = std::make_shared<const Mechanism>(
      read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml", {{"motion.duration", "20 ms"}}));
  return read;
}

// x1: radial clearance. x2: restitution, or (scene_varies) the payload's mass.
RungSampleModel::ParametersOf parameters_of(bool scene_varies) {
  return [scene_varies](std::span<const double> values) {
    Parameters p = scene()->parameters();
    p.clearance[0].radial = values[0];
    (scene_varies ? p.payload_mass : p.clearance[0].contact.restitution) = values[1];
    return p;
  };
}

MonteCarloPlan plan_of(std::uint64_t samples, bool scene_varies) {
  MonteCarloPlan plan = sum_plan(samples);
  plan.inputs.parameters[0].distribution = make_uniform(5e-5, 15e-5);
  plan.inputs.parameters[1].distribution = scene_varies ? make_uniform(0.0, 300.0) : make_uniform(0.7, 0.95);
  return plan;
}

// With one thread and with four.
void expect_the_same_bits(const SampleModel& model, const MonteCarloPlan& plan) {
  std::vector<std::vector<double>> values;
  for (const int jobs : {1, kThreads}) {
    const Folder folder("loops");
    auto store = open_sum_store(folder);
    values.push_back(run_sum(model, plan, *store, folder, jobs).values);
  }
  ASSERT_EQ(values[0].size(), plan.samples);
  EXPECT_EQ(values[0], values[1]);
}

TEST(ParallelLoops, SamplesOfALaneModel) {
  const IndexChoice index{"position_error", "max"};
  expect_the_same_bits(LaneSampleModel(scene(), parameters_of(false), index, false), plan_of(48, false));
  expect_the_same_bits(LaneSampleModel(scene(), parameters_of(true), index, true), plan_of(8, true));
}

TEST(ParallelLoops, SamplesOfRungsThatShareTheirScene) {
  const IndexChoice index{"boresight_error", "rms"};
  for (const char* rung : {"quasistatic", "envelope", "perturbation"}) {
    RunOptions options;
    if (std::string(rung) == "perturbation") options.integrator = "rosenbrock";
    expect_the_same_bits(RungSampleModel(rung, scene(), parameters_of(false), index, options, false),
                         plan_of(12, false));
  }
}

TEST(ParallelLoops, SamplesOfRungsWithAScenePerThread) {
  RunOptions options;
  options.integrator = "rosenbrock";
  expect_the_same_bits(
      RungSampleModel("perturbation", scene(), parameters_of(true), {"position_error", "max"}, options, true),
      plan_of(8, true));
}

TEST(ParallelLoops, SamplesOfMultibody) {
  RunOptions options;
  options.step = 5e-5;
  for (const bool varies : {false, true})
    expect_the_same_bits(
        RungSampleModel("multibody", scene(), parameters_of(varies), {"position_error", "max"}, options, varies),
        plan_of(8, varies));
}

TEST(ParallelLoops, AnInterruptionFromOutside) {
  class Slow final : public SampleModel {
   public:
    std::string rung() const override { return "sum"; }
    double step() const override { return 0.0; }
    std::string leaves_out() const override { return ""; }
    std::size_t batch() const override { return 7; }
    void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                  const std::atomic<bool>& stop) const override {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      sum_.evaluate(samples, outcomes, stop);
    }
    SumModel sum_;
  } slow;
  const Folder folder("loops-cut");
  auto store = open_sum_store(folder);
  std::atomic<bool> enough{false};
  std::jthread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    enough = true;
  });
  const MonteCarloResult cut =
      run_sum(slow, sum_plan(200'000), *store, folder, kThreads, [&] { return enough.load(); });
  EXPECT_EQ(cut.ended, Ended::interrupted);
  EXPECT_EQ(cut.stored, slow.sum_.evaluated);
}

TEST(ParallelLoops, PointsOfASweepOnOneRung) {
  SweepPlan plan;
  plan.axes = {{{"clearance.F1.radial"}, "m", {5e-5, 1e-4, 1.5e-4}}, {{"payload.mass"}, "kg", {0.0, 200.0}}};
  for (const char* name : {"perturbation", "multibody"}) {
    const std::unique_ptr<Rung> rung = make_rung(name, scene());
    std::vector<SweepResult> results;
    for (const int jobs : {1, kThreads}) {
      SweepOptions options;
      options.jobs = jobs;
      options.run.step = 5e-5;
      options.progress = [](const SweepProgress&) { return true; };
      results.push_back(run_sweep(*rung, *scene(), plan, options));
    }
    ASSERT_EQ(results[0].points.size(), 6u);
    EXPECT_EQ(results[0].failed, 0u);
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_EQ(results[0].points[k].result.index.position_error.max,
                results[1].points[k].result.index.position_error.max);
  }
}

TEST(ParallelLoops, ListsOfSamplesAndWhatTheirReaderThrows) {
  const SumModel model;
  std::vector<std::vector<double>> values;
  for (int k = 0; k < 200; ++k) values.push_back({1.0 * k, 2.0});
  std::size_t landed = 0;  // not atomic: told of one at a time
  const auto outcomes =
      evaluate_all(model, values, {.jobs = kThreads, .landed = [&](std::size_t, const Outcome&) { ++landed; }});
  EXPECT_EQ(landed, 200u);
  for (int k = 0; k < 200; ++k) EXPECT_EQ(outcomes[static_cast<std::size_t>(k)].value, k + 2.0);
  EXPECT_THROW(evaluate_all(model, values,
                            {.jobs = kThreads,
                             .landed =
                                 [](std::size_t k, const Outcome&) {
                                   if (k == 50) throw std::runtime_error("enough");
                                 }}),
               std::runtime_error);
  EXPECT_THROW(
      evaluate_all(
          model, values,
          {.jobs = kThreads,
           .interrupted = [] { return true; },
           .landed = [](std::size_t, const Outcome&) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }}),
      EvaluationInterrupted);
}

TEST(ParallelLoops, FilesReadAndLawsOfTimeAskedSideBySide) {
  const auto shared = parse_expression("500*sin(theta)*cos(psi) + t^2", {{"psi", "2*pi*t"}, {"theta", "t^2"}});
  watch_work([](const char*, double) { return true; });
  std::vector<std::jthread> threads;
  std::atomic<int> read{0};
  for (int j = 0; j < kThreads; ++j)
    threads.emplace_back([&, j] {
      for (int k = 0; k < 3; ++k) {
        const Mechanism own(read_mechanism(BORESIGHT_EXAMPLES "/crank-slider/crank-slider.toml",
                                           {{"motion.duration", std::to_string(20 + 3 * j + k) + " ms"}}));
        const auto law = parse_expression("sin(" + std::to_string(j + 4 * k + 2) + "*t)", {});
        if (own.duration() > 0.0 && std::isfinite(law->at(0.3).value) && std::isfinite(shared->at(0.1 * k).value) &&
            parse_quantity(std::to_string(k + 1) + " mm", kLength) > 0.0)
          ++read;
        work_reached("reading", 0.5);
      }
    });
  threads.clear();
  watch_work(nullptr);
  EXPECT_EQ(read, 3 * kThreads);
}

}  // namespace
}  // namespace boresight
