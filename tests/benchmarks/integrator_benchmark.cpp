// Integrators on one right-hand side, that of the perturbation rung on the default scene at 0 and at 500 kg:
// ours, and CVODE and ARKODE of SUNDIALS where they are installed. All locate the contacts, all are asked for
// the same tolerance per step, and all are looked at on the same grid of 0.1 ms. Counters: right-hand sides;
// error of the largest position error, in percent of RODAS4 at a tolerance of 1e-7. CPU is the benchmark's
// own.
//   boresight_benchmarks --benchmark_filter=integrator
#include <benchmark/benchmark.h>

#include <map>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "boresight/perturbation/perturbation_system.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "scenes.hpp"

#ifdef BORESIGHT_SUNDIALS
#include "sundials_drive.hpp"
#endif

namespace boresight {
namespace {

constexpr double kGrid = 1e-4;

struct DrivenScene {
  explicit DrivenScene(int payload)
      : mechanism(scenes::build(scenes::rrcpr({{"payload.mass", std::to_string(payload) + " kg"}}))),
        prepared(*mechanism, ideal_motion(*mechanism, mechanism->parameters()), mechanism->parameters()),
        tables(prepared.tables(mechanism->parameters())),
        gain(&prepared.pose_gain(mechanism->boresight_body())),
        row(gain->width()) {}

  double position_error(double t, const double* z) const {
    gain->at(t, row.data());
    const int n = tables->layout.n;
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> E(row.data(), 3, n);
    return (E * Eigen::Map<const VecX>(z, n)).norm();
  }
  VecX tolerances(double tolerance) const {
    const int n = tables->layout.n;
    VecX all = VecX::Constant(2 * n, tolerance * smallest_clearance(mechanism->parameters()));
    all.tail(n) /= kFlightTime;
    return all;
  }

  std::shared_ptr<const Mechanism> mechanism;
  PreparedScene prepared;
  std::shared_ptr<const SceneTables> tables;
  const TimeTable* gain;
  mutable std::vector<double> row;
};

const DrivenScene& scene(int payload) {
  static std::map<int, DrivenScene> scenes;
  return scenes.try_emplace(payload, payload).first->second;
}

struct Reached {
  double largest = 0.0;
  long evaluations = 0;
};

template <typename M>
Reached ours(const DrivenScene& s, M method, double tolerance) {
  PerturbationSystem system(*s.mechanism, s.mechanism->parameters(), s.tables, false);
  VecX y = VecX::Zero(system.size()), inside = y;
  system.start_located(0.0, y);
  Integrator<M> integrator(std::move(method), system.gap_count());
  IntegrationOptions options{.relative_tolerance = 0.0};
  options.absolute_tolerances = s.tolerances(tolerance);
  options.largest_step = 0.01;
  Reached outcome;
  long point = 1;
  const IntegrationSummary summary =
      integrator.run(system, 0.0, s.mechanism->duration(), y, options, [&](const auto& step) {
        for (; kGrid * point <= step.end(); ++point) {
          step.at(kGrid * point, inside);
          outcome.largest = std::max(outcome.largest, s.position_error(kGrid * point, inside.data()));
        }
      });
  outcome.evaluations = summary.cost.evaluations;
  return outcome;
}

Reached dopri5(const DrivenScene& s, double tolerance) {
  return ours(s, ExplicitMethod(dormand_prince54(), 2 * s.tables->layout.n), tolerance);
}
Reached rosenbrock(const DrivenScene& s, double tolerance) {
  return ours(s, RosenbrockMethod(rodas4(), 2 * s.tables->layout.n), tolerance);
}

// Fixed steps of the paper's size that do not stop at contact: no tolerance.
Reached rk4(const DrivenScene& s, double) {
  PerturbationSystem system(*s.mechanism, s.mechanism->parameters(), s.tables, false);
  VecX y = VecX::Zero(system.size());
  ExplicitRungeKutta method(classical_rk4(), system.size());
  Reached outcome;
  const long steps = std::lround(s.mechanism->duration() / kGrid);
  for (long i = 0; i < steps; ++i) {
    const double t = kGrid * i;
    system.accept(t, y);
    system.derivative(t, y, method.first_slope());
    method.step(t, kGrid, y, [&](double at, const VecX& state, VecX& slope) { system.derivative(at, state, slope); });
    outcome.largest = std::max(outcome.largest, s.position_error(t + kGrid, y.data()));
    outcome.evaluations += 4;
  }
  return outcome;
}

#ifdef BORESIGHT_SUNDIALS

template <peers::SundialsMethod method>
Reached sundials(const DrivenScene& s, double tolerance) {
  PerturbationSystem system(*s.mechanism, s.mechanism->parameters(), s.tables, false);
  const VecX y = VecX::Zero(system.size());
  system.start_located(0.0, y);
  peers::SundialsRun<PerturbationSystem> run(system, y, s.tolerances(tolerance));
  Reached outcome;
  run.follow(method, s.mechanism->duration(), kGrid, [&](double t, const double* state) {
    outcome.largest = std::max(outcome.largest, s.position_error(t, state));
    return true;
  });
  outcome.evaluations = run.evaluations();
  return outcome;
}

#endif

void integrator(benchmark::State& state, Reached (*method)(const DrivenScene&, double), double tolerance) {
  const DrivenScene& s = scene(static_cast<int>(state.range(0)));
  static std::map<long, double> references;
  const auto [reference, fresh] = references.try_emplace(state.range(0), 0.0);
  if (fresh) reference->second = rosenbrock(s, 1e-7).largest;
  Reached outcome;
  for (auto _ : state) outcome = method(s, tolerance);
  state.counters["evaluations"] = static_cast<double>(outcome.evaluations);
  state.counters["index_error_%"] = 100.0 * std::abs(outcome.largest / reference->second - 1.0);
}
void at_both_loads(benchmark::internal::Benchmark* b) { b->Arg(0)->Arg(500)->Unit(benchmark::kMillisecond); }
BENCHMARK_CAPTURE(integrator, rk4_100us, rk4, 0.0)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, dopri5_1e4, dopri5, 1e-4)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, rosenbrock_1e3, rosenbrock, 1e-3)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, rosenbrock_1e4, rosenbrock, 1e-4)->Apply(at_both_loads);
#ifdef BORESIGHT_SUNDIALS
BENCHMARK_CAPTURE(integrator, cvode_bdf_1e3, sundials<peers::SundialsMethod::cvode_bdf>, 1e-3)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, cvode_bdf_1e4, sundials<peers::SundialsMethod::cvode_bdf>, 1e-4)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, arkode_erk_1e4, sundials<peers::SundialsMethod::arkode_erk>, 1e-4)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, arkode_dirk_1e3, sundials<peers::SundialsMethod::arkode_dirk>, 1e-3)
    ->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, arkode_dirk_1e4, sundials<peers::SundialsMethod::arkode_dirk>, 1e-4)
    ->Apply(at_both_loads);
#endif

}  // namespace
}  // namespace boresight
