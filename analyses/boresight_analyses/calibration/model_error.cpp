#include "boresight_analyses/calibration/model_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/math/eigenvalues.hpp"
#include "boresight_analyses/calibration/kept_fits.hpp"

namespace boresight {
namespace {

// Stretches of a run between jumps. More of them change no answer: what happens within one is a jump at its beginning.
constexpr int kJumps = 16;
// q: from where it changes nothing to where every stretch begins anywhere in its clearance.
constexpr double kLeastJump = 1e-7, kLargestJump = 1.0;
constexpr int kJumpsADecade = 4;
constexpr double kLeastInformation = 1e-8;

// One window at the fit, reduced to what any q needs of it: products of X = (A, D) and the residuals, in the directions of B B'.
struct Reduced {
  MatX XX, Y;  // X'X; X'B U
  VecX Xr, y;  // X'r; U'B'r
  double rr = 0.0;
  VecX g;  // B'B = U g U'
  MatX BU;
  bool jumps = false;
  int run = 0;
};

void fields(Numbers& n, Reduced& w) { n(w.XX, w.Y, w.Xr, w.y, w.rr, w.g, w.BU, w.jumps, w.run); }

struct Normal {
  MatX M;
  VecX b;  // X' V^-1 r
  double rr = 0.0, log_det = 0.0;
};

Normal at_jump(const Reduced& w, double q) {
  // A free start state has its own prior, whatever q is.
  const double s = w.jumps ? q * q : 1.0;
  const VecX f = (s / (1.0 + s * w.g.array())).matrix();
  return {w.XX - w.Y * f.asDiagonal() * w.Y.transpose(), w.Xr - w.Y * f.cwiseProduct(w.y),
          w.rr - w.y.cwiseAbs2().dot(f), (s * w.g.array()).log1p().sum()};
}

// Of the loss (Huber 1981, section 7.6).
VecX pseudo_residuals(const CalibrationProblem& problem, const VecX& of) {
  VecX r(of.size());
  double slope = 0.0;
  for (Eigen::Index i = 0; i < of.size(); ++i) {
    r[i] = problem.loss.score(of[i]);
    slope += problem.loss.weight(of[i]) / static_cast<double>(of.size());
  }
  return r / std::max(slope, 0.1);
}

Reduced reduced(const CalibrationProblem& problem, const FitResult& fit, const std::vector<Suspect>& suspects,
                const std::vector<int>& free, std::size_t k) {
  const Window& w = problem.windows[fit.windows[k]];
  WindowResiduals at;
  problem.evaluate(w, fit.globals, fit.states[k], true, at);
  const Eigen::Index N = at.r.size(), G = static_cast<Eigen::Index>(free.size()),
                     K = static_cast<Eigen::Index>(suspects.size());
  MatX X(N, G + K);
  for (Eigen::Index g = 0; g < G; ++g) X.col(g) = at.by_global.col(free[g]);
  for (Eigen::Index s = 0; s < K; ++s) X.col(G + s) = suspects[s].change[k];
  const VecX r = pseudo_residuals(problem, at.r);
  const MatX B = w.from_rest ? problem.by_jumps(w, fit.globals, kJumps)
                             : MatX(at.by_state * problem.prior_deviation(w).asDiagonal());
  Reduced out;
  if (B.cols() > 0) {
    const Eigen::SelfAdjointEigenSolver<MatX> eigen(MatX(B.transpose() * B));
    out.g = eigen.eigenvalues().cwiseMax(0.0);
    out.BU = B * eigen.eigenvectors();
  } else {
    out.BU = B;  // nothing of the motion may have moved: errors alone are fitted
  }
  out.XX = X.transpose() * X;
  out.Xr = X.transpose() * r;
  out.rr = r.squaredNorm();
  out.Y = X.transpose() * out.BU;
  out.y = out.BU.transpose() * r;
  out.jumps = w.from_rest;
  out.run = w.run;
  return out;
}

struct Solution {
  VecX x;
  MatX inverse;
  double rss = 0.0, log_det = 0.0;
};

// Least (r + X x)' V^-1 (r + X x) + (d + x)' P (d + x), by columns scaled to one size.
Solution solved(const Normal& n, const VecX& prior, const VecX& distance) {
  if (n.M.size() == 0) return {VecX(), MatX(), n.rr, 0.0};  // all are held
  MatX M = n.M;
  // A direction that nothing sees gets a large variance in place of an infinite one.
  M.diagonal() = (M.diagonal() + prior).cwiseMax(kLeastInformation);
  const VecX b = -(n.b + prior.cwiseProduct(distance));
  const VecX scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(MatX(scale.asDiagonal() * M * scale.asDiagonal()));
  const VecX values = eigen.eigenvalues().cwiseMax(1e-13);
  Solution s;
  s.inverse = scale.asDiagonal() * eigen.eigenvectors() * values.cwiseInverse().asDiagonal() *
              eigen.eigenvectors().transpose() * scale.asDiagonal();
  s.x = s.inverse * b;
  s.rss = n.rr + distance.cwiseAbs2().dot(prior) - b.dot(s.x);
  s.log_det = values.array().log().sum() - 2.0 * scale.array().log().sum();
  return s;
}

Normal sum_of(const std::vector<Reduced>& windows, double q, int run) {
  Normal sum;
  for (const Reduced& w : windows) {
    if (run >= 0 && w.run != run) continue;
    const Normal n = at_jump(w, q);
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

// Of scores g and their covariances M: sum g' M^+ g, and how many directions it is of.
void add_disagreement(const Normal& n, const VecX& x, double& square, double& directions) {
  const VecX score = n.b + n.M * x;
  const VecX scale = n.M.diagonal().cwiseMax(kLeastInformation).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(MatX(scale.asDiagonal() * n.M * scale.asDiagonal()));
  const VecX along = eigen.eigenvectors().transpose() * scale.cwiseProduct(score);
  for (Eigen::Index j = 0; j < along.size(); ++j) {
    if (!(eigen.eigenvalues()[j] > 1e-6)) continue;
    square += along[j] * along[j] / eigen.eigenvalues()[j];
    directions += 1.0;
  }
}

// The loss at another place, jumps of size q allowed for.
double loss_with_jumps(const CalibrationProblem& problem, const FitResult& fit, const std::vector<Reduced>& windows,
                       const Globals& at, double q) {
  double loss = problem.prior_cost(at);
  for (std::size_t k = 0; k < windows.size(); ++k) {
    WindowResiduals there;
    problem.evaluate(problem.windows[fit.windows[k]], at, fit.states[k], false, there);
    const VecX r = pseudo_residuals(problem, there.r), y = windows[k].BU.transpose() * r;
    const double s = windows[k].jumps ? q * q : 1.0;
    loss += r.squaredNorm() - (y.array().square() * s / (1.0 + s * windows[k].g.array())).sum();
  }
  return loss;
}

}  // namespace

CalibrationModelError model_error(const CalibrationProblem& problem, const FitResult& fit,
                                  const std::vector<Suspect>& suspects, const std::vector<Globals>& optima,
                                  const std::vector<bool>& fixed, double variance_factor, int jobs) {
  const int G = problem.global_count(), P = problem.parameter_count(), K = static_cast<int>(suspects.size());
  std::vector<int> free;
  for (int g = 0; g < G; ++g)
    if (g >= P || fixed.empty() || !fixed[g]) free.push_back(g);
  const int F = static_cast<int>(free.size());
  if (F + K == 0) {  // the fit ran into every bound, and nothing else is in question
    CalibrationModelError none;
    none.shift = VecX::Zero(G);
    none.covariance = MatX::Constant(G, G, std::numeric_limits<double>::quiet_NaN());
    return none;
  }
  std::vector<Reduced> windows(fit.windows.size());
  for_each_on_threads(static_cast<int>(windows.size()), jobs, [&](int k) {
    CalibrationKey key("window with its jumps", problem);
    key.add(k, fit.globals, fit.windows, fit.states, free);
    for (const Suspect& suspect : suspects) key.add(suspect.change[k]);
    windows[k] = kept_or_computed<Reduced>(
        problem.kept, key.value(), [&] { return reduced(problem, fit, suspects, free, static_cast<std::size_t>(k)); });
  });
  long values = 0;
  for (const int w : fit.windows) {
    const Window& window = problem.windows[w];
    values += problem.runs[window.run]
                  .data.value.middleRows(window.first, window.last - window.first + 1)
                  .array()
                  .isFinite()
                  .count();
  }
  VecX prior = VecX::Zero(F + K), distance = VecX::Zero(F + K);
  const VecX known = problem.prior_information(), off = problem.packed(fit.globals) - problem.packed(problem.start());
  for (int f = 0; f < F; ++f) {
    prior[f] = variance_factor * known[free[f]];
    distance[f] = off[free[f]];
  }
  prior.tail(K).setConstant(variance_factor);

  const bool any_jumps = std::any_of(windows.begin(), windows.end(), [](const Reduced& w) { return w.jumps; });
  std::vector<double> q = {0.0}, log_weight;
  if (any_jumps) {
    q.clear();
    const int count = static_cast<int>(std::lround(kJumpsADecade * std::log10(kLargestJump / kLeastJump)));
    for (int k = 0; k <= count; ++k) q.push_back(kLeastJump * std::pow(kLargestJump / kLeastJump, double(k) / count));
  }
  std::vector<Solution> solutions;
  for (const double at : q) {
    const Normal n = sum_of(windows, at, -1);
    solutions.push_back(solved(n, prior, distance));
    const Solution& s = solutions.back();
    log_weight.push_back(-0.5 * (n.log_det + s.log_det + static_cast<double>(values - F) * std::log(s.rss)) +
                         (at > 0.0 ? std::log(at) : 0.0));
  }
  const double most = *std::max_element(log_weight.begin(), log_weight.end());
  const double first_likelihood = log_weight.front() - (q.front() > 0.0 ? std::log(q.front()) : 0.0);
  double likeliest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < q.size(); ++k)
    likeliest = std::max(likeliest, log_weight[k] - (q[k] > 0.0 ? std::log(q[k]) : 0.0));
  double sum = 0.0;
  for (double& w : log_weight) sum += w = std::exp(w - most);
  CalibrationModelError out;
  out.jump_gain = 2.0 * (likeliest - first_likelihood);
  VecX mean = VecX::Zero(F + K);
  for (std::size_t k = 0; k < q.size(); ++k) {
    mean += log_weight[k] / sum * solutions[k].x;
    out.jump += log_weight[k] / sum * q[k];
  }
  MatX covariance = MatX::Zero(F + K, F + K);
  std::size_t best = 0;
  for (std::size_t k = 0; k < q.size(); ++k) {
    const double s2 = std::max(solutions[k].rss / static_cast<double>(std::max(1L, values - F)), 1e-12);
    const VecX from_mean = solutions[k].x - mean;
    covariance += log_weight[k] / sum * (s2 * solutions[k].inverse + from_mean * from_mean.transpose());
    if (log_weight[k] > log_weight[best]) best = k;
  }

  // Runs, or windows that start freely, beside one another.
  std::vector<Normal> groups;
  if (any_jumps) {
    for (std::size_t r = 0; r < problem.runs.size(); ++r)
      if (Normal n = sum_of(windows, q[best], static_cast<int>(r)); n.M.size() > 0) groups.push_back(std::move(n));
  } else {
    for (const Reduced& w : windows) groups.push_back(at_jump(w, 0.0));
  }
  out.groups = static_cast<int>(groups.size());
  double square = 0.0, directions = 0.0;
  for (const Normal& n : groups) add_disagreement(n, mean, square, directions);
  directions -= F;
  const double s2 = solutions[best].rss / static_cast<double>(std::max(1L, values - F));
  if (groups.size() > 1 && directions > 0.5) out.disagreement = std::sqrt(square / s2 / directions);
  covariance *= std::max(1.0, out.disagreement * out.disagreement);

  // Other optima: displaced by d_m, with weights w_m.
  if (any_jumps && !optima.empty()) {
    CalibrationProblem rough = problem;
    for (ModelCorrection& correction : rough.corrections) correction.tangent.reset();
    std::vector<VecX> away = {VecX::Zero(F + K)};
    std::vector<double> weight = {1.0};
    const auto loss_at = [&](const Globals& at) {
      const std::uint64_t key =
          CalibrationKey("loss with jumps", rough).add(fit.globals, fit.windows, fit.states, at, q[best]).value();
      return kept_or_computed<double>(problem.kept, key,
                                      [&] { return loss_with_jumps(rough, fit, windows, at, q[best]); });
    };
    const double here = loss_at(fit.globals);
    for (const Globals& optimum : optima) {
      const VecX all = problem.packed(optimum) - problem.packed(fit.globals);
      away.push_back(VecX::Zero(F + K));
      for (int f = 0; f < F; ++f) away.back()[f] = all[free[f]];
      weight.push_back(std::exp(-0.5 * std::max(0.0, loss_at(optimum) - here) / s2));
    }
    double whole = 0.0;
    for (const double w : weight) whole += w;
    VecX middle = VecX::Zero(F + K);
    for (std::size_t m = 0; m < away.size(); ++m) middle += weight[m] / whole * away[m];
    for (std::size_t m = 0; m < away.size(); ++m)
      covariance += weight[m] / whole * (away[m] - middle) * (away[m] - middle).transpose();
    mean += middle;
    out.optima =
        static_cast<int>(std::count_if(weight.begin(), weight.end(), [&](double w) { return w > 0.01 * whole; }));
  }

  out.shift = VecX::Zero(G);
  out.covariance = MatX::Constant(G, G, std::numeric_limits<double>::quiet_NaN());
  for (int a = 0; a < F; ++a) {
    out.shift[free[a]] = mean[a];
    for (int b = 0; b < F; ++b) out.covariance(free[a], free[b]) = covariance(a, b);
  }
  const Normal n = sum_of(windows, q[best], -1);
  for (int k = 0; k < K; ++k) {
    SuspectFound found{suspects[k].name,
                       suspects[k].says,
                       suspects[k].deviation,
                       suspects[k].unit,
                       mean[F + k],
                       std::sqrt(covariance(F + k, F + k)),
                       0.0,
                       VecX::Zero(P)};
    // Alone: the other suspects held at what they were told.
    std::vector<int> with;
    for (int f = 0; f < F; ++f) with.push_back(f);
    const auto loss = [&](const std::vector<int>& columns) {
      return solved({n.M(columns, columns), n.b(columns), n.rr, 0.0}, prior(columns), distance(columns)).rss;
    };
    const double without = loss(with);
    with.push_back(F + k);
    found.gain = (without - loss(with)) / s2;
    for (int f = 0; f < F; ++f)
      if (free[f] < P) found.adds[free[f]] = std::abs(covariance(f, F + k)) / found.error;
    out.suspects.push_back(std::move(found));
  }
  return out;
}

}  // namespace boresight
