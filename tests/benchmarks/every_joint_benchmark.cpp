// What a sample costs with play in every joint: the default mechanism's fifteen over a second, and the hexapod's eighteen (24 bearings).
// `--benchmark_filter=every_joint`: "s_per_sample" is the CPU of one motion, the scene made before, which samples share; "rms_off" how far
// the perturbation rung's position error (RMS) is from multibody's of the same run.
#include <benchmark/benchmark.h>

#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "every_joint_scenes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

void every_joint(benchmark::State& state, const MechanismDescription& description) {
  const auto mechanism = scenes::build(description);
  RunOptions options;
  options.sample_spacing = 0.0;
  double cost[2] = {0.0, 0.0}, rms[2] = {0.0, 0.0};
  for (auto _ : state)
    for (const int exact : {0, 1}) {
      const auto rung = make_rung(exact ? "multibody" : "perturbation", mechanism);
      Parameters other = mechanism->parameters();
      for (ClearanceParameters& c : other.clearance) c.radial *= 1.001;
      rung->run(other, options);
      const double start = thread_cpu_seconds();
      const RunResult run = rung->run(mechanism->parameters(), options);
      cost[exact] += thread_cpu_seconds() - start;
      rms[exact] = run.index.position_error.rms;
    }
  const double runs = static_cast<double>(state.iterations());
  state.counters["s_per_sample_perturbation"] = cost[0] / runs;
  state.counters["s_per_sample_multibody"] = cost[1] / runs;
  state.counters["rms_off"] = std::abs(rms[0] / rms[1] - 1.0);
}

BENCHMARK_CAPTURE(every_joint, fifteen, scenes::fifteen_joints(JournalAxes::parallel, 1.0))
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(every_joint, eighteen, scenes::eighteen_joints(JournalAxes::parallel, 1.0))
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(every_joint, eighteen_that_tilt, scenes::eighteen_joints(JournalAxes::free, 1.0))
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace boresight
