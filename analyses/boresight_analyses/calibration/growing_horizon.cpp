// Impacts make valleys beside valleys in the loss, more of them the longer a motion is followed: each is narrower than the errors that shorter
// data leave. So the horizon grows by little at a time. Whether a fit is still in the right valley shows in what has just come in: it should
// leave no more than what was there before. Where it leaves more, the horizon is taken back and grows more slowly; where it does so even then,
// other places are looked at beside those that led on so far, as far off as the data up to there allow, and the likely ones are followed: a
// population over growing data (Chopin 2002, Biometrika 89, 539-551), each member of which is a fit.
#include <algorithm>
#include <atomic>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "boresight/math/eigenvalues.hpp"
#include "boresight_analyses/calibration/calibrator.hpp"
#include "boresight_analyses/calibration/landscape.hpp"
#include "boresight_analyses/calibration/reduced_window.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

// By how much the horizon grows at most, of each path: which valley one ends in hangs on where its horizons fall. Two paths are gone, and further
// ones where runs contradict each other at the lowest place that was found, as they do in wrong valleys. And least, before
// other places are looked at. (Paths end in one place too seldom to confirm each other: of four with ten runs of the four-bar no two did.)
constexpr double kMostGrowth[] = {1.3, 1.2, 1.14, 1.25}, kLeastGrowth = 1.04;
constexpr std::size_t kPaths = 2;
// A mean square of what came in beyond this many times that of what was there. Noise alone does so with a hundred values once in a dozen times,
// which costs a look and no more.
constexpr double kRise = 1.2;
// A cost of a value, in s^2, that no noise is needed for: data without any leave that.
constexpr double kNextToNothing = 0.01;
// Places looked at, and led on. On 18 sets of the four-bar (multibody's data, axial gaps and masses off) five beside three ended once 720 above
// what eight beside four found.
constexpr int kBeside = 8, kMostKept = 4;
// How far off they are looked at, the first and each further one: in standard errors of what is reached.
constexpr double kNearest = 1.0, kFarther = 0.5;
// Higher than the lowest by this many s^2 a place is given up: e^-15 as likely.
constexpr double kLikely = 30.0;
// Closer to a lower one than this many standard errors in every parameter, and hardly higher: the same place.
constexpr double kSame = 1.0;

// A draw of a Gaussian with this covariance; no step along what has none.
VecX drawn(const MatX& covariance, const CounterStream& stream, std::uint64_t number) {
  static const boost::math::normal standard;
  const Eigen::Index n = covariance.rows();
  std::vector<int> known;
  for (Eigen::Index g = 0; g < n; ++g)
    if (std::isfinite(covariance(g, g)) && covariance(g, g) > 0.0) known.push_back(static_cast<int>(g));
  VecX step = VecX::Zero(n);
  if (known.empty()) return step;
  const MatX of = covariance(known, known);
  const VecX scale = of.diagonal().cwiseSqrt();
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(
      MatX(scale.cwiseInverse().asDiagonal() * of * scale.cwiseInverse().asDiagonal()));
  VecX z(scale.size());
  for (Eigen::Index k = 0; k < z.size(); ++k)
    z[k] = boost::math::quantile(standard, stream.uniform(number, static_cast<std::uint64_t>(k))) *
           std::sqrt(std::max(0.0, eigen.eigenvalues()[k]));
  step(known) = scale.cwiseProduct(eigen.eigenvectors() * z);
  return step;
}

}  // namespace

std::vector<FitResult> Calibrator::fits_from(const CalibrationProblem& part, const std::vector<Globals>& starts,
                                             const std::string& stage, bool rough) {
  const int count = static_cast<int>(starts.size()), side_by_side = std::min(options_.jobs, count);
  std::vector<FitResult> ended(starts.size());
  std::atomic<bool> stop{false};
  for_each_on_threads(count, side_by_side, [&](int k) {
    if (stop) return;
    FitOptions o = fit_options(stage, rough ? 10 : 30, std::max(1, options_.jobs / side_by_side));
    if (rough) {
      o.cost_tolerance = 1e-5;
      o.least_gain = 0.1;
    }
    ended[k] = fit(part, starts[k], {}, o);
    if (ended[k].interrupted) stop = true;
  });
  if (stop) throw CalibrationInterrupted{};
  for (const FitResult& one : ended) result_.evaluations += one.evaluations;
  return ended;
}

std::vector<Globals> Calibrator::distinct_places(const std::vector<FitResult>& ended,
                                                 const Inference& at_lowest) const {
  const VecX error = at_lowest.covariance.diagonal().cwiseSqrt();
  const auto same = [&](const Globals& a, const Globals& b) {
    for (int p = 0; p < problem_.parameter_count(); ++p)
      if (!result_.fixed[p] && std::isfinite(error[p]) && std::abs(a.u[p] - b.u[p]) > kSame * error[p]) return false;
    return true;
  };
  std::vector<Globals> places;
  for (const FitResult& one : ended) {
    // The lowest is one of them even where data without noise leave nothing to judge costs by.
    if (static_cast<int>(places.size()) == kMostKept ||
        (!places.empty() && !(one.cost < ended.front().cost + kLikely * at_lowest.variance_factor)))
      break;
    if (std::none_of(places.begin(), places.end(), [&](const Globals& p) { return same(p, one.globals); }))
      places.push_back(one.globals);
  }
  return places;
}

std::vector<FitResult> Calibrator::grown(const Globals& at, double most_growth, bool give_up, std::size_t path) {
  std::vector<Globals> places = {at};
  std::vector<FitResult> ended;
  const CounterStream stream(options_.seed, StreamPurpose::proposal);
  double reached = kStartsShare, growth = most_growth;
  FitResult before;  // at what is reached
  long values_before = 0;
  MatX covariance;
  int beside = 0;
  bool closely = false;  // by the steps of the fit itself: where the search's lead elsewhere
  while (reached < 1.0) {
    // The last stretch is no sliver.
    const double share = reached * growth < 0.98 ? reached * growth : 1.0;
    CalibrationProblem part = searched_up_to(problem_, share);
    if (closely) {
      part.tolerance = problem_.tolerance;
      part.derivative_tolerance = problem_.derivative_tolerance;
    }
    std::vector<Globals> starts = places;
    for (int k = 0; k < beside; ++k)
      starts.push_back(moved_along(part, places[static_cast<std::size_t>(k) % places.size()],
                                   (kNearest + k * kFarther) * drawn(covariance, stream, looked_beside_++)));
    const std::string stage =
        share < 1.0 ? "horizon " + std::to_string(static_cast<int>(100.0 * share)) + " %" : "whole data";
    ended = fits_from(part, starts, stage, true);
    std::stable_sort(ended.begin(), ended.end(),
                     [](const FitResult& a, const FitResult& b) { return a.cost < b.cost; });
    if (!std::isfinite(ended.front().cost)) return {};
    if (!closely && !steps_suffice(part, ended.front().globals, options_.jobs)) {
      closely = true;
      continue;
    }
    const long values = values_in(part, ended.front().windows);
    const auto came_in = static_cast<double>(values - values_before);
    const double per_value = before.cost / static_cast<double>(std::max(values_before, 1L));
    const bool rises =
        values_before > 0 && ended.front().cost - before.cost > std::max(kRise * per_value, kNextToNothing) * came_in;
    if (rises && growth > kLeastGrowth) {
      growth = std::max(kLeastGrowth, std::sqrt(growth));
      continue;
    }
    if (rises && beside == 0) {
      beside = kBeside;
      continue;
    }
    const Inference known = infer(part, ended.front(), options_.confidence, result_.fixed, options_.jobs);
    places = distinct_places(ended, known);
    covariance = known.covariance;
    before = ended.front();
    values_before = values;
    reached = share;
    const double done = (static_cast<double>(path) + (reached - kStartsShare) / (1.0 - kStartsShare)) / kPaths;
    reach(std::lerp(share_at(Done::starts), share_at(Done::horizon), std::min(1.0, done)));
    // Where the search's own steps suffice, finer ones do.
    if (closely && !keep_what_is_foretold(part, places.front())) values_before = 0;
    beside = 0;
    growth = std::min(most_growth, std::pow(growth, 1.5));
    if (give_up && leaves_more_than_noise(part, places.front())) return {};
  }
  return ended;
}

bool Calibrator::grow(const Globals& at, bool give_up) {
  std::vector<Globals> places = {at};
  if (follows_from_rest(problem_)) {
    std::vector<FitResult> ended;
    std::size_t paths = 0;
    path_ends_.clear();
    for (const double most_growth : kMostGrowth) {
      std::vector<FitResult> more = grown(at, most_growth, give_up, paths);
      if (!more.empty()) path_ends_.push_back(more.front().globals);
      ended.insert(ended.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
      std::stable_sort(ended.begin(), ended.end(),
                       [](const FitResult& a, const FitResult& b) { return a.cost < b.cost; });
      if (++paths < kPaths) continue;
      if (ended.empty()) break;
      const CalibrationProblem whole = searched_up_to(problem_, 1.0);
      const Inference known = infer(whole, ended.front(), options_.confidence, result_.fixed, options_.jobs);
      places = distinct_places(ended, known);
      if (!model_error(whole, ended.front(), {}, {}, result_.fixed, known.variance_factor, options_.jobs)
               .contradicted())
        break;
    }
    if (ended.empty() && give_up) return false;
  }
  std::vector<FitResult> ended = fits_from(problem_, places, "whole data", false);
  std::stable_sort(ended.begin(), ended.end(), [](const FitResult& a, const FitResult& b) { return a.cost < b.cost; });
  for (std::size_t k = 1; k < ended.size(); ++k) optima_.push_back(ended[k].globals);
  optima_.push_back(ended.front().globals);
  result_.fit = std::move(ended.front());
  stabilise("whole data");
  return true;
}

}  // namespace boresight
