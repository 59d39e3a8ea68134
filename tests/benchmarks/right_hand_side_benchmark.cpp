// One right-hand side of the default scene: the dense baseline, the paper's formulation with its structure used; and one
// second of motion on each rung at the paper's step.
#include <benchmark/benchmark.h>

#include "boresight/ladder/ladder.hpp"
#include "dense_baseline.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

struct Instant {
  std::shared_ptr<const Mechanism> mechanism = scenes::build(scenes::rrcpr());
  IdealMotion ideal = IdealMotion::kinematic(*mechanism);
  IdealState state;
  Instant() { ideal.state(0.23, state); }
};
const Instant& instant() {
  static const Instant s;
  return s;
}

void dense_right_hand_side(benchmark::State& state) {
  benchmarks::DenseBaseline dense(*instant().mechanism, instant().mechanism->parameters(), instant().ideal);
  for (auto _ : state) benchmark::DoNotOptimize(dense.acceleration(0.23, instant().state.bodies));
}
BENCHMARK(dense_right_hand_side)->Unit(benchmark::kMicrosecond);

void right_hand_side(benchmark::State& state, bool paper, JournalAxes axes) {
  MechanismDescription description = scenes::rrcpr();
  description.clearances[0].axes = axes;
  const Mechanism mechanism(description);
  const auto formulation = paper ? make_paper_formulation(mechanism, mechanism.parameters(), &instant().ideal, {})
                                 : make_tree_formulation(mechanism, mechanism.parameters(), &instant().ideal, {});
  VecX y, dy;
  formulation->start(instant().state, y);
  dy.resize(y.size());
  const std::vector<ContactMemory> memory(1);
  benchmarks::DenseBaseline dense(*instant().mechanism, instant().mechanism->parameters(), instant().ideal);
  formulation->derivative(0.23, y, memory, dy);
  const VecX exact = dense.acceleration(0.23, instant().state.bodies);
  double difference = 0.0;
  for (int b = 0; b < mechanism.bodies(); ++b)
    difference = std::max(difference, (formulation->acceleration()[b] - exact.segment<6>(6 * b)).norm());
  if (axes == JournalAxes::parallel && difference > 1e-6 * exact.norm())
    state.SkipWithError("the formulations disagree");
  // A run never asks twice for the same state: neither does this.
  double t = 0.23;
  for (auto _ : state) {
    t = t == 0.23 ? 0.23 + 1e-9 : 0.23;
    formulation->derivative(t, y, memory, dy);
    benchmark::DoNotOptimize(dy.data());
  }
}
BENCHMARK_CAPTURE(right_hand_side, paper, true, JournalAxes::parallel)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(right_hand_side, tree, false, JournalAxes::parallel)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(right_hand_side, paper_free_axes, true, JournalAxes::free)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(right_hand_side, tree_free_axes, false, JournalAxes::free)->Unit(benchmark::kMicrosecond);

void second_of_motion(benchmark::State& state, const char* name) {
  const auto rung = make_rung(name, instant().mechanism);
  RunOptions options;
  options.step = 1e-4;
  options.sample_spacing = 0.0;
  rung->run(instant().mechanism->parameters(), options);  // what is computed once for a mechanism is not timed
  for (auto _ : state) benchmark::DoNotOptimize(rung->run(instant().mechanism->parameters(), options).index);
}
BENCHMARK_CAPTURE(second_of_motion, multibody, "multibody")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(second_of_motion, perturbation, "perturbation")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(second_of_motion, quasistatic, "quasistatic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(second_of_motion, envelope, "envelope")->Unit(benchmark::kMillisecond);

void precomputation(benchmark::State& state) {
  for (auto _ : state) {
    const auto rung = make_rung("envelope", instant().mechanism);
    benchmark::DoNotOptimize(rung->run(instant().mechanism->parameters(), {}).index);
  }
}
BENCHMARK(precomputation)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace boresight
