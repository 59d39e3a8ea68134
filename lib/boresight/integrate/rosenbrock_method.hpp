// Rosenbrock methods for the Integrator: any table of rosenbrock_tables.hpp. One Jacobian an accepted step, one
// decomposition an attempt, no iteration that could fail. Meant for contacts that rest: their vibration is stepped over
// once it is below the tolerance, where an explicit method goes on following it.
//
// lanes/lane_rosenbrock.hpp takes the same tables through another elimination: for zddot = f(t, z, zdot) the system of 2n folds
// into n, without pivots, in the lanes' own precision. The folding is what makes a lane's step cheap; here y' = f(t, y) may be any.
#pragma once

#include <limits>
#include <vector>

#include "boresight/integrate/rosenbrock_tables.hpp"
#include "boresight/integrate/shifted_jacobian.hpp"

namespace boresight {

// Shifted: what holds df/dy and solves with it, as ShiftedJacobian does.
template <typename Shifted>
class RosenbrockWith {
 public:
  RosenbrockWith(const RosenbrockTable& table, Eigen::Index size)
      : table_(table),
        shifted_(size),
        u_(table.stages, VecX::Zero(size)),
        start_(VecX::Zero(size)),
        proposed_(start_),
        error_(start_),
        start_slope_(start_),
        end_slope_(start_),
        slope_(start_),
        stage_(start_) {}

  const char* name() const { return table_.name; }
  int order() const { return table_.order; }
  int error_order() const { return table_.embedded_order; }
  Eigen::Index size() const { return start_.size(); }
  const VecX& proposed() const { return proposed_; }
  const VecX& error() const { return error_; }
  const VecX& start_slope() const { return start_slope_; }
  double step_stiffness() const { return 0.0; }
  double stability_limit() const { return std::numeric_limits<double>::infinity(); }
  MethodCost& cost() { return cost_; }

  template <System S>
  void begin(const S& system, double t, const VecX& y) {
    system.derivative(t, y, start_slope_);
    ++cost_.evaluations;
    partial_known_ = false;
  }

  // df/dy at the state that the next attempt starts from.
  template <System S>
  const MatX& jacobian(const S& system, double t, const VecX& y) {
    if (!partial_known_) shifted_.evaluate(system, t, y, start_slope_, cost_);
    partial_known_ = true;
    return shifted_.jacobian();
  }

  template <System S>
  Attempt attempt(const S& system, double t, double h, const VecX& y) {
    start_ = y;
    jacobian(system, t, y);
    ++cost_.decompositions;
    if (!shifted_.decompose(1.0 / (table_.gamma * h))) return Attempt::singular_matrix;
    slope_ = start_slope_;
    for (int i = 0; i < table_.stages; ++i) {
      if (i > 0 && moves(i)) {
        stage_ = y;
        for (int j = 0; j < i; ++j) add(stage_, RosenbrockTable::entry(table_.a, i, j), u_[j]);
        system.derivative(t + table_.alpha[i] * h, stage_, slope_);
        ++cost_.evaluations;
      }
      stage_ = slope_;
      for (int j = 0; j < i; ++j) add(stage_, RosenbrockTable::entry(table_.c, i, j) / h, u_[j]);
      if constexpr (!Autonomous<S>) add(stage_, table_.d[i] * h, shifted_.time());
      shifted_.solve(stage_, u_[i]);
    }
    proposed_ = y;
    error_.setZero();
    for (int i = 0; i < table_.stages; ++i) {
      add(proposed_, table_.m[i], u_[i]);
      add(error_, table_.e[i], u_[i]);
    }
    return Attempt::done;
  }

  template <System S>
  void finish(const S& system, double t_end) {
    system.derivative(t_end, proposed_, end_slope_);
    ++cost_.evaluations;
  }

  void interpolate(double share, VecX& out) const {
    const double rest = 1.0 - share;
    out.noalias() = rest * start_ + share * proposed_;
    for (int i = 0; i < table_.stages; ++i)
      add(out, share * rest * (table_.p[i] + (table_.q.empty() ? 0.0 : share * table_.q[i])), u_[i]);
  }

  // The state moved a little after the step was taken.
  template <System S>
  void refresh(const S& system, double t, const VecX& y) {
    system.derivative(t, y, start_slope_);
    ++cost_.evaluations;
  }

  void advance() {
    start_slope_.swap(end_slope_);
    partial_known_ = false;
  }

 private:
  static void add(VecX& sum, double factor, const VecX& term) {
    if (factor != 0.0) sum.noalias() += factor * term;
  }
  // Whether stage i is evaluated anywhere else than the stage before it.
  bool moves(int i) const {
    if (table_.alpha[i] != table_.alpha[i - 1]) return true;
    for (int j = 0; j < i; ++j)
      if (RosenbrockTable::entry(table_.a, i, j) != (j < i - 1 ? RosenbrockTable::entry(table_.a, i - 1, j) : 0.0))
        return true;
    return false;
  }

  const RosenbrockTable& table_;
  Shifted shifted_;
  bool partial_known_ = false;
  std::vector<VecX> u_;
  VecX start_, proposed_, error_, start_slope_, end_slope_, slope_, stage_;
  MethodCost cost_;
};

using RosenbrockMethod = RosenbrockWith<ShiftedJacobian>;

}  // namespace boresight
