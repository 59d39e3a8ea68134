// A window of a calibration near its fit, reduced to what any size of the jumps in it needs (model_error.hpp has the model):
//
//   r + X x + B w = noise      w ~ N(0, q^2 s^2), noise ~ N(0, s^2);  V = 1 + q^2 B B'
//
// B'B = U g U' once; then X'V^-1 X, X'V^-1 r and r'V^-1 r of any q take products with a diagonal.
#pragma once

#include <vector>

#include "boresight_analyses/calibration/calibration_problem.hpp"
#include "boresight_analyses/calibration/kept_fits.hpp"

namespace boresight {

// Of a direction that nothing sees: a large variance in place of an infinite one.
inline constexpr double kUnseenInformation = 1e-8;

struct ReducedWindow {
  MatX XX, Y;  // X'X; X'B U
  VecX Xr, y;  // X'r; U'B'r
  double rr = 0.0;
  VecX g;
  MatX BU;
  bool jumps = false;  // else w is a start state: B has its prior, whatever q is
  int run = 0;
};

inline void fields(Numbers& n, ReducedWindow& w) { n(w.XX, w.Y, w.Xr, w.y, w.rr, w.g, w.BU, w.jumps, w.run); }

// B: of the window's jumps from rest, else of its start state, its rows times `weight` where that is not empty. X: residuals x unknowns.
ReducedWindow reduced_window(const CalibrationProblem& problem, const Window& window, const Globals& at,
                             const WindowResiduals& residuals, const MatX& X, const VecX& r, const VecX& weight = {});
// Other residuals of the same window.
void take_residuals(const MatX& X, const VecX& r, ReducedWindow& window);

struct NormalEquations {
  MatX M;                          // X' V^-1 X
  VecX b;                          // X' V^-1 r
  double rr = 0.0, log_det = 0.0;  // r' V^-1 r; log det V
};

NormalEquations with_jumps(const ReducedWindow& window, double q);
// run: of that alone; -1: of all.
NormalEquations sum_with_jumps(const std::vector<ReducedWindow>& windows, double q, int run = -1);

struct NormalSolution {
  VecX x;
  MatX inverse;
  double rss = 0.0, log_det = 0.0;  // log det of the matrix
};

// Least (r + X x)' V^-1 (r + X x) + (d + x)' P (d + x), P diagonal. A direction that nothing sees gets a large variance.
NormalSolution solved(const NormalEquations& n, const VecX& prior, const VecX& distance);

// Sizes q that an unnamed jump may have, each as probable as any other but for the width that it stands for (log_width): q uniform.
struct JumpSizes {
  std::vector<double> q, log_width;
};
JumpSizes jump_sizes(const std::vector<ReducedWindow>& windows);

// Values that are measured in these windows.
long values_in(const CalibrationProblem& problem, const std::vector<int>& windows);

}  // namespace boresight
