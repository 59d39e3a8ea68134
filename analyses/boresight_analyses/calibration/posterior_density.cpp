#include "boresight_analyses/calibration/posterior_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/math/eigenvalues.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// What the slopes need: at 1e-7, the fit's own, a small component of the gradient was off by a twenty-fifth of itself.
constexpr double kTolerance = 1e-8;

// What parameters can mimic of suspects: least |D - A S - F b|, over all windows. ridge: of the rows of S.
MatX mimicked(const std::vector<MatX>& A, const std::vector<MatX>& F, const std::vector<MatX>& D, const VecX& ridge) {
  const Eigen::Index d = A.front().cols(), flat = F.front().cols(), K = D.front().cols();
  MatX M = MatX::Zero(d + flat, d + flat), right = MatX::Zero(d + flat, K);
  for (std::size_t k = 0; k < A.size(); ++k) {
    MatX Z(A[k].rows(), d + flat);
    Z << A[k], F[k];
    M += Z.transpose() * Z;
    right += Z.transpose() * D[k];
  }
  VecX prior = VecX::Zero(d + flat);
  prior.head(d) = ridge;
  return (solved({M, VecX::Zero(d + flat), 0.0, 0.0}, prior, VecX::Zero(d + flat)).inverse * right).topRows(d);
}

}  // namespace

PosteriorDensity::PosteriorDensity(const CalibrationProblem& problem, const FitResult& fit,
                                   const std::vector<bool>& fixed, const std::vector<Suspect>& suspects,
                                   double variance_factor, double disagreement, int jobs)
    : problem_(problem), fitted_(fit.globals) {
  problem_.kept = nullptr;
  problem_.tolerance = std::min(problem_.tolerance, kTolerance);
  for (ModelCorrection& correction : problem_.corrections) correction.tangent.reset();
  for (int g = 0; g < problem_.bias_column(); ++g)
    if (g >= problem_.parameter_count() || !fixed[static_cast<std::size_t>(g)]) sampled_.push_back(g);
  lower_ = VecX::Constant(size(), -kInfinity);
  upper_ = VecX::Constant(size(), kInfinity);
  for (int k = 0; k < size(); ++k) {
    const int g = sampled_[static_cast<std::size_t>(k)];
    if (g < problem_.parameter_count()) {
      const FittedParameter& p = problem_.parameters[static_cast<std::size_t>(g)];
      lower_[k] = p.coordinate(p.lower);
      upper_[k] = p.coordinate(p.upper);
    } else if (problem_.fit_time_offset && g == problem_.time_offset_column()) {
      lower_[k] = -problem_.largest_time_offset;
      upper_[k] = problem_.largest_time_offset;
    } else {
      lower_[k] = 0.0;
    }
  }
  known_ = problem_.prior_information()(sampled_);
  told_ = problem_.packed(problem_.start())(sampled_);
  sharpness_ = 1.0 / std::max(1.0, disagreement * disagreement);
  prior_scale_ = variance_factor / sharpness_;
  flat_ = problem_.global_count() - problem_.bias_column();
  suspects_ = static_cast<Eigen::Index>(suspects.size());

  windows_.resize(fit.windows.size());
  std::vector<MatX> A(windows_.size()), F(windows_.size()), D(windows_.size());
  std::vector<WindowResiduals> at(windows_.size());
  const auto on_windows = [&](const std::function<void(std::size_t)>& work) {
    for_each_on_threads(windows_.size(), jobs, work);
  };
  on_windows([&](std::size_t k) {
    windows_[k].window = fit.windows[k];
    windows_[k].state = fit.states[k];
    problem_.evaluate(problem_.windows[fit.windows[k]], fitted_, fit.states[k], true, at[k]);
    windows_[k].r_fit = at[k].r;
    windows_[k].f_fit = at[k].r.unaryExpr([&](double x) { return problem_.loss.residual(x); });
    windows_[k].slope = at[k].r.unaryExpr([&](double x) { return problem_.loss.slope(x); });
    A[k] = windows_[k].slope.asDiagonal() * at[k].by_global(Eigen::all, sampled_);
    F[k] = windows_[k].slope.asDiagonal() * at[k].by_global.middleCols(problem_.bias_column(), flat_);
    D[k].resize(at[k].r.size(), suspects_);
    for (Eigen::Index s = 0; s < suspects_; ++s)
      D[k].col(s) = windows_[k].slope.cwiseProduct(suspects[static_cast<std::size_t>(s)].change[k]);
  });
  VecX ridge = known_;
  for (int k = 0; k < size(); ++k)
    if (const double range = upper_[k] - lower_[k]; std::isfinite(range)) ridge[k] += 12.0 / (range * range);
  mimics_ = mimicked(A, F, D, ridge);
  for (Eigen::Index s = 0; s < suspects_; ++s) {
    const Suspect& suspect = suspects[static_cast<std::size_t>(s)];
    if (suspect.as_parameter < 0) continue;
    mimics_.col(s).setZero();
    for (int k = 0; k < size(); ++k)
      if (sampled_[static_cast<std::size_t>(k)] == suspect.as_parameter) mimics_(k, s) = suspect.coordinate;
    for (std::size_t k = 0; k < windows_.size(); ++k) D[k].col(s) = A[k] * mimics_.col(s);
  }
  std::vector<ReducedWindow> full(windows_.size());
  on_windows([&](std::size_t k) {
    MatX Z(at[k].r.size(), size() + flat_ + suspects_);
    Z << A[k], F[k], D[k] - A[k] * mimics_;
    full[k] = reduced_window(problem_, problem_.windows[windows_[k].window], fitted_, at[k], Z, windows_[k].f_fit,
                             windows_[k].slope);
    const Eigen::Index linear = flat_ + suspects_;
    windows_[k].X = Z.rightCols(linear);
    windows_[k].reduced = full[k];
    windows_[k].reduced.XX = full[k].XX.bottomRightCorner(linear, linear);
    windows_[k].reduced.Y = full[k].Y.bottomRows(linear);
  });
  set_sizes(full, values_in(problem_, fit.windows));
}

void PosteriorDensity::set_sizes(const std::vector<ReducedWindow>& full, long values) {
  const Eigen::Index d = size(), linear = flat_ + suspects_;
  half_freedoms_ = 0.5 * sharpness_ * static_cast<double>(values - flat_);
  const VecX center = problem_.packed(fitted_)(sampled_), off = center - told_;
  // The priors' quadratic of (y, b, c): of the globals y - S c about what was told, and of c.
  MatX from(d, d + linear);
  from << MatX::Identity(d, d), MatX::Zero(d, flat_), -mimics_;
  MatX P = from.transpose() * known_.asDiagonal() * from;
  P.diagonal().tail(suspects_).array() += 1.0;
  const VecX pull = from.transpose() * known_.cwiseProduct(off);
  const JumpSizes jumps = jump_sizes(full);
  std::vector<NormalSolution> solutions;
  std::vector<double> log_weight;
  for (std::size_t j = 0; j < jumps.q.size(); ++j) {
    NormalEquations n = sum_with_jumps(full, jumps.q[j]);
    n.M += prior_scale_ * P;
    n.b += prior_scale_ * pull;
    n.rr += prior_scale_ * off.cwiseAbs2().dot(known_);
    solutions.push_back(solved(n, VecX::Zero(d + linear), VecX::Zero(d + linear)));
    const NormalSolution alone = solved({n.M.bottomRightCorner(linear, linear), VecX::Zero(linear), 0.0, n.log_det},
                                        VecX::Zero(linear), VecX::Zero(linear));
    sizes_.push_back({jumps.q[j], -0.5 * sharpness_ * (n.log_det + alone.log_det) + jumps.log_width[j], alone.inverse});
    log_weight.push_back(-0.5 * sharpness_ * (n.log_det + solutions.back().log_det) + jumps.log_width[j] -
                         half_freedoms_ * std::log(solutions.back().rss));
  }
  const double most = *std::max_element(log_weight.begin(), log_weight.end());
  double sum = 0.0;
  for (double& w : log_weight) sum += w = std::exp(w - most);
  mean_ = VecX::Zero(d);
  covariance_ = MatX::Zero(d, d);
  for (std::size_t j = 0; j < solutions.size(); ++j) mean_ += log_weight[j] / sum * solutions[j].x.head(d);
  for (std::size_t j = 0; j < solutions.size(); ++j) {
    const VecX from_mean = solutions[j].x.head(d) - mean_;
    covariance_ += log_weight[j] / sum *
                   (solutions[j].rss / (2.0 * half_freedoms_) * solutions[j].inverse.topLeftCorner(d, d) +
                    from_mean * from_mean.transpose());
  }
  mean_ = (mean_ + center).cwiseMax(lower_).cwiseMin(upper_);
}

bool PosteriorDensity::weigh(const VecX& y, bool slopes, Weighed& out) const {
  if (((y - lower_).array() < 0.0).any() || ((upper_ - y).array() < 0.0).any()) return false;
  VecX all = problem_.packed(fitted_);
  all(sampled_) = y;
  const Globals globals = problem_.unpacked(all);
  for (const PlacedWindow& placed : windows_) {
    WindowResiduals at;
    try {
      problem_.evaluate(problem_.windows[placed.window], globals, placed.state, slopes, at);
    } catch (const ComputationError&) {
      return false;
    }
    if (!at.r.allFinite()) return false;
    out.r.push_back(placed.f(at.r));
    if (slopes) out.J.push_back(placed.slope.asDiagonal() * at.by_global(Eigen::all, sampled_));
    out.reduced.push_back(placed.reduced);
    take_residuals(placed.X, out.r.back(), out.reduced.back());
  }
  const VecX off = y - told_;
  for (const Size& size : sizes_) {
    VecX b = VecX::Zero(flat_ + suspects_);
    b.tail(suspects_) = -prior_scale_ * mimics_.transpose() * known_.cwiseProduct(off);
    double rr = prior_scale_ * off.cwiseAbs2().dot(known_);
    for (const ReducedWindow& w : out.reduced) {
      const double s = w.jumps ? size.q * size.q : 1.0;
      const VecX fy = (s * w.y.array() / (1.0 + s * w.g.array())).matrix();
      b += w.Xr - w.Y * fy;
      rr += w.rr - w.y.dot(fy);
    }
    out.x.push_back(-(size.inverse * b));
    out.rss.push_back(std::max(rr + b.dot(out.x.back()), std::numeric_limits<double>::min()));
    out.share.push_back(size.weight - half_freedoms_ * std::log(out.rss.back()));
  }
  const double most = *std::max_element(out.share.begin(), out.share.end());
  double sum = 0.0;
  for (double& w : out.share) sum += w = std::exp(w - most);
  for (double& w : out.share) w /= sum;
  out.log_density = most + std::log(sum);
  return true;
}

double PosteriorDensity::log_density(const VecX& y, VecX& gradient) const {
  const bool slopes = gradient.size() > 0;
  if (slopes) gradient.setZero(y.size());
  Weighed at;
  if (!weigh(y, slopes, at)) return -kInfinity;
  if (!slopes) return at.log_density;
  // d RSS = 2 (V^-1 (r + X x))' dr: x stands where RSS is least.
  std::vector<double> pull;
  double of_r = 0.0;
  VecX of_X = VecX::Zero(flat_ + suspects_);
  for (std::size_t j = 0; j < sizes_.size(); ++j) {
    pull.push_back(at.share[j] * 2.0 * half_freedoms_ / at.rss[j]);
    of_r += pull[j];
    of_X += pull[j] * at.x[j];
  }
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    const ReducedWindow& w = at.reduced[k];
    VecX of_B = VecX::Zero(w.y.size());
    for (std::size_t j = 0; j < sizes_.size(); ++j) {
      const double s = w.jumps ? sizes_[j].q * sizes_[j].q : 1.0;
      of_B -= pull[j] * (s * (w.y + w.Y.transpose() * at.x[j]).array() / (1.0 + s * w.g.array())).matrix();
    }
    gradient -= at.J[k].transpose() * (of_r * at.r[k] + windows_[k].X * of_X + w.BU * of_B);
  }
  gradient -= prior_scale_ * known_.cwiseProduct(of_r * (y - told_) - mimics_ * of_X.tail(suspects_));
  return at.log_density;
}

VecX PosteriorDensity::drawn(const VecX& y, double uniform, const std::function<double(int)>& normal) const {
  Weighed at;
  if (suspects_ == 0 || !weigh(y, false, at)) return y;
  std::size_t j = 0;
  for (double below = at.share[0]; below < uniform && j + 1 < at.share.size(); below += at.share[j]) ++j;
  const MatX C = at.rss[j] / (2.0 * half_freedoms_) * sizes_[j].inverse.bottomRightCorner(suspects_, suspects_);
  VecX n(suspects_);
  for (int s = 0; s < suspects_; ++s) n[s] = normal(s);
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(C);
  const VecX c =
      at.x[j].tail(suspects_) + eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().cwiseProduct(n);
  return (y - mimics_ * c).cwiseMax(lower_).cwiseMin(upper_);
}

}  // namespace boresight
