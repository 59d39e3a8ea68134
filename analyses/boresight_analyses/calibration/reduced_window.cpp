#include "boresight_analyses/calibration/reduced_window.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/math/eigenvalues.hpp"

namespace boresight {
namespace {

// Stretches of a run between jumps. More of them change no answer: what happens within one is a jump at its beginning.
constexpr int kJumps = 16;
// q: from where it changes nothing to where every stretch begins anywhere in its clearance.
constexpr double kLeastJump = 1e-7, kLargestJump = 1.0;
constexpr int kJumpsADecade = 4;

}  // namespace

ReducedWindow reduced_window(const CalibrationProblem& problem, const Window& w, const Globals& globals,
                             const WindowResiduals& at, const MatX& X, const VecX& r, const VecX& weight) {
  MatX B = w.from_rest && problem.state_size(w) > 0 ? problem.by_jumps(w, globals, kJumps)
                                                    : MatX(at.by_state * problem.prior_deviation(w).asDiagonal());
  if (weight.size() > 0 && B.cols() > 0) B = (weight.asDiagonal() * B).eval();
  ReducedWindow out;
  if (B.cols() > 0) {
    const Eigen::SelfAdjointEigenSolver<MatX> eigen(MatX(B.transpose() * B));
    out.g = eigen.eigenvalues().cwiseMax(0.0);
    out.BU = B * eigen.eigenvectors();
  } else {
    out.BU = B;  // nothing of the motion may have moved: errors alone are fitted
  }
  out.XX = X.transpose() * X;
  out.Y = X.transpose() * out.BU;
  out.jumps = w.from_rest && B.cols() > 0;
  out.run = w.run;
  take_residuals(X, r, out);
  return out;
}

void take_residuals(const MatX& X, const VecX& r, ReducedWindow& w) {
  w.Xr = X.transpose() * r;
  w.rr = r.squaredNorm();
  w.y = w.BU.transpose() * r;
}

NormalEquations with_jumps(const ReducedWindow& w, double q) {
  const double s = w.jumps ? q * q : 1.0;
  const VecX f = (s / (1.0 + s * w.g.array())).matrix();
  return {w.XX - w.Y * f.asDiagonal() * w.Y.transpose(), w.Xr - w.Y * f.cwiseProduct(w.y),
          w.rr - w.y.cwiseAbs2().dot(f), (s * w.g.array()).log1p().sum()};
}

NormalEquations sum_with_jumps(const std::vector<ReducedWindow>& windows, double q, int run) {
  NormalEquations sum;
  for (const ReducedWindow& w : windows) {
    if (run >= 0 && w.run != run) continue;
    const NormalEquations n = with_jumps(w, q);
    if (sum.M.size() == 0) {
      sum = n;
      continue;
    }
    sum.M += n.M;
    sum.b += n.b;
    sum.rr += n.rr;
    sum.log_det += n.log_det;
  }
  return sum;
}

NormalSolution solved(const NormalEquations& n, const VecX& prior, const VecX& distance) {
  if (n.M.size() == 0) return {VecX(), MatX(), n.rr, 0.0};  // all are held
  MatX M = n.M;
  M.diagonal() = (M.diagonal() + prior).cwiseMax(kUnseenInformation);
  const VecX b = -(n.b + prior.cwiseProduct(distance));
  // By columns scaled to one size.
  const VecX scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(MatX(scale.asDiagonal() * M * scale.asDiagonal()));
  const VecX values = eigen.eigenvalues().cwiseMax(1e-13);
  NormalSolution s;
  s.inverse = scale.asDiagonal() * eigen.eigenvectors() * values.cwiseInverse().asDiagonal() *
              eigen.eigenvectors().transpose() * scale.asDiagonal();
  s.x = s.inverse * b;
  s.rss = n.rr + distance.cwiseAbs2().dot(prior) - b.dot(s.x);
  s.log_det = values.array().log().sum() - 2.0 * scale.array().log().sum();
  return s;
}

JumpSizes jump_sizes(const std::vector<ReducedWindow>& windows) {
  if (std::none_of(windows.begin(), windows.end(), [](const ReducedWindow& w) { return w.jumps; }))
    return {{0.0}, {0.0}};
  JumpSizes sizes;
  const int count = static_cast<int>(std::lround(kJumpsADecade * std::log10(kLargestJump / kLeastJump)));
  for (int k = 0; k <= count; ++k) {
    sizes.q.push_back(kLeastJump * std::pow(kLargestJump / kLeastJump, double(k) / count));
    sizes.log_width.push_back(std::log(sizes.q.back()));
  }
  return sizes;
}

long values_in(const CalibrationProblem& problem, const std::vector<int>& windows) {
  long values = 0;
  for (const int w : windows) {
    const Window& window = problem.windows[w];
    values += problem.runs[window.run]
                  .data.value.middleRows(window.first, window.last - window.first + 1)
                  .array()
                  .isFinite()
                  .count();
  }
  return values;
}

}  // namespace boresight
