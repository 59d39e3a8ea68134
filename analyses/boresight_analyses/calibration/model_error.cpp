#include "boresight_analyses/calibration/model_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/math/eigenvalues.hpp"
#include "boresight_analyses/calibration/reduced_window.hpp"

namespace boresight {
namespace {

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

ReducedWindow reduced(const CalibrationProblem& problem, const FitResult& fit, const std::vector<Suspect>& suspects,
                      const std::vector<int>& free, std::size_t k) {
  const Window& w = problem.windows[fit.windows[k]];
  WindowResiduals at;
  problem.evaluate(w, fit.globals, fit.states[k], true, at);
  const Eigen::Index G = static_cast<Eigen::Index>(free.size()), K = static_cast<Eigen::Index>(suspects.size());
  MatX X(at.r.size(), G + K);
  for (Eigen::Index g = 0; g < G; ++g) X.col(g) = at.by_global.col(free[g]);
  for (Eigen::Index s = 0; s < K; ++s) X.col(G + s) = suspects[s].change[k];
  return reduced_window(problem, w, fit.globals, at, X, pseudo_residuals(problem, at.r));
}

// Of scores g and their covariances M: sum g' M^+ g, and how many directions it is of.
void add_disagreement(const NormalEquations& n, const VecX& x, double& square, double& directions) {
  const VecX score = n.b + n.M * x;
  const VecX scale = n.M.diagonal().cwiseMax(kUnseenInformation).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(MatX(scale.asDiagonal() * n.M * scale.asDiagonal()));
  const VecX along = eigen.eigenvectors().transpose() * scale.cwiseProduct(score);
  for (Eigen::Index j = 0; j < along.size(); ++j) {
    if (!(eigen.eigenvalues()[j] > 1e-6)) continue;
    square += along[j] * along[j] / eigen.eigenvalues()[j];
    directions += 1.0;
  }
}

// The loss at another place, jumps of size q allowed for.
double loss_with_jumps(const CalibrationProblem& problem, const FitResult& fit,
                       const std::vector<ReducedWindow>& windows, const Globals& at, double q) {
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
  std::vector<ReducedWindow> windows(fit.windows.size());
  for_each_on_threads(static_cast<int>(windows.size()), jobs, [&](int k) {
    CalibrationKey key("window with its jumps", problem);
    key.add(k, fit.globals, fit.windows, fit.states, free);
    for (const Suspect& suspect : suspects) key.add(suspect.change[k]);
    windows[k] = kept_or_computed<ReducedWindow>(
        problem.kept, key.value(), [&] { return reduced(problem, fit, suspects, free, static_cast<std::size_t>(k)); });
  });
  const long values = values_in(problem, fit.windows);
  VecX prior = VecX::Zero(F + K), distance = VecX::Zero(F + K);
  const VecX known = problem.prior_information(), off = problem.packed(fit.globals) - problem.packed(problem.start());
  for (int f = 0; f < F; ++f) {
    prior[f] = variance_factor * known[free[f]];
    distance[f] = off[free[f]];
  }
  prior.tail(K).setConstant(variance_factor);

  const bool any_jumps = std::any_of(windows.begin(), windows.end(), [](const ReducedWindow& w) { return w.jumps; });
  const auto [q, log_width] = jump_sizes(windows);
  std::vector<double> log_weight, log_likelihood;
  std::vector<NormalSolution> solutions;
  for (const double at : q) {
    const NormalEquations n = sum_with_jumps(windows, at);
    solutions.push_back(solved(n, prior, distance));
    const NormalSolution& s = solutions.back();
    log_likelihood.push_back(-0.5 * (n.log_det + s.log_det + static_cast<double>(values - F) * std::log(s.rss)));
    log_weight.push_back(log_likelihood.back() + log_width[solutions.size() - 1]);
  }
  const double most = *std::max_element(log_weight.begin(), log_weight.end());
  const double likeliest = *std::max_element(log_likelihood.begin(), log_likelihood.end());
  double sum = 0.0;
  for (double& w : log_weight) sum += w = std::exp(w - most);
  CalibrationModelError out;
  out.jump_gain = 2.0 * (likeliest - log_likelihood.front());
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
  std::vector<NormalEquations> groups;
  if (any_jumps) {
    for (std::size_t r = 0; r < problem.runs.size(); ++r)
      if (NormalEquations n = sum_with_jumps(windows, q[best], static_cast<int>(r)); n.M.size() > 0)
        groups.push_back(std::move(n));
  } else {
    for (const ReducedWindow& w : windows) groups.push_back(with_jumps(w, 0.0));
  }
  out.groups = static_cast<int>(groups.size());
  double square = 0.0, directions = 0.0;
  for (const NormalEquations& n : groups) add_disagreement(n, mean, square, directions);
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
  const NormalEquations n = sum_with_jumps(windows, q[best]);
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
