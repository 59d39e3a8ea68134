// Highway, which lanes are built on, against xsimd: the same kernel, compiled with the same flags for this machine's widest instruction set, on
// the default scene. `--benchmark_filter=lane_library` prints "over_own": xsimd's CPU over Highway's, pair by pair in one run; and "apart", the
// largest difference of a sample's maximum, relative.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "scenes.hpp"

namespace boresight {

#ifdef BORESIGHT_XSIMD
void run_lanes_on_xsimd(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_on_xsimd_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
#endif

namespace {

[[maybe_unused]] void library_over_own(benchmark::State& state, const LaneTarget& own, const LaneTarget& library) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const PerturbationLanes lanes(mechanism, PointingQuantity::position_error);
  std::vector<Parameters> samples;
  for (int k = 0; k < 40; ++k)
    for (const double clearance : {1e-4, 2e-4, 3e-4}) {
      Parameters p = mechanism->parameters();
      p.clearance[0].radial = clearance * (1.0 + 1e-4 * k);
      samples.push_back(p);
    }
  std::vector<LaneOutcome> by_own(samples.size()), by_library(samples.size());
  const auto seconds = [&](const LaneTarget& target, std::vector<LaneOutcome>& outcomes) {
    const double start = thread_cpu_seconds();
    lanes.run(target, samples, outcomes);
    return thread_cpu_seconds() - start;
  };
  seconds(own, by_own);  // what is computed once for a mechanism is not timed
  std::vector<double> ratios;
  for (auto _ : state) {
    const double first = seconds(own, by_own), spent = seconds(library, by_library), second = seconds(own, by_own);
    state.SetIterationTime(spent / static_cast<double>(samples.size()));
    ratios.push_back(spent / (0.5 * (first + second)));
  }
  std::sort(ratios.begin(), ratios.end());
  double apart = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k)
    apart = std::max(apart, std::abs(by_library[k].max / by_own[k].max - 1.0));
  state.counters["over_own"] = ratios[ratios.size() / 2];
  state.counters["apart"] = apart;
}

#ifdef BORESIGHT_XSIMD
[[maybe_unused]] const bool libraries_registered = [] {
  for (const LanePrecision precision : {LanePrecision::single_precision, LanePrecision::double_precision}) {
    const bool single = precision == LanePrecision::single_precision;
    const LaneTarget own = lane_targets(precision).front();
    const LaneTarget xsimd = {"xsimd", own.lanes, own.fuses, single ? run_lanes_on_xsimd_single : run_lanes_on_xsimd};
    benchmark::RegisterBenchmark(
        (std::string("lane_library/") + (single ? "single/" : "double/") + own.name + "/" + xsimd.name).c_str(),
        [own, xsimd](benchmark::State& state) { library_over_own(state, own, xsimd); })
        ->UseManualTime()
        ->Iterations(15)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();
#endif

}  // namespace
}  // namespace boresight
