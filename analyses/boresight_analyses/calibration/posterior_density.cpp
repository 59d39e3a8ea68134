#include "boresight_analyses/calibration/posterior_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/math/eigenvalues.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/noise_scales.hpp"

namespace boresight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// What the slopes need: at 1e-7, the fit's own, a small component of the gradient was off by a twenty-fifth of itself.
constexpr double kTolerance = 1e-8;
// Of the noise and the rest, turn about.
constexpr int kNoiseSteps = 50;

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
  flattened_ = std::max(1.0, disagreement * disagreement);
  variance_factor_ = variance_factor;
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
  freedoms_ = static_cast<double>(values - flat_);
  noise_known_ = values - flat_ - d <= suspects_;
  const VecX center = problem_.packed(fitted_)(sampled_), off = center - told_;
  // The priors' quadratic of (y, b, c): of the globals y - S c about what was told, and of c.
  MatX from(d, d + linear);
  from << MatX::Identity(d, d), MatX::Zero(d, flat_), -mimics_;
  MatX P = from.transpose() * known_.asDiagonal() * from;
  P.diagonal().tail(suspects_).array() += 1.0;
  const VecX pull = from.transpose() * known_.cwiseProduct(off);
  const MatX of_c = P.bottomRightCorner(suspects_, suspects_);
  const JumpSizes jumps = jump_sizes(full);
  std::vector<VecX> means;
  std::vector<MatX> covariances;
  std::vector<double> log_weight;
  for (std::size_t j = 0; j < jumps.q.size(); ++j) {
    const NormalEquations data = sum_with_jumps(full, jumps.q[j]);
    const NormalSolution flat =
        solved({data.M.block(d, d, flat_, flat_), VecX::Zero(flat_), 0.0, 0.0}, VecX::Zero(flat_), VecX::Zero(flat_));
    Size one{.q = jumps.q[j],
             .weight = -0.5 * (data.log_det + flat.log_det) / flattened_ + jumps.log_width[j],
             .flat_inverse = flat_ > 0 ? flat.inverse : MatX(0, 0),
             .flat_by_c = data.M.block(d, d + flat_, flat_, suspects_),
             .basis = MatX(0, 0),
             .lambda = {}};
    if (suspects_ > 0) {
      const MatX H =
          data.M.bottomRightCorner(suspects_, suspects_) - one.flat_by_c.transpose() * one.flat_inverse * one.flat_by_c;
      const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> eigen(0.5 * (H + H.transpose()), of_c);
      one.basis = eigen.eigenvectors();
      one.lambda = eigen.eigenvalues().cwiseMax(0.0);
    }
    sizes_.push_back(std::move(one));

    // At the noise that is most probable where the rest is.
    double variance = variance_factor_, prior = 0.0, rss = 0.0;
    NormalSolution solution;
    for (int k = 0; k < kNoiseSteps; ++k) {
      const double scale = variance * flattened_;
      NormalEquations n = data;
      n.M += scale * P;
      n.b += scale * pull;
      n.rr += scale * off.cwiseAbs2().dot(known_);
      solution = solved(n, VecX::Zero(d + linear), VecX::Zero(d + linear));
      prior = off.cwiseAbs2().dot(known_) + 2.0 * pull.dot(solution.x) + solution.x.dot(P * solution.x);
      rss = std::max(solution.rss - scale * prior, std::numeric_limits<double>::min());
      const double before = variance;
      if (!noise_known_) variance = rss / freedoms_;
      if (std::abs(variance - before) <= 1e-6 * before) break;
    }
    means.push_back(solution.x.head(d));
    covariances.push_back(variance * flattened_ * solution.inverse.topLeftCorner(d, d));
    // Of y and c as the normal distribution about the most probable; the flat ones have their power of s in the freedoms.
    const double log_scale = std::log(variance * flattened_);
    log_weight.push_back(sizes_.back().weight - 0.5 * freedoms_ / flattened_ * log_scale -
                         0.5 * (rss / (variance * flattened_) + prior) -
                         0.5 * (solution.log_det - flat.log_det - static_cast<double>(d + suspects_) * log_scale));
  }
  const double most = *std::max_element(log_weight.begin(), log_weight.end());
  double sum = 0.0;
  for (double& w : log_weight) sum += w = std::exp(w - most);
  mean_ = VecX::Zero(d);
  covariance_ = MatX::Zero(d, d);
  for (std::size_t j = 0; j < means.size(); ++j) mean_ += log_weight[j] / sum * means[j];
  for (std::size_t j = 0; j < means.size(); ++j) {
    const VecX from_mean = means[j] - mean_;
    covariance_ += log_weight[j] / sum * (covariances[j] + from_mean * from_mean.transpose());
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
  const VecX toward = mimics_.transpose() * known_.cwiseProduct(off);
  std::vector<VecX> flat_at;  // F' V^-1 r, by size
  for (std::size_t j = 0; j < sizes_.size(); ++j) {
    const Size& size = sizes_[j];
    VecX b = VecX::Zero(flat_ + suspects_);
    double rr = 0.0;
    for (const ReducedWindow& w : out.reduced) {
      const double s = w.jumps ? size.q * size.q : 1.0;
      const VecX fy = (s * w.y.array() / (1.0 + s * w.g.array())).matrix();
      b += w.Xr - w.Y * fy;
      rr += w.rr - w.y.dot(fy);
    }
    flat_at.push_back(b.head(flat_));
    const VecX without_flat = size.flat_inverse * b.head(flat_);
    const ScaledResiduals residuals{
        .rr = rr - b.head(flat_).dot(without_flat),
        .g = size.basis.transpose() * (b.tail(suspects_) - size.flat_by_c.transpose() * without_flat),
        .lambda = size.lambda,
        .known = off.cwiseAbs2().dot(known_),
        .m = size.basis.transpose() * toward,
        .values = freedoms_,
        .flattened = flattened_,
        .told = noise_known_ ? variance_factor_ : 0.0};
    for (NoiseScale& scale : noise_scales(residuals))
      out.scales.push_back({j, scale.square, size.weight + scale.log_weight, std::move(scale.c)});
  }
  const auto smaller = [](const Scale& a, const Scale& b) { return a.share < b.share; };
  const double most = std::max_element(out.scales.begin(), out.scales.end(), smaller)->share;
  double sum = 0.0;
  for (Scale& scale : out.scales) sum += scale.share = std::exp(scale.share - most);
  out.pull.assign(sizes_.size(), 0.0);
  out.pulled.assign(sizes_.size(), VecX::Zero(flat_ + suspects_));
  out.c = VecX::Zero(suspects_);
  for (Scale& scale : out.scales) {
    const Size& size = sizes_[scale.size];
    scale.share /= sum;
    const double pull = scale.share / scale.square;
    const VecX c = size.basis * scale.c;
    out.pull[scale.size] += pull;
    out.pulled[scale.size].head(flat_) -= pull * (size.flat_inverse * (flat_at[scale.size] + size.flat_by_c * c));
    out.pulled[scale.size].tail(suspects_) += pull * c;
    out.c += scale.share * c;
  }
  out.log_density = most + std::log(sum);
  return true;
}

double PosteriorDensity::log_density(const VecX& y, VecX& gradient) const {
  const bool slopes = gradient.size() > 0;
  if (slopes) gradient.setZero(y.size());
  Weighed at;
  if (!weigh(y, slopes, at)) return -kInfinity;
  if (!slopes) return at.log_density;
  // d RSS = 2 (V^-1 (r + X x))' dr: x stands where RSS and the priors' term are least.
  double of_r = 0.0;
  VecX of_X = VecX::Zero(flat_ + suspects_);
  for (std::size_t j = 0; j < sizes_.size(); ++j) {
    of_r += at.pull[j];
    of_X += at.pulled[j];
  }
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    const ReducedWindow& w = at.reduced[k];
    VecX of_B = VecX::Zero(w.y.size());
    for (std::size_t j = 0; j < sizes_.size(); ++j) {
      const double s = w.jumps ? sizes_[j].q * sizes_[j].q : 1.0;
      of_B -= (s * (at.pull[j] * w.y + w.Y.transpose() * at.pulled[j]).array() / (1.0 + s * w.g.array())).matrix();
    }
    gradient -= at.J[k].transpose() * (of_r * at.r[k] + windows_[k].X * of_X + w.BU * of_B);
  }
  gradient -= known_.cwiseProduct(y - told_ - mimics_ * at.c);
  return at.log_density;
}

VecX PosteriorDensity::drawn(const VecX& y, double uniform, const std::function<double(int)>& normal) const {
  Weighed at;
  if (suspects_ == 0 || !weigh(y, false, at)) return y;
  std::size_t k = 0;
  for (double below = at.scales[0].share; below < uniform && k + 1 < at.scales.size(); below += at.scales[k].share) ++k;
  const Size& size = sizes_[at.scales[k].size];
  VecX c = at.scales[k].c;
  for (int i = 0; i < suspects_; ++i) c[i] += normal(i) / std::sqrt(size.lambda[i] / at.scales[k].square + 1.0);
  return (y - mimics_ * (size.basis * c)).cwiseMax(lower_).cwiseMin(upper_);
}

}  // namespace boresight
