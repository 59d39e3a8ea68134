// s I - df/dy as linearly implicit methods solve with it: dense, decomposed once a shift.
#pragma once

#include <Eigen/LU>

#include "boresight/integrate/partial_derivatives.hpp"

namespace boresight {

class ShiftedJacobian {
 public:
  explicit ShiftedJacobian(Eigen::Index size) : partial_(size), matrix_(size, size), lu_(size) {}

  // df/dy and df/dt at (t, y); f0: the right-hand side there.
  template <System S>
  void evaluate(const S& system, double t, const VecX& y, const VecX& f0, MethodCost& cost) {
    partial_.evaluate(system, t, y, f0, cost);
  }
  const MatX& jacobian() const { return partial_.jacobian; }
  const VecX& time() const { return partial_.time; }

  // Whether shift I - df/dy can be solved with.
  bool decompose(double shift) {
    matrix_ = -partial_.jacobian;
    matrix_.diagonal().array() += shift;
    lu_.compute(matrix_);
    return is_regular(lu_);
  }
  void solve(const VecX& b, VecX& x) const { x = lu_.solve(b); }

  // A zero or a not-a-number on the diagonal of U: products of pivots could overflow.
  static bool is_regular(const Eigen::PartialPivLU<MatX>& lu) {
    return lu.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0;
  }

 private:
  PartialDerivatives partial_;
  MatX matrix_;
  Eigen::PartialPivLU<MatX> lu_;
};

}  // namespace boresight
