// What bounds a study with very many samples beside the model itself: drawing them, storing them, reading them back.
//
//   build/release/bin/boresight_benchmarks --benchmark_filter="store|estimate"
#include <benchmark/benchmark.h>

#include <filesystem>

#include "boresight_analyses/montecarlo/estimates.hpp"
#include "boresight_analyses/montecarlo/montecarlo.hpp"

namespace boresight {
namespace {

class ThirdModel final : public SampleModel {
 public:
  std::string rung() const override { return "third"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 64; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>&) const override {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      outcomes[k].status = Outcome::Status::done;
      outcomes[k].value = samples[k].values[0] / 3.0;
    }
  }
};

// Of so many parameters, all normal.
MonteCarloPlan plan_of(std::uint64_t samples, long parameters = 3) {
  MonteCarloPlan plan;
  plan.samples = samples;
  for (long k = 0; k < parameters; ++k) {
    RandomParameter p;
    p.paths = {"parameter" + std::to_string(k)};
    p.si_unit = "1";
    p.distribution = make_normal(1.0, 0.1);
    plan.inputs.parameters.push_back(p);
  }
  return plan;
}

void compute_and_store(benchmark::State& state) {
  const auto folder = std::filesystem::temp_directory_path() / "boresight-store-benchmark";
  const MonteCarloPlan plan = plan_of(static_cast<std::uint64_t>(state.range(0)), state.range(1));
  double bytes = 0.0;
  for (auto _ : state) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::vector<std::string> names;
    for (const RandomParameter& p : plan.inputs.parameters) names.push_back(p.name());
    {
      SampleStore store(folder / "samples.db", {{"study", "benchmark"}}, names);
      store.use_rung("third", 0.0);
      const std::unique_ptr<Ranks> alone = Ranks::join();
      run_montecarlo(
          ThirdModel(), plan, &store, *alone,
          {.folder = folder, .facts = {{"study", "benchmark"}}, .jobs = 1, .progress = {}, .interrupted = {}});
    }
    bytes = static_cast<double>(std::filesystem::file_size(folder / "samples.db"));
  }
  std::filesystem::remove_all(folder);
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["bytes/sample"] = bytes / static_cast<double>(state.range(0));
}
BENCHMARK(compute_and_store)->Args({500000, 3})->Args({200000, 40})->Unit(benchmark::kMillisecond);

void estimate_all(benchmark::State& state) {
  const MonteCarloPlan plan = plan_of(static_cast<std::uint64_t>(state.range(0)));
  const SamplingDesign design(plan.design, 3);
  std::vector<double> values, x(3);
  for (std::uint64_t k = 0; k < plan.samples; ++k) {
    design.point(k, x);
    values.push_back(x[0] + x[1] + x[2]);
  }
  for (auto _ : state) benchmark::DoNotOptimize(estimate(values, plan, {}).index.data());
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(estimate_all)->Arg(500000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace boresight
