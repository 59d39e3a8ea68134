// Rosenbrock methods as data: linearly implicit Runge-Kutta, one matrix decomposed a step and no iteration.
//
//   (I/(gamma h) - J) u_i = f(t + alpha_i h, y + sum_j a_ij u_j) + (1/h) sum_j c_ij u_j + d_i h df/dt,    j < i
//   y1 = y + sum m_i u_i,    error = sum e_i u_i,    J = df/dy and df/dt at (t, y)
//
// Dense output over a step:  y(theta) = (1 - theta) y0 + theta (y1 + (1 - theta) (sum p_i u_i + theta sum q_i u_i)).
//
// Both tables are L-stable and stiffly accurate (the last stage is the end of the step), so that a vibration
// much faster than the step is damped out instead of followed. They are held against the order conditions and
// R(z) in tests/lib/integrate. Source of the form: Hairer and Wanner (1996), Solving Ordinary Differential
// Equations II, equations IV.7.25 and 7.26.
#pragma once

#include <vector>

namespace boresight {

struct RosenbrockTable {
  const char* name;
  int order;
  int embedded_order;
  int dense_order;
  int stages;
  double gamma;
  std::vector<double> a, c;  // strictly lower triangles, row by row
  std::vector<double> m, e;
  std::vector<double> alpha, d;
  std::vector<double> p, q;  // dense output; q may be empty

  // Entry (i, j), j < i, of a strictly lower triangle.
  static double entry(const std::vector<double>& triangle, int i, int j) { return triangle[i * (i - 1) / 2 + j]; }
};

// Sandu, Verwer, Blom, Spee, Carmichael, Potra (1997), Benchmarking stiff ODE solvers for atmospheric
// chemistry problems II: Rosenbrock solvers, Atmospheric Environment 31, 3459-3472: RODAS3. Three evaluations
// a step, for loose tolerances. Its dense output is ours: the line from y0 to y1 and the parabola -(k2 - sum
// b_i k_i)/2, which the second-order condition asks for (k2 is the slope of stage 2).
inline const RosenbrockTable& rodas3() {
  static const RosenbrockTable table{.name = "RODAS3",
                                     .order = 3,
                                     .embedded_order = 2,
                                     .dense_order = 2,
                                     .stages = 4,
                                     .gamma = 0.5,
                                     .a = {0.0, 2.0, 0.0, 2.0, 0.0, 1.0},
                                     .c = {4.0, 1.0, -1.0, 1.0, -1.0, -8.0 / 3.0},
                                     .m = {2.0, 0.0, 1.0, 1.0},
                                     .e = {0.0, 0.0, 0.0, 1.0},
                                     .alpha = {0.0, 0.0, 1.0, 1.0},
                                     .d = {0.5, 1.5, 0.0, 0.0},
                                     .p = {3.0, -1.0, 0.5, 0.5},
                                     .q = {}};
  return table;
}

// Hairer and Wanner (1996), section IV.7: RODAS, order 4(3), six stages, dense output of order 3.
inline const RosenbrockTable& rodas4() {
  static const RosenbrockTable table{
      .name = "RODAS4",
      .order = 4,
      .embedded_order = 3,
      .dense_order = 3,
      .stages = 6,
      .gamma = 0.25,
      .a = {1.544, 0.9466785280815826, 0.2557011698983284, 3.314825187068521, 2.896124015972201, 0.9986419139977817,
            1.221224509226641, 6.019134481288629, 12.53708332932087,
            -0.6878860361058950,  //
            1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1.0},
      .c = {-5.6688, -2.430093356833875, -0.2063599157091915, -0.1073529058151375, -9.594562251023355,
            -20.47028614809616, 7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160,
            8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054},
      .m = {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1.0, 1.0},
      .e = {0.0, 0.0, 0.0, 0.0, 0.0, 1.0},
      .alpha = {0.0, 0.386, 0.21, 0.63, 1.0, 1.0},
      .d = {0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0},
      .p = {10.12623508344586, -7.487995877610167, -34.80091861555747, -7.992771707568823, 1.025137723295662, 0.0},
      .q = {-0.6762803392806454, 6.087714651680015, 16.43084320892478, 24.76722511418386, -6.594389125716872, 0.0}};
  return table;
}

}  // namespace boresight
