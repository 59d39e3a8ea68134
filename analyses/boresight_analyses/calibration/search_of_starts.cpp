#include <algorithm>
#include <atomic>
#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/calibrator.hpp"
#include "boresight_analyses/calibration/landscape.hpp"
#include "boresight_analyses/calibration/profile_likelihood.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

// Where no start leads to residuals like noise, more batches are tried, and more of them followed.
constexpr int kMostStarts = 24;
constexpr int kMostFollowed = 6;

// Rounds of looking into other valleys, and descents in each.
constexpr int kMostSettlings = 4, kDescents = 2;

}  // namespace

FitOptions Calibrator::fit_options(const std::string& stage, int iterations, int jobs) {
  FitOptions o;
  o.jobs = jobs;
  o.most_iterations = iterations;
  o.fixed = result_.fixed;
  // Among narrow optima a whole step often leads beyond the next ridge. From a radius of 1e4 four of them, each a motion followed in vain, are
  // refused before one is any shorter; from 100 the second is.
  if (follows_from_rest(problem_)) o.first_radius = 100.0;
  o.progress = [this, stage](const FitProgress& p) {
    std::string text;
    const std::vector<double> values = problem_.values(p.globals);
    char number[160];
    std::snprintf(number, sizeof number, "iteration %d, cost %.6g", p.iteration, p.cost);
    text = std::isfinite(p.cost) ? number : "a start that cannot be followed";
    for (std::size_t k = 0; k < std::min<std::size_t>(4, values.size()); ++k) {
      const std::string& path = problem_.parameters[k].path;
      std::snprintf(number, sizeof number, ", %s %.4g", path.substr(path.rfind('.') + 1).c_str(), values[k]);
      text += number;
    }
    const std::lock_guard lock(mutex_);
    return !options_.progress || options_.progress(stage, reached_, text);
  };
  return o;
}

void Calibrator::search() {
  const CalibrationProblem part = searched_up_to(problem_, kStartsShare);
  const auto cheaper = [](const Descent& a, const Descent& b) { return a.cost < b.cost; };
  std::vector<Descent> tried;
  std::size_t next = 0;
  std::optional<FitResult> best;
  for (int followed = 0; followed < kMostFollowed; ++followed) {
    while (static_cast<int>(tried.size()) < kMostStarts &&
           (next == tried.size() || leaves_more_than_noise(part, tried[next].to))) {
      try_starts(part, std::max(1, options_.starts), tried);
      std::sort(tried.begin() + static_cast<std::ptrdiff_t>(next), tried.end(), cheaper);
    }
    if (next == tried.size()) break;
    if (!grow(tried[next++].to, true)) continue;
    if (!best || result_.fit.cost < best->cost) best = result_.fit;
    if (!leaves_more_than_noise(problem_, best->globals)) break;
  }
  if (!best) {
    grow(std::min_element(tried.begin(), tried.end(), cheaper)->to, false);
    best = result_.fit;
  }
  result_.fit = *best;
}

Globals Calibrator::start(int number) const {
  const CounterStream stream(options_.seed, StreamPurpose::sample);
  Globals at = problem_.start();
  for (int p = 0; number > 0 && p < problem_.parameter_count(); ++p) {
    const FittedParameter& parameter = problem_.parameters[p];
    // The loss is a parabola by them: any start is as good.
    if (parameter.is_error()) continue;
    const double unknown = parameter.transform == Transform::log ? std::log(2.0) : 1.0;
    const double reach =
        parameter.has_prior ? std::min(unknown, 1.0 / std::sqrt(parameter.prior_information())) : unknown;
    const double draw = stream.uniform(static_cast<std::uint64_t>(number), static_cast<std::uint64_t>(p));
    at.u[p] =
        std::clamp(at.u[p] + reach * (2.0 * draw - 1.0), parameter.lowest_coordinate(), parameter.highest_coordinate());
  }
  return at;
}

void Calibrator::try_starts(const CalibrationProblem& part, int count, std::vector<Descent>& tried) {
  const int before = static_cast<int>(tried.size()), side_by_side = std::min(options_.jobs, count);
  std::vector<Descent> more(count);
  std::atomic<bool> stop{false};
  std::atomic<int> done{0};
  for_each_on_threads(count, side_by_side, [&](int s) {
    Descent& d = more[s];
    d.from = d.to = start(before + s);
    for (const double share :
         follows_from_rest(part) ? std::vector<double>{0.25, 0.5, 1.0} : std::vector<double>{1.0}) {
      if (stop) return;
      FitOptions o = fit_options("start " + std::to_string(before + s + 1) + " of " + std::to_string(before + count),
                                 12, std::max(1, options_.jobs / side_by_side));
      o.cost_tolerance = 1e-4;
      // What was told and is allowed to be otherwise would make up for a start far off.
      for (int p = 0; p < problem_.parameter_count(); ++p)
        if (problem_.parameters[p].has_prior && !problem_.parameters[p].is_error()) o.fixed[p] = true;
      const FitResult found = fit(searched_up_to(part, share), d.to, {}, o);
      stop = stop || found.interrupted;
      d.evaluations += found.evaluations;
      d.to = found.globals;
      d.cost = found.cost;
    }
    reach(share_at(Done::starts) * ++done / count);
  });
  if (stop) throw CalibrationInterrupted{};
  for (const Descent& d : more) {
    result_.starts.push_back({problem_.values(d.from), problem_.values(d.to), d.cost});
    result_.evaluations += d.evaluations;
    tried.push_back(d);
  }
}

void Calibrator::stabilise(const std::string& stage) {
  if (!follows_from_rest(problem_)) return;
  for (int round = 0; round < kMostSettlings; ++round) {
    const double before = result_.fit.cost;
    const Inference inference = infer_now();
    std::vector<Globals> places =
        other_valleys(problem_, result_.fit, inference, result_.fixed, options_.jobs, result_.evaluations);
    places.resize(std::min<std::size_t>(kDescents, places.size()));
    for (const Globals& place : places) {
      FitResult found = fit(problem_, place, {}, fit_options(stage + ", another valley", 15, options_.jobs));
      if (found.interrupted) throw CalibrationInterrupted{};
      result_.evaluations += found.evaluations;
      optima_.push_back(found.globals);
      if (found.cost < result_.fit.cost) result_.fit = std::move(found);
    }
    if (!(result_.fit.cost < before - 0.1 * inference.variance_factor)) return;
  }
}

void Calibrator::profile() {
  if (!options_.profile) return;
  for (int round = 0; round < kMostSettlings; ++round) {
    tell("profile likelihood", "");
    FitResult lower = result_.fit;
    result_.profiles =
        profile_likelihood(problem_, result_.fit, result_.inference, result_.fixed, options_.jobs, lower);
    if (!(lower.cost < result_.fit.cost - kLower * result_.inference.variance_factor)) break;
    note(fit(problem_, lower.globals, lower.states, fit_options("from a lower place", 15, options_.jobs)));
    result_.inference = infer_now();
  }
  take_intervals(result_.profiles, problem_, result_.inference);
}

}  // namespace boresight
