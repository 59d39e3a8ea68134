#include "boresight_analyses/calibration/landscape.hpp"

#include <algorithm>
#include <cmath>

#include "boresight_analyses/calibration/kept_fits.hpp"

namespace boresight {
namespace {

constexpr double kSurprise = 0.5;

}  // namespace

Globals moved_along(const CalibrationProblem& problem, const Globals& from, const VecX& step) {
  VecX to = problem.packed(from);
  for (Eigen::Index g = 0; g < to.size(); ++g)
    if (std::isfinite(step[g])) to[g] += step[g];
  for (int p = 0; p < problem.parameter_count(); ++p)
    to[p] = std::clamp(to[p], problem.parameters[p].lowest_coordinate(), problem.parameters[p].highest_coordinate());
  Globals at = problem.unpacked(to);
  at.time_offset = std::clamp(at.time_offset, -problem.largest_time_offset, problem.largest_time_offset);
  return at;
}

bool follows_from_rest(const CalibrationProblem& problem) {
  return std::any_of(problem.windows.begin(), problem.windows.end(), [](const Window& w) { return w.from_rest; });
}

void loosen(CalibrationProblem& problem) {
  problem.tolerance = 1e-5;
  problem.derivative_tolerance = 1e-3;
}

CalibrationProblem searched_up_to(const CalibrationProblem& problem, double share) {
  CalibrationProblem part = problem;
  loosen(part);
  // A loss that levels off has no pull from afar: redescending estimates start from monotone ones (Maronna,
  // Martin and Yohai 2006, Robust Statistics).
  if (part.loss.kind == Loss::cauchy) part.loss.kind = Loss::huber;
  for (Window& w : part.windows) {
    const std::vector<double>& t = problem.runs[w.run].data.time;
    const double end = t[w.first] + share * (t[w.last] - t[w.first]);
    if (!w.from_rest) continue;
    while (w.last > w.first + 1 && t[w.last] > end) --w.last;
    w.end = std::min(w.end, t[w.last] + problem.largest_time_offset);
  }
  return part;
}

double loss_at(const CalibrationProblem& problem, const Globals& at) {
  double loss = problem.prior_cost(at);
  for (const Window& w : problem.windows)
    if (w.from_rest && !w.held_out) loss += problem.cost(w, at, VecX::Zero(problem.state_size(w)));
  return loss;
}

bool leaves_more_than_noise(const CalibrationProblem& problem, const Globals& at) {
  constexpr double kFollowing = 0.35;
  constexpr double kQuartile = 1.1503;  // of a normal deviate's size
  for (const Window& w : problem.windows) {
    if (!w.from_rest || w.held_out) continue;
    WindowResiduals residuals;
    problem.evaluate(w, at, VecX::Zero(problem.state_size(w)), false, residuals);
    VecX sizes = residuals.r.cwiseAbs();
    if (sizes.size() == 0) continue;
    const Eigen::Index quartile = 3 * sizes.size() / 4;
    std::nth_element(sizes.begin(), sizes.begin() + quartile, sizes.end());
    if (sizes[quartile] > 1.25 * kQuartile) return true;
    // A window's residuals come channel by channel.
    double square = 0.0, product = 0.0;
    const VecX clipped = residuals.r.cwiseMax(-3.0).cwiseMin(3.0);
    for (Eigen::Index i = 0; i < clipped.size(); ++i) {
      square += clipped[i] * clipped[i];
      if (i > 0 && residuals.channel[i] == residuals.channel[i - 1]) product += clipped[i] * clipped[i - 1];
    }
    if (product > kFollowing * square) return true;
  }
  return false;
}

namespace {

std::vector<int> numbers_of(const std::vector<bool>& fixed) { return {fixed.begin(), fixed.end()}; }

struct Valleys {
  std::vector<Globals> places;
  long evaluations = 0;
};

Valleys valleys_beside(const CalibrationProblem& problem, const FitResult& fit, const Inference& inference,
                       const std::vector<bool>& fixed, int jobs) {
  struct Trial {
    Globals at;
    double share = 0.0;  // of the foretold rise
  };
  std::vector<Trial> trials;
  std::vector<double> foretold;
  for (int p = 0; p < problem.parameter_count(); ++p)
    for (const double step : {-24.0, -12.0, -6.0, -3.0, 3.0, 6.0, 12.0, 24.0}) {
      if (fixed[p] || problem.parameters[p].is_error() || problem.parameters[p].has_prior) continue;
      const VecX line = inference.covariance.col(p) / std::sqrt(inference.covariance(p, p));
      trials.push_back({moved_along(problem, fit.globals, step * line)});
      foretold.push_back(step * step * inference.variance_factor);
    }
  // What jitters by a hundredth of the noise tells a valley from a slope.
  CalibrationProblem rough = problem;
  loosen(rough);
  const double least = loss_at(rough, fit.globals);
  for_each_on_threads(static_cast<int>(trials.size()), jobs,
                      [&](int k) { trials[k].share = (loss_at(rough, trials[k].at) - least) / foretold[k]; });
  Valleys found{{}, static_cast<long>(trials.size()) + 1};
  std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.share < b.share; });
  for (const Trial& t : trials)
    if (t.share < kSurprise) found.places.push_back(t.at);
  return found;
}

}  // namespace

static void fields(Numbers& n, Valleys& v) { n(v.places, v.evaluations); }

std::vector<Globals> other_valleys(const CalibrationProblem& problem, const FitResult& fit, const Inference& inference,
                                   const std::vector<bool>& fixed, int jobs, long& evaluations) {
  const Valleys found = kept_or_computed<Valleys>(
      problem.kept,
      CalibrationKey("valleys", problem)
          .add(fit.globals, inference.covariance, inference.variance_factor, numbers_of(fixed))
          .value(),
      [&] { return valleys_beside(problem, fit, inference, fixed, jobs); });
  evaluations += found.evaluations;
  return found.places;
}

}  // namespace boresight
