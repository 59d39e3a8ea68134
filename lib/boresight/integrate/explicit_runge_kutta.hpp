// One explicit Runge-Kutta step of given size: the method as data (explicit_tables.hpp), one step function
// for all of them.
//
// `Integrator` takes its steps through ExplicitMethod. Loops of their own around step() stand where its events, dense output
// and error control would be another computation: the rungs' rk4, which is the paper's method (equal steps to multiples of h,
// contacts that begin inside a step placed afterwards by ContactTracker), and its ideal motion; and the stability analyses,
// which measure what the bare method does.
#pragma once

#include <vector>

#include "boresight/integrate/explicit_tables.hpp"

namespace boresight {

// One step of size h at a time. The vectors are sized once; step() allocates nothing.
class ExplicitRungeKutta {
 public:
  ExplicitRungeKutta(const ExplicitTable& table, Eigen::Index size)
      : table_(table), slope_(table.stages, VecX::Zero(size)), stage_(VecX::Zero(size)) {}

  // The slope at the start of the step: fill it before step(), so that a caller can look at it first.
  VecX& first_slope() { return slope_[0]; }
  // Slopes of the stages of the last step, from 0.
  const VecX& slope(int stage) const { return slope_[stage]; }
  const ExplicitTable& table() const { return table_; }

  // y: state at t, advanced in place. derivative(t, y, dy).
  template <typename Derivative>
  void step(double t, double h, VecX& y, Derivative&& derivative) {
    std::size_t entry = 0;
    for (int i = 1; i < table_.stages; ++i) {
      stage_ = y;
      for (int j = 0; j < i; ++j, ++entry)
        if (table_.a[entry] != 0.0) stage_.noalias() += (h * table_.a[entry]) * slope_[j];
      derivative(t + table_.c[i] * h, stage_, slope_[i]);
    }
    for (int i = 0; i < table_.stages; ++i) y.noalias() += (h * table_.b[i]) * slope_[i];
  }

 private:
  const ExplicitTable& table_;
  std::vector<VecX> slope_;
  VecX stage_;
};

}  // namespace boresight
