// Forty standing errors of the default mechanism: samples on lanes against samples without errors, and pure geometry against its rung one by
// one. `--benchmark_filter=forty` prints both; whole studies: tolerances.py.
#include <benchmark/benchmark.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/scene/geometric_errors.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace {

// Every third of all the errors that the mechanism can have, up to forty.
std::shared_ptr<const Mechanism> with_forty_errors(bool play) {
  MechanismDescription m = scenes::rrcpr();
  if (!play) m.clearances.clear();
  m = scenes::with_every_error(m);
  std::vector<ErrorDescription> some;
  for (std::size_t e = 0; e < m.errors.size() && some.size() < 40; e += 3) some.push_back(m.errors[e]);
  m.errors = some;
  return scenes::build(m);
}

std::vector<Parameters> samples_of(const Mechanism& mechanism, int count, double scale) {
  std::vector<Parameters> samples;
  for (int k = 0; k < count; ++k) {
    samples.push_back(scenes::with_scattered_errors(mechanism, static_cast<unsigned>(k), scale));
    if (mechanism.clearances() > 0) samples.back().clearance[0].radial *= 1.0 + 1e-5 * k;
  }
  return samples;
}

void forty_errors_on_lanes(benchmark::State& state) {
  const auto mechanism = with_forty_errors(true);
  const PerturbationLanes lanes(mechanism, PointingQuantity::position_error);
  const std::vector<Parameters> with = samples_of(*mechanism, 1024, 1.0), without = samples_of(*mechanism, 1024, 0.0);
  std::vector<LaneOutcome> outcomes(with.size());
  lanes.run({with.data(), 1}, {outcomes.data(), 1});  // what is computed once for a mechanism is not timed
  double spent[2] = {};
  for (auto _ : state)
    for (const int errors : {0, 1}) {
      const double start = thread_cpu_seconds();
      lanes.run(errors ? with : without, outcomes);
      spent[errors] += thread_cpu_seconds() - start;
    }
  const double runs = static_cast<double>(state.iterations()) * static_cast<double>(with.size());
  state.counters["ms_per_sample"] = 1e3 * spent[1] / runs;
  state.counters["times_one_without"] = spent[1] / spent[0];
}
BENCHMARK(forty_errors_on_lanes)->Iterations(3)->Unit(benchmark::kMillisecond);

void forty_errors_alone(benchmark::State& state) {
  const auto mechanism = with_forty_errors(false);
  const std::vector<Parameters> samples = samples_of(*mechanism, 1024, 1.0);
  const auto statistic = static_cast<TimeStatistic>(state.range(0));
  const GeometricErrors geometry(mechanism, PointingQuantity::position_error, statistic);
  std::vector<GeometricOutcome> outcomes(samples.size());
  const auto rung = make_rung("quasistatic", mechanism);
  RunOptions options;
  options.sample_spacing = 0.0;
  benchmark::DoNotOptimize(rung->run(samples[0], options).index);
  const double before = thread_cpu_seconds();
  for (int k = 0; k < 8; ++k) benchmark::DoNotOptimize(rung->run(samples[static_cast<std::size_t>(k)], options).index);
  const double one_by_one = (thread_cpu_seconds() - before) / 8.0;
  double spent = 0.0;
  for (auto _ : state) {
    const double start = thread_cpu_seconds();
    geometry.run(samples, outcomes);
    spent += thread_cpu_seconds() - start;
  }
  const double per_sample = spent / static_cast<double>(state.iterations()) / static_cast<double>(samples.size());
  state.counters["us_per_sample"] = 1e6 * per_sample;
  state.counters["times_faster_than_runs"] = one_by_one / per_sample;
}
BENCHMARK(forty_errors_alone)->Arg(0)->Arg(1)->Arg(2)->Arg(3)->Iterations(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace boresight
