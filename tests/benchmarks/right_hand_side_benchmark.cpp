// One right-hand side of the default scene: the dense baseline, the paper's formulation with its structure used; and one
// second of motion on each rung at the paper's step.
#include <benchmark/benchmark.h>

#include "boresight/rungs/rung.hpp"
#include "dense_baseline.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

struct Scene {
  std::shared_ptr<const Mechanism> mechanism = scenes::build(scenes::rrcpr());
  IdealMotion ideal = IdealMotion::kinematic(*mechanism);
  IdealState state;
  Scene() { ideal.state(0.23, state); }
};
const Scene& scene() {
  static const Scene s;
  return s;
}

void dense_right_hand_side(benchmark::State& state) {
  benchmarks::DenseBaseline dense(*scene().mechanism, scene().mechanism->parameters(), scene().ideal);
  for (auto _ : state) benchmark::DoNotOptimize(dense.acceleration(0.23, scene().state.bodies));
}
BENCHMARK(dense_right_hand_side)->Unit(benchmark::kMicrosecond);

void paper_right_hand_side(benchmark::State& state) {
  const auto formulation =
      make_paper_formulation(*scene().mechanism, scene().mechanism->parameters(), &scene().ideal, {});
  VecX y, dy;
  formulation->start(scene().state, y);
  dy.resize(y.size());
  const std::vector<ContactMemory> memory(1);
  benchmarks::DenseBaseline dense(*scene().mechanism, scene().mechanism->parameters(), scene().ideal);
  formulation->derivative(0.23, y, memory, dy);
  const VecX exact = dense.acceleration(0.23, scene().state.bodies);
  double difference = 0.0;
  for (int b = 0; b < scene().mechanism->bodies(); ++b)
    difference = std::max(difference, (formulation->acceleration()[b] - exact.segment<6>(6 * b)).norm());
  if (difference > 1e-6 * exact.norm()) state.SkipWithError("the two formulations disagree");
  for (auto _ : state) {
    formulation->derivative(0.23, y, memory, dy);
    benchmark::DoNotOptimize(dy.data());
  }
}
BENCHMARK(paper_right_hand_side)->Unit(benchmark::kMicrosecond);

void second_of_motion(benchmark::State& state, const char* name) {
  const auto rung = make_rung(name, scene().mechanism);
  RunOptions options;
  options.step = 1e-4;
  options.sample_spacing = 0.0;
  rung->run(scene().mechanism->parameters(), options);  // what is computed once for a mechanism is not timed
  for (auto _ : state) benchmark::DoNotOptimize(rung->run(scene().mechanism->parameters(), options).index);
}
BENCHMARK_CAPTURE(second_of_motion, multibody, "multibody")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(second_of_motion, perturbation, "perturbation")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(second_of_motion, quasistatic, "quasistatic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(second_of_motion, envelope, "envelope")->Unit(benchmark::kMillisecond);

void precomputation(benchmark::State& state) {
  for (auto _ : state) {
    const auto rung = make_rung("envelope", scene().mechanism);
    benchmark::DoNotOptimize(rung->run(scene().mechanism->parameters(), {}).index);
  }
}
BENCHMARK(precomputation)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace boresight
