// One-second samples of the default scene over clearances and payloads: the lanes of every instruction set, against the dense
// baseline of the paper's method at its own step. `--benchmark_filter=sample` prints what the speed is judged by:
// "times_the_baseline" is the baseline's CPU per sample over the lanes', both in this run.
#include <benchmark/benchmark.h>

#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "dense_baseline.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

const std::shared_ptr<const Mechanism>& mechanism() {
  static const std::shared_ptr<const Mechanism> m = scenes::build(scenes::rrcpr());
  return m;
}

// RK4 at 0.1 ms: four right-hand sides a step, 10,000 steps a second; a hundredth of them is timed.
double baseline_seconds_per_sample() {
  static const IdealMotion ideal = IdealMotion::kinematic(*mechanism());
  IdealState state;
  ideal.state(0.23, state);
  benchmarks::DenseBaseline dense(*mechanism(), mechanism()->parameters(), ideal);
  constexpr int kTimed = 400;
  const double start = thread_cpu_seconds();
  for (int k = 0; k < kTimed; ++k) benchmark::DoNotOptimize(dense.acceleration(0.23 + 1e-6 * k, state.bodies));
  return (thread_cpu_seconds() - start) / kTimed * 40'000.0;
}

std::vector<Parameters> samples() {
  std::vector<Parameters> all;
  for (int k = 0; k < 114; ++k)  // as many together as Monte Carlo hands out
    for (const double c : {1e-4, 2e-4, 3e-4})
      for (const double payload : {0.0, 250.0, 500.0}) {
        Parameters p = mechanism()->parameters();
        p.clearance[0].radial = c * (1.0 + 1e-5 * k);
        p.clearance[0].axial = c;
        p.payload_mass = payload;
        all.push_back(p);
      }
  return all;
}

void sample_on_lanes(benchmark::State& state, const LaneTarget& target) {
  const PerturbationLanes lanes(mechanism(), PointingQuantity::position_error);
  const std::vector<Parameters> all = samples();
  std::vector<LaneOutcome> outcomes(all.size());
  lanes.run(target, {all.data(), 9}, {outcomes.data(), 9});  // what is computed once for a mechanism is not timed
  double baseline = 0.0, spent = 0.0;
  for (auto _ : state) {
    baseline += baseline_seconds_per_sample();
    const double start = thread_cpu_seconds();
    lanes.run(target, all, outcomes);
    spent += thread_cpu_seconds() - start;
    state.SetIterationTime((thread_cpu_seconds() - start) / static_cast<double>(all.size()));
  }
  const double per_sample = spent / static_cast<double>(state.iterations()) / static_cast<double>(all.size());
  state.counters["ms_per_sample"] = 1e3 * per_sample;
  state.counters["times_the_baseline"] = baseline / static_cast<double>(state.iterations()) / per_sample;
  double attempts = 0.0;
  for (const LaneOutcome& o : outcomes) attempts += static_cast<double>(o.steps + o.rejected);
  state.counters["attempts"] = attempts / static_cast<double>(all.size());
}

[[maybe_unused]] const bool lanes_registered = [] {
  for (const LanePrecision precision : {LanePrecision::single_precision, LanePrecision::double_precision})
    for (const LaneTarget& target : lane_targets(precision)) {
      const char* digits = precision == LanePrecision::single_precision ? "single" : "double";
      benchmark::RegisterBenchmark((std::string("sample/") + digits + "/" + target.name).c_str(),
                                   [target](benchmark::State& state) { sample_on_lanes(state, target); })
          ->UseManualTime()
          ->Iterations(5)
          ->Unit(benchmark::kMillisecond);
    }
  return true;
}();

}  // namespace
}  // namespace boresight
