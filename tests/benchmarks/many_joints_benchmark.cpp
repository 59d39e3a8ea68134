// How a sample's cost grows with the joints that have play: one-second samples of the 3-RRCPR mechanism with clearance in 1 to 12 of
// its joints, on the widest lanes. `--benchmark_filter=joints`: "exponent" is that of the cost between this number of joints and
// the one before it, of all of it and of one attempt; "times_single" a single sample's CPU over the lanes', both in this run.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

std::shared_ptr<const Mechanism> mechanism(int joints) {
  MechanismDescription d = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml", {});
  d.clearances.resize(static_cast<std::size_t>(joints));
  return scenes::build(std::move(d));
}

std::vector<Parameters> samples(const Mechanism& of, int count) {
  std::vector<Parameters> all;
  for (int k = 0; k < count; ++k) {
    Parameters p = of.parameters();
    for (ClearanceParameters& c : p.clearance) {
      c.radial *= 1.0 - 0.5 * k / count;
      c.axial *= 1.0 - 0.5 * k / count;
    }
    all.push_back(p);
  }
  return all;
}

struct Cost {
  double sample = 0.0, attempt = 0.0;  // [s]
};
std::map<int, Cost>& costs() {
  static std::map<int, Cost> found;
  return found;
}

void joints_on_lanes(benchmark::State& state, bool with_single) {
  const int joints = static_cast<int>(state.range(0));
  const auto m = mechanism(joints);
  const PerturbationLanes lanes(m, PointingQuantity::position_error);
  const std::vector<Parameters> all = samples(*m, 64);
  std::vector<LaneOutcome> outcomes(all.size());
  double spent = 0.0, single = 0.0;
  for (auto _ : state) {
    const double start = thread_cpu_seconds();
    lanes.run(all, outcomes);
    spent += thread_cpu_seconds() - start;
    if (with_single) {
      const double began = thread_cpu_seconds();
      const auto rung = make_rung("perturbation", m);
      rung->run(m->parameters(), {});
      const double once = thread_cpu_seconds() - began;
      rung->run(m->parameters(), {});
      single += thread_cpu_seconds() - began - once;  // without the scene, which samples share
    }
  }
  double attempts = 0.0, impacts = 0.0;
  for (const LaneOutcome& o : outcomes) {
    attempts += static_cast<double>(o.steps + o.rejected);
    impacts += static_cast<double>(o.impacts);
  }
  const double count = static_cast<double>(all.size()), runs = static_cast<double>(state.iterations());
  Cost& own = costs()[joints];
  own = {spent / runs / count, spent / runs / attempts};
  state.counters["ms_per_sample"] = 1e3 * own.sample;
  state.counters["attempts"] = attempts / count;
  state.counters["impacts"] = impacts / count;
  if (with_single) state.counters["times_single"] = single / runs / own.sample;
  const auto here = costs().find(joints);
  if (here == costs().begin()) return;
  const auto& [fewer, before] = *std::prev(here);
  const double ratio = std::log(1.0 * joints / fewer);
  state.counters["exponent"] = std::log(own.sample / before.sample) / ratio;
  state.counters["exponent_of_an_attempt"] = std::log(own.attempt / before.attempt) / ratio;
}
BENCHMARK_CAPTURE(joints_on_lanes, lanes, false)->Arg(1)->Arg(3)->Arg(6)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(joints_on_lanes, lanes_and_single, true)->Arg(12)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace boresight
