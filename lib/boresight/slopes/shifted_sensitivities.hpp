// s I - df/dY of a SensitiveSystem, for linearly implicit steps: its blocks are
//
//   [ s I - f_y        0      ]   y
//   [   -B_d       s I - f_y  ]   each column S_d of the sensitivity,      B_d = d(f_y S_d + ...)/dy,
//
// so that one decomposition of the size of y does for all columns. f_y is exact, B_d by forward differences of the right-hand side.
#pragma once

#include "boresight/integrate/shifted_jacobian.hpp"

namespace boresight {

// W: columns of the sensitivity, stored row by row behind y.
template <int W>
class ShiftedSensitivities {
 public:
  explicit ShiftedSensitivities(Eigen::Index size)
      : n_(size / (1 + W)), time_(VecX::Zero(size)), moved_(time_), f_(time_), by_y_(size - n_, n_), lu_(n_) {}

  template <typename S>
  void evaluate(const S& system, double t, const VecX& Y, const VecX& f0, MethodCost& cost) {
    ++cost.jacobians;
    system.state_jacobian(t, Y, f_y_);
    moved_ = Y;
    for (Eigen::Index i = 0; i < n_; ++i) {
      moved_[i] = Y[i] + difference_increment(Y[i]);
      system.derivative(t, moved_, f_);
      by_y_.col(i) = (f_ - f0).tail(W * n_) / (moved_[i] - Y[i]);
      moved_[i] = Y[i];
    }
    const double later = t + difference_increment(t);
    system.derivative(later, Y, f_);
    time_ = (f_ - f0) / (later - t);
    cost.evaluations += n_ + 1;
  }
  const MatX& jacobian() const { return f_y_; }  // of y alone
  const VecX& time() const { return time_; }

  bool decompose(double shift) {
    matrix_ = -f_y_;
    matrix_.diagonal().array() += shift;
    lu_.compute(matrix_);
    return ShiftedJacobian::is_regular(lu_);
  }
  void solve(const VecX& b, VecX& x) {
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, W, Eigen::RowMajor>;
    x.resize(b.size());
    x.head(n_) = lu_.solve(b.head(n_));
    const VecX rest = b.tail(W * n_) + by_y_ * x.head(n_);
    Eigen::Map<Columns>(x.data() + n_, n_, W) = lu_.solve(Eigen::Map<const Columns>(rest.data(), n_, W));
  }

 private:
  Eigen::Index n_;
  VecX time_, moved_, f_;
  MatX f_y_, by_y_, matrix_;
  Eigen::PartialPivLU<MatX> lu_;
};

}  // namespace boresight
