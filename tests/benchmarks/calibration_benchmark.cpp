// What a calibration takes: four parameters from ten runs of 1 s at 1 kHz, starts, fit, intervals by profile and all.
//
//   build/release/bin/boresight_benchmarks --benchmark_filter=calibrate
#include <benchmark/benchmark.h>

#include "analyses/calibration/four_bar_rig.hpp"

namespace boresight {
namespace {

void calibrate_ten_runs(benchmark::State& state) {
  const four_bar::Bench bench = four_bar::ten_runs();
  double worst = 0.0;
  for (auto _ : state) {
    CalibrationProblem problem = bench.problem({}, four_bar::kFour);
    CalibrationOptions options;
    options.jobs = static_cast<int>(state.range(0));
    options.corrections = 0;
    options.profile = true;
    worst = 0.0;
    for (const ParameterEstimate& e : calibrate(problem, options).inference.parameters)
      worst = std::max(worst, std::abs(e.value - bench.truth(e.name)) / e.standard_error);
  }
  state.counters["standard errors off"] = worst;
}
BENCHMARK(calibrate_ten_runs)
    ->ArgName("threads")
    ->Arg(2)
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace boresight
