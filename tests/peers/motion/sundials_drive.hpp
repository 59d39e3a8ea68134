// SUNDIALS' integrators (Hindmarsh et al. 2005, ACM TOMS 31, 363-396; Reynolds et al. 2023, ACM TOMS 49) on a
// right-hand side of ours: PerturbationSystem or MultibodySystem. They get the system's own Jacobian and find
// its contacts as roots, as ours do.
//
//   SundialsRun run(system, y, tolerances);
//   run.follow(SundialsMethod::cvode_bdf, duration, grid, [&](double t, const double* y) { ... });
#pragma once

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "boresight/integrate/system.hpp"
#include "boresight/math/types.hpp"

namespace boresight::peers {

enum class SundialsMethod {
  cvode_bdf,    // backward differences of variable order
  cvode_adams,  // Adams-Moulton of variable order, solved by Newton
  arkode_erk,   // explicit, order 4(3): its default
  arkode_dirk,  // diagonally implicit, order 4(3), L-stable
};

template <typename System>
class SundialsRun {
 public:
  // start: the state at t = 0, which the system has been started with; tolerances: absolute, one per number
  // of the state.
  SundialsRun(System& system, const VecX& start, const VecX& tolerances)
      : system_(system), y_(start), dy_(start), g_(VecX::Zero(system.gap_count())), J_(start.size(), start.size()) {
    SUNContext_Create(nullptr, &context_);
    state_ = N_VNew_Serial(start.size(), context_);
    absolute_ = N_VNew_Serial(start.size(), context_);
    std::copy(start.begin(), start.end(), N_VGetArrayPointer(state_));
    std::copy(tolerances.begin(), tolerances.end(), N_VGetArrayPointer(absolute_));
    matrix_ = SUNDenseMatrix(start.size(), start.size(), context_);
    solver_ = SUNLinSol_Dense(state_, matrix_, context_);
  }
  ~SundialsRun() {
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(absolute_);
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }
  SundialsRun(const SundialsRun&) = delete;

  long evaluations() const { return evaluations_; }
  long steps() const { return steps_; }

  // observe(t, y) sees the state at every point of a grid, and returns whether to go on. Throws
  // std::runtime_error where the solver gives up.
  template <typename Observe>
  void follow(SundialsMethod method, double duration, double grid, Observe&& observe) {
    switch (method) {
      case SundialsMethod::cvode_bdf:
        return cvode(CV_BDF, duration, grid, observe);
      case SundialsMethod::cvode_adams:
        return cvode(CV_ADAMS, duration, grid, observe);
      case SundialsMethod::arkode_erk:
        return erk(duration, grid, observe);
      case SundialsMethod::arkode_dirk:
        return dirk(duration, grid, observe);
    }
  }

 private:
  static constexpr long kMostSteps = 1000000;
  // Of CVODE [s]: its multistep methods step over short contacts where tolerances are loose, and a contact
  // that begins and ends within a step leaves no sign for the root search.
  static constexpr double kLargestStep = 1e-4;

  const VecX& read(N_Vector state) {
    y_ = Eigen::Map<const VecX>(N_VGetArrayPointer(state), y_.size());
    return y_;
  }
  static int rate(realtype t, N_Vector state, N_Vector slope, void* self) {
    SundialsRun& r = *static_cast<SundialsRun*>(self);
    r.system_.derivative(t, r.read(state), r.dy_);
    Eigen::Map<VecX>(N_VGetArrayPointer(slope), r.y_.size()) = r.dy_;
    ++r.evaluations_;
    return r.dy_.allFinite() ? 0 : 1;
  }
  static int gaps(realtype t, N_Vector state, realtype* gap, void* self) {
    SundialsRun& r = *static_cast<SundialsRun*>(self);
    r.system_.gaps(t, r.read(state), r.g_);
    std::copy(r.g_.begin(), r.g_.end(), gap);
    return 0;
  }
  static int jacobian(realtype t, N_Vector state, N_Vector, SUNMatrix out, void* self, N_Vector, N_Vector, N_Vector) {
    SundialsRun& r = *static_cast<SundialsRun*>(self);
    r.system_.jacobian(t, r.read(state), r.J_);
    for (Eigen::Index i = 0; i < r.y_.size(); ++i)
      for (Eigen::Index j = 0; j < r.y_.size(); ++j) SM_ELEMENT_D(out, i, j) = r.J_(i, j);
    return 0;
  }

  template <typename Observe>
  void cvode(int multistep, double duration, double grid, Observe&& observe) {
    void* memory = CVodeCreate(multistep, context_);
    CVodeInit(memory, rate, 0.0, state_);
    CVodeSetUserData(memory, this);
    CVodeSVtolerances(memory, 0.0, absolute_);
    CVodeSetLinearSolver(memory, solver_, matrix_);
    CVodeSetJacFn(memory, jacobian);
    CVodeRootInit(memory, system_.gap_count(), gaps);
    CVodeSetNoInactiveRootWarn(memory);
    CVodeSetErrFile(memory, nullptr);
    CVodeSetMaxNumSteps(memory, kMostSteps);
    CVodeSetMaxStep(memory, kLargestStep);
    drive(
        memory, CVodeFree, duration, grid, observe,
        [&](double to, realtype& t) { return CVode(memory, to, state_, &t, CV_NORMAL); },
        [&](int* found) { CVodeGetRootInfo(memory, found); }, [&](double t) { CVodeReInit(memory, t, state_); },
        [&](long& steps) { CVodeGetNumSteps(memory, &steps); });
  }
  template <typename Observe>
  void erk(double duration, double grid, Observe&& observe) {
    void* memory = ERKStepCreate(rate, 0.0, state_, context_);
    ERKStepSetUserData(memory, this);
    ERKStepSVtolerances(memory, 0.0, absolute_);
    ERKStepRootInit(memory, system_.gap_count(), gaps);
    ERKStepSetNoInactiveRootWarn(memory);
    ERKStepSetErrFile(memory, nullptr);
    ERKStepSetMaxNumSteps(memory, kMostSteps);
    drive(
        memory, ERKStepFree, duration, grid, observe,
        [&](double to, realtype& t) { return ERKStepEvolve(memory, to, state_, &t, ARK_NORMAL); },
        [&](int* found) { ERKStepGetRootInfo(memory, found); },
        [&](double t) { ERKStepReInit(memory, rate, t, state_); },
        [&](long& steps) { ERKStepGetNumSteps(memory, &steps); });
  }
  template <typename Observe>
  void dirk(double duration, double grid, Observe&& observe) {
    void* memory = ARKStepCreate(nullptr, rate, 0.0, state_, context_);
    ARKStepSetUserData(memory, this);
    ARKStepSetOrder(memory, 4);
    ARKStepSVtolerances(memory, 0.0, absolute_);
    ARKStepSetLinearSolver(memory, solver_, matrix_);
    ARKStepSetJacFn(memory, jacobian);
    ARKStepRootInit(memory, system_.gap_count(), gaps);
    ARKStepSetNoInactiveRootWarn(memory);
    ARKStepSetErrFile(memory, nullptr);
    ARKStepSetMaxNumSteps(memory, kMostSteps);
    drive(
        memory, ARKStepFree, duration, grid, observe,
        [&](double to, realtype& t) { return ARKStepEvolve(memory, to, state_, &t, ARK_NORMAL); },
        [&](int* found) { ARKStepGetRootInfo(memory, found); },
        [&](double t) { ARKStepReInit(memory, nullptr, rate, t, state_); },
        [&](long& steps) { ARKStepGetNumSteps(memory, &steps); });
  }

  // The same for all: from point to point, stopping at contacts, where the solver starts afresh.
  template <typename Free, typename Observe, typename Evolve, typename Roots, typename Restart, typename Steps>
  void drive(void*& memory, Free free, double duration, double grid, Observe&& observe, Evolve&& evolve, Roots&& roots,
             Restart&& restart, Steps&& steps_of) {
    static_assert(CV_ROOT_RETURN == ARK_ROOT_RETURN);
    struct Freed {
      void*& memory;
      Free free;
      ~Freed() { free(&memory); }
    } freed{memory, free};
    std::vector<int> found(system_.gap_count());
    const auto count = [&] {
      long n = 0;
      steps_of(n);
      steps_ += n;
    };
    const long points = std::lround(duration / grid);
    for (long k = 1; k <= points; ++k) {
      realtype t = 0.0;
      for (;;) {
        const int flag = evolve(grid * static_cast<double>(k), t);
        if (flag < 0)
          throw std::runtime_error("SUNDIALS gives up at t = " + std::to_string(t) + " s (flag " +
                                   std::to_string(flag) + ")");
        if (flag != CV_ROOT_RETURN) break;
        roots(found.data());
        read(state_);
        for (int gap = 0; gap < system_.gap_count(); ++gap)
          if (found[gap] != 0) system_.on_event({gap, t, found[gap] < 0 ? Crossing::closing : Crossing::opening}, y_);
        std::copy(y_.begin(), y_.end(), N_VGetArrayPointer(state_));
        count();  // a restart sets the solver's own count to zero
        restart(t);
      }
      if (!observe(grid * static_cast<double>(k), static_cast<const double*>(N_VGetArrayPointer(state_)))) break;
    }
    count();
  }

  System& system_;
  VecX y_, dy_, g_;
  MatX J_;
  long evaluations_ = 0, steps_ = 0;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr, absolute_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

}  // namespace boresight::peers
