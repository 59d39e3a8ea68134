#include "boresight_analyses/calibration/profile_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "boresight_analyses/calibration/landscape.hpp"

namespace boresight {
namespace {

// Points on each side, and how much farther than the last the next may be.
constexpr int kMostPoints = 5;
constexpr double kFartherAtMost = 2.5;
constexpr double kClose = 0.1;  // relative, of the root of the rise: from there on it is taken as straight

struct Side {
  const CalibrationProblem& problem;
  const FitResult& fit;
  const Inference& inference;
  const std::vector<bool>& fixed;
  int parameter;
  double sign;
  double rise_wanted;
  bool from_rest;

  const FittedParameter& own() const { return problem.parameters[parameter]; }
  double clamped(double u) const { return std::clamp(u, own().lowest_coordinate(), own().highest_coordinate()); }

  // The root of the rise at u, all others fitted anew from the line on which they follow it: there a parabola
  // has its least, and one iteration shows what is left to gain.
  template <typename Found>
  double root_at(double u, Found&& found) const {
    const double away = u - fit.globals.u[parameter];
    const VecX line = inference.covariance.col(parameter) / inference.covariance(parameter, parameter);
    Globals moved = fit.globals;
    for (int p = 0; p < problem.parameter_count(); ++p)
      if (std::isfinite(line[p]))
        moved.u[p] = std::clamp(moved.u[p] + line[p] * away, problem.parameters[p].lowest_coordinate(),
                                problem.parameters[p].highest_coordinate());
    moved.u[parameter] = u;
    FitOptions o;
    // Start states have to follow, each by itself.
    o.most_iterations = from_rest ? 1 : 6;
    o.fixed = fixed;
    o.fixed[parameter] = true;
    FitResult there = boresight::fit(problem, moved, fit.states, o);
    const double risen = there.cost - fit.cost;
    found(std::move(there));
    return std::sqrt(std::max(0.0, risen) / (inference.variance_factor * inference.growth[parameter]));
  }

  // Distance from the optimum at which the rise is what is wanted; NaN where a bound or the reach ends it
  // before. points: distance (signed) and rise of each place tried. found: of every fit.
  template <typename Found>
  double crossing(std::vector<std::pair<double, double>>& points, Found&& found) const {
    const double u0 = fit.globals.u[parameter], wanted = std::sqrt(rise_wanted);
    double inside = 0.0, inside_root = 0.0;
    double outside = std::numeric_limits<double>::infinity(), outside_root = 0.0;
    // The root of the rise is nearly straight.
    const auto between = [&] {
      return inside + (outside - inside) * (wanted - inside_root) / (outside_root - inside_root);
    };
    double at = wanted * std::min(std::sqrt(inference.covariance(parameter, parameter)), 1.0);
    for (int k = 0; k < kMostPoints; ++k) {
      const double u = clamped(u0 + sign * at), distance = std::abs(u - u0);
      if (distance < inside + 1e-9) break;
      const double root = root_at(u, found);
      points.emplace_back(u - u0, root * root);
      (root < wanted ? inside : outside) = distance;
      (root < wanted ? inside_root : outside_root) = root;
      if (std::abs(root - wanted) < kClose * wanted) return distance * wanted / root;
      const bool bracketed = std::isfinite(outside);
      if (bracketed && outside - inside < kClose * outside) break;
      at = bracketed ? between() : std::min(kFartherAtMost, wanted / std::max(root, 1e-3)) * distance;
    }
    return std::isfinite(outside) ? between() : std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace

std::vector<Profile> profile_likelihood(const CalibrationProblem& problem, const FitResult& fit,
                                        const Inference& inference, const std::vector<bool>& fixed, int jobs,
                                        FitResult& lower) {
  std::vector<int> wanted;
  for (int p = 0; p < problem.parameter_count(); ++p)
    if (!fixed[p] && !problem.parameters[p].is_error() && !problem.parameters[p].has_prior) wanted.push_back(p);
  std::vector<Profile> profiles(wanted.size());
  std::vector<std::vector<std::pair<double, double>>> points(2 * wanted.size());
  std::mutex mutex;
  for_each_on_threads(static_cast<int>(points.size()), jobs, [&](int k) {
    Profile& profile = profiles[k / 2];
    const double quantile = inference.parameters[static_cast<std::size_t>(wanted[k / 2])].quantile;
    const Side side{problem,
                    fit,
                    inference,
                    fixed,
                    wanted[k / 2],
                    k % 2 == 0 ? -1.0 : 1.0,
                    quantile * quantile,
                    follows_from_rest(problem)};
    const double distance = side.crossing(points[k], [&](FitResult found) {
      const std::lock_guard lock(mutex);
      if (found.cost < lower.cost) lower = std::move(found);
    });
    const FittedParameter& parameter = problem.parameters[wanted[k / 2]];
    (k % 2 == 0 ? profile.low : profile.high) =
        std::isfinite(distance) ? parameter.value(fit.globals.u[wanted[k / 2]] + side.sign * distance) : distance;
  });
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    std::vector<std::pair<double, double>> all = {{0.0, 0.0}};
    for (const std::size_t side : {2 * k, 2 * k + 1}) all.insert(all.end(), points[side].begin(), points[side].end());
    std::sort(all.begin(), all.end());
    profiles[k].parameter = wanted[k];
    for (const auto& [u, risen] : all) {
      profiles[k].value.push_back(problem.parameters[wanted[k]].value(fit.globals.u[wanted[k]] + u));
      profiles[k].cost_rise.push_back(risen);
    }
  }
  return profiles;
}

void take_intervals(const std::vector<Profile>& profiles, const CalibrationProblem& problem, Inference& inference) {
  for (const Profile& profile : profiles) {
    ParameterEstimate& e = inference.parameters[profile.parameter];
    // A side that nothing tried excludes, up to a bound or as far as was looked, is open at least to there.
    const double low = std::isfinite(profile.low) ? profile.low : std::min(e.low, profile.value.front());
    const double high = std::isfinite(profile.high) ? profile.high : std::max(e.high, profile.value.back());
    if (low == e.low && high == e.high) continue;
    const FittedParameter& parameter = problem.parameters[profile.parameter];
    const double width = parameter.coordinate(high) - parameter.coordinate(low);
    if (!std::isfinite(width)) continue;
    const double error = 0.5 * width / e.quantile, grow = error / e.coordinate_error;
    inference.covariance.row(profile.parameter) *= grow;
    inference.covariance.col(profile.parameter) *= grow;
    e.standard_error *= grow;
    e.coordinate_error = error;
    e.low = low;
    e.high = high;
    assess_identifiability(parameter, e);
  }
}

}  // namespace boresight
