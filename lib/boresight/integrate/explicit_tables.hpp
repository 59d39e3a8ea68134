// Explicit Runge-Kutta methods as data: Butcher tables with their embedded error weights, dense output and
// stability limits.
//
//   k_i = f(t + c_i h, y + h sum_j a_ij k_j),   y1 = y + h sum b_i k_i,   error = h sum (b_i - b^_i) k_i
//
// Dense output over a step is the cubic through both ends and their slopes, with one term added where the
// table has it:
//   y(theta) = Hermite(y0, h f0, y1, h f1; theta) + theta^2 (1 - theta)^2 h sum d_i k_i,   0 <= theta <= 1.
//
// Every number here is held against the order conditions and the stability function in tests/lib/integrate.
// Source of the form: Hairer, Norsett, Wanner (1993), Solving Ordinary Differential Equations I, sections
// II.1, II.4, II.6.
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

  std::vector<double> b_embedded{};  // b^; empty: the method has no error estimate
  int embedded_order = 0;
  std::vector<double> d{};  // of the dense output; empty: the Hermite cubic alone
  int dense_order = 3;
  // Two stages (from 0) at the same time t + c h: the ratio of the differences of their slopes and of their
  // states measures the stiffest rate that the step has met. Hairer and Wanner (1996), equation IV.2.8. Both
  // 0: not measured.
  int stiffness_stages[2] = {0, 0};

  // The last stage is the state at the end of the step, its slope the first one of the next step.
  bool first_same_as_last() const { return !c.empty() && c.back() == 1.0 && b.back() == 0.0 && ends_in_weights(); }

 private:
  bool ends_in_weights() const {
    for (int i = 0; i + 1 < stages; ++i)
      if (a[a.size() - (stages - 1) + i] != b[i]) return false;
    return true;
  }
};

// Kutta's classical method (1901): the paper's integrator.
inline const ExplicitTable& classical_rk4() {
  static const ExplicitTable table{.name = "RK4",
                                   .order = 4,
                                   .stages = 4,
                                   .a = {0.5, 0.0, 0.5, 0.0, 0.0, 1.0},
                                   .b = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0},
                                   .c = {0.0, 0.5, 0.5, 1.0},
                                   .real_limit = 2.785293563405282,
                                   .imaginary_limit = 2.8284271247461903,
                                   .stiffness_stages = {1, 2}};
  return table;
}

// Bogacki and Shampine (1989), A 3(2) pair of Runge-Kutta formulas, Applied Mathematics Letters 2, 321-325:
// for loose tolerances.
inline const ExplicitTable& bogacki_shampine32() {
  static const ExplicitTable table{.name = "Bogacki-Shampine 3(2)",
                                   .order = 3,
                                   .stages = 4,
                                   .a = {1.0 / 2.0, 0.0, 3.0 / 4.0, 2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0},
                                   .b = {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0, 0.0},
                                   .c = {0.0, 1.0 / 2.0, 3.0 / 4.0, 1.0},
                                   .real_limit = 2.5127453266183286,
                                   .imaginary_limit = 1.7320508075688772,
                                   .b_embedded = {7.0 / 24.0, 1.0 / 4.0, 1.0 / 3.0, 1.0 / 8.0},
                                   .embedded_order = 2};
  return table;
}

// Dormand and Prince (1980), A family of embedded Runge-Kutta formulae, Journal of Computational and Applied
// Mathematics 6, 19-26: table RK5(4)7M. Dense output of order 4: Hairer, Norsett, Wanner (1993), section
// II.6.
inline const ExplicitTable& dormand_prince54() {
  static const ExplicitTable table{
      .name = "Dormand-Prince 5(4)",
      .order = 5,
      .stages = 7,
      .a = {1.0 / 5.0,                      //
            3.0 / 40.0,        9.0 / 40.0,  //
            44.0 / 45.0,       -56.0 / 15.0,
            32.0 / 9.0,  //
            19372.0 / 6561.0,  -25360.0 / 2187.0,
            64448.0 / 6561.0,  -212.0 / 729.0,  //
            9017.0 / 3168.0,   -355.0 / 33.0,
            46732.0 / 5247.0,  49.0 / 176.0,
            -5103.0 / 18656.0,  //
            35.0 / 384.0,      0.0,
            500.0 / 1113.0,    125.0 / 192.0,
            -2187.0 / 6784.0,  11.0 / 84.0},
      .b = {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0},
      .c = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0},
      .real_limit = 3.306567892634947,
      .imaginary_limit = 0.9971890086325299,
      .b_embedded = {5179.0 / 57600.0, 0.0, 7571.0 / 16695.0, 393.0 / 640.0, -92097.0 / 339200.0, 187.0 / 2100.0,
                     1.0 / 40.0},
      .embedded_order = 4,
      .d = {-12715105075.0 / 11282082432.0, 0.0, 87487479700.0 / 32700410799.0, -10690763975.0 / 1880347072.0,
            701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0, 69997945.0 / 29380423.0},
      .dense_order = 4,
      .stiffness_stages = {5, 6}};
  return table;
}

}  // namespace boresight
