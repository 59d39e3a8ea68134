// Explicit Runge-Kutta with a fixed step: the method as data (a Butcher table), one step function for all of them.
// Source of the tables: Hairer, Norsett, Wanner (1993), Solving Ordinary Differential Equations I, section II.1.
#pragma once

#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

struct ExplicitTable {
  const char* name;
  int order;
  int stages;
  std::vector<double> a;  // strictly lower triangle, row by row: a21, a31, a32, ...
  std::vector<double> b, c;
  // Where |R(z)| first exceeds 1 on the negative real and on the imaginary axis.
  double real_limit, imaginary_limit;
};

// Kutta's classical method (1901): the paper's integrator.
inline const ExplicitTable& classical_rk4() {
  static const ExplicitTable table{"RK4",
                                   4,
                                   4,
                                   {0.5, 0.0, 0.5, 0.0, 0.0, 1.0},
                                   {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0},
                                   {0.0, 0.5, 0.5, 1.0},
                                   2.785293563405282,
                                   2.8284271247461903};
  return table;
}

// One step of size h at a time. The vectors are sized once; step() allocates nothing.
class ExplicitRungeKutta {
 public:
  ExplicitRungeKutta(const ExplicitTable& table, Eigen::Index size)
      : table_(table), slope_(table.stages, VecX::Zero(size)), stage_(VecX::Zero(size)) {}

  // The slope at the start of the step: fill it before step(), so that a caller can look at it first.
  VecX& first_slope() { return slope_[0]; }

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
