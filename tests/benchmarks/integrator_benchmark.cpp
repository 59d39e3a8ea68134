// Integrators on one right-hand side, that of the perturbation rung on the default scene at 0 and at 500 kg: ours, and
// CVODE and ARKODE of SUNDIALS where they are installed. All locate the contacts, all are asked for the same tolerance
// per step, and all are looked at on the same grid of 0.1 ms. Counters: right-hand sides; error of the largest position
// error, in percent of RODAS4 at a tolerance of 1e-7. CPU is the benchmark's own.
//   boresight_benchmarks --benchmark_filter=integrator
#include <benchmark/benchmark.h>

#include <map>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "boresight/rungs/ideal_simulation.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/rungs/perturbation_system.hpp"
#include "boresight/rungs/scene_rung.hpp"
#include "scenes.hpp"

#ifdef BORESIGHT_SUNDIALS
#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#endif

namespace boresight {
namespace {

constexpr double kGrid = 1e-4;

struct Scene {
  explicit Scene(int payload)
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

const Scene& scene(int payload) {
  static std::map<int, Scene> scenes;
  return scenes.try_emplace(payload, payload).first->second;
}

struct Outcome {
  double largest = 0.0;
  long evaluations = 0;
};

template <typename M>
Outcome ours(const Scene& s, M method, double tolerance) {
  PerturbationSystem system(*s.mechanism, s.mechanism->parameters(), s.tables, false);
  VecX y = VecX::Zero(system.size()), inside = y;
  system.start_located(0.0, y);
  Integrator<M> integrator(std::move(method), system.gap_count());
  IntegrationOptions options{.relative_tolerance = 0.0};
  options.absolute_tolerances = s.tolerances(tolerance);
  options.largest_step = 0.01;
  Outcome outcome;
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

Outcome dopri5(const Scene& s, double tolerance) {
  return ours(s, ExplicitMethod(dormand_prince54(), 2 * s.tables->layout.n), tolerance);
}
Outcome rosenbrock(const Scene& s, double tolerance) {
  return ours(s, RosenbrockMethod(rodas4(), 2 * s.tables->layout.n), tolerance);
}

// Fixed steps of the paper's size that do not stop at contact: no tolerance.
Outcome rk4(const Scene& s, double) {
  PerturbationSystem system(*s.mechanism, s.mechanism->parameters(), s.tables, false);
  VecX y = VecX::Zero(system.size());
  ExplicitRungeKutta method(classical_rk4(), system.size());
  Outcome outcome;
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

// What SUNDIALS is handed: the same system, copied in and out of its vectors.
struct Peer {
  explicit Peer(const Scene& s)
      : system(*s.mechanism, s.mechanism->parameters(), s.tables, false),
        y(VecX::Zero(system.size())),
        dy(y),
        g(VecX::Zero(system.gap_count())),
        J(system.size(), system.size()) {
    system.start_located(0.0, y);
  }
  PerturbationSystem system;
  VecX y, dy, g;
  MatX J;
  long evaluations = 0;

  static int rate(realtype t, N_Vector state, N_Vector slope, void* self) {
    Peer& p = *static_cast<Peer*>(self);
    p.y = Eigen::Map<const VecX>(N_VGetArrayPointer(state), p.y.size());
    p.system.derivative(t, p.y, p.dy);
    Eigen::Map<VecX>(N_VGetArrayPointer(slope), p.y.size()) = p.dy;
    ++p.evaluations;
    return p.dy.allFinite() ? 0 : 1;
  }
  static int gaps(realtype t, N_Vector state, realtype* gap, void* self) {
    Peer& p = *static_cast<Peer*>(self);
    p.y = Eigen::Map<const VecX>(N_VGetArrayPointer(state), p.y.size());
    p.system.gaps(t, p.y, p.g);
    std::copy(p.g.begin(), p.g.end(), gap);
    return 0;
  }
  static int jacobian(realtype t, N_Vector state, N_Vector, SUNMatrix out, void* self, N_Vector, N_Vector, N_Vector) {
    Peer& p = *static_cast<Peer*>(self);
    p.y = Eigen::Map<const VecX>(N_VGetArrayPointer(state), p.y.size());
    p.system.jacobian(t, p.y, p.J);
    for (Eigen::Index i = 0; i < p.y.size(); ++i)
      for (Eigen::Index j = 0; j < p.y.size(); ++j) SM_ELEMENT_D(out, i, j) = p.J(i, j);
    return 0;
  }
};

// evolve(tout, state, t) returns whether it stopped at a root; roots(found) and restart(t, state) are those of the
// package.
template <typename Evolve, typename Roots, typename Restart>
Outcome drive(const Scene& s, Peer& peer, N_Vector state, Evolve&& evolve, Roots&& roots, Restart&& restart) {
  Outcome outcome;
  std::vector<int> found(peer.system.gap_count());
  const long points = std::lround(s.mechanism->duration() / kGrid);
  for (long k = 1; k <= points; ++k) {
    realtype t = 0.0;
    while (evolve(kGrid * k, state, t)) {
      roots(found.data());
      peer.y = Eigen::Map<const VecX>(N_VGetArrayPointer(state), peer.y.size());
      for (int gap = 0; gap < peer.system.gap_count(); ++gap)
        if (found[gap] != 0)
          peer.system.on_event({gap, t, found[gap] < 0 ? Crossing::closing : Crossing::opening}, peer.y);
      restart(t, state);
    }
    outcome.largest = std::max(outcome.largest, s.position_error(kGrid * k, N_VGetArrayPointer(state)));
  }
  outcome.evaluations = peer.evaluations;
  return outcome;
}

// Vectors of one run.
struct Vectors {
  Vectors(const Scene& s, double tolerance) {
    SUNContext_Create(nullptr, &context);
    const VecX wanted = s.tolerances(tolerance);
    state = N_VNew_Serial(wanted.size(), context);
    absolute = N_VNew_Serial(wanted.size(), context);
    N_VConst(0.0, state);
    std::copy(wanted.begin(), wanted.end(), N_VGetArrayPointer(absolute));
    matrix = SUNDenseMatrix(wanted.size(), wanted.size(), context);
    solver = SUNLinSol_Dense(state, matrix, context);
  }
  ~Vectors() {
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    N_VDestroy(absolute);
    N_VDestroy(state);
    SUNContext_Free(&context);
  }
  SUNContext context = nullptr;
  N_Vector state = nullptr, absolute = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver solver = nullptr;
};

// Backward differences of variable order with the exact Jacobian, its defaults else.
Outcome cvode_bdf(const Scene& s, double tolerance) {
  Peer peer(s);
  Vectors v(s, tolerance);
  void* memory = CVodeCreate(CV_BDF, v.context);
  CVodeInit(memory, Peer::rate, 0.0, v.state);
  CVodeSetUserData(memory, &peer);
  CVodeSVtolerances(memory, 0.0, v.absolute);
  CVodeSetLinearSolver(memory, v.solver, v.matrix);
  CVodeSetJacFn(memory, Peer::jacobian);
  CVodeRootInit(memory, peer.system.gap_count(), Peer::gaps);
  CVodeSetNoInactiveRootWarn(memory);
  CVodeSetMaxNumSteps(memory, 1000000);
  const Outcome outcome = drive(
      s, peer, v.state,
      [&](double to, N_Vector y, realtype& t) { return CVode(memory, to, y, &t, CV_NORMAL) == CV_ROOT_RETURN; },
      [&](int* found) { CVodeGetRootInfo(memory, found); }, [&](double t, N_Vector y) { CVodeReInit(memory, t, y); });
  CVodeFree(&memory);
  return outcome;
}

// Explicit, order 4(3): its default.
Outcome arkode_erk(const Scene& s, double tolerance) {
  Peer peer(s);
  Vectors v(s, tolerance);
  void* memory = ERKStepCreate(Peer::rate, 0.0, v.state, v.context);
  ERKStepSetUserData(memory, &peer);
  ERKStepSVtolerances(memory, 0.0, v.absolute);
  ERKStepRootInit(memory, peer.system.gap_count(), Peer::gaps);
  ERKStepSetNoInactiveRootWarn(memory);
  ERKStepSetMaxNumSteps(memory, 1000000);
  const Outcome outcome = drive(
      s, peer, v.state,
      [&](double to, N_Vector y, realtype& t) {
        return ERKStepEvolve(memory, to, y, &t, ARK_NORMAL) == ARK_ROOT_RETURN;
      },
      [&](int* found) { ERKStepGetRootInfo(memory, found); },
      [&](double t, N_Vector y) { ERKStepReInit(memory, Peer::rate, t, y); });
  ERKStepFree(&memory);
  return outcome;
}

// Diagonally implicit, order 4(3), L-stable, with the exact Jacobian.
Outcome arkode_dirk(const Scene& s, double tolerance) {
  Peer peer(s);
  Vectors v(s, tolerance);
  void* memory = ARKStepCreate(nullptr, Peer::rate, 0.0, v.state, v.context);
  ARKStepSetUserData(memory, &peer);
  ARKStepSetOrder(memory, 4);
  ARKStepSVtolerances(memory, 0.0, v.absolute);
  ARKStepSetLinearSolver(memory, v.solver, v.matrix);
  ARKStepSetJacFn(memory, Peer::jacobian);
  ARKStepRootInit(memory, peer.system.gap_count(), Peer::gaps);
  ARKStepSetNoInactiveRootWarn(memory);
  ARKStepSetMaxNumSteps(memory, 1000000);
  const Outcome outcome = drive(
      s, peer, v.state,
      [&](double to, N_Vector y, realtype& t) {
        return ARKStepEvolve(memory, to, y, &t, ARK_NORMAL) == ARK_ROOT_RETURN;
      },
      [&](int* found) { ARKStepGetRootInfo(memory, found); },
      [&](double t, N_Vector y) { ARKStepReInit(memory, nullptr, Peer::rate, t, y); });
  ARKStepFree(&memory);
  return outcome;
}

#endif

void integrator(benchmark::State& state, Outcome (*method)(const Scene&, double), double tolerance) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  static std::map<long, double> references;
  const auto [reference, fresh] = references.try_emplace(state.range(0), 0.0);
  if (fresh) reference->second = rosenbrock(s, 1e-7).largest;
  Outcome outcome;
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
BENCHMARK_CAPTURE(integrator, cvode_bdf_1e3, cvode_bdf, 1e-3)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, cvode_bdf_1e4, cvode_bdf, 1e-4)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, arkode_erk_1e4, arkode_erk, 1e-4)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, arkode_dirk_1e3, arkode_dirk, 1e-3)->Apply(at_both_loads);
BENCHMARK_CAPTURE(integrator, arkode_dirk_1e4, arkode_dirk, 1e-4)->Apply(at_both_loads);
#endif

}  // namespace
}  // namespace boresight
