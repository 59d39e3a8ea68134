#include "boresight_analyses/calibration/profile_likelihood.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace boresight {

std::vector<Profile> profile_likelihood(const CalibrationProblem& problem, const FitResult& fit,
                                        const Inference& inference, const std::vector<bool>& fixed,
                                        double confidence, int jobs) {
  const boost::math::chi_squared one(1.0);
  const double rise = boost::math::quantile(one, confidence);
  std::vector<int> wanted;
  for (int p = 0; p < problem.parameter_count(); ++p)
    if (!fixed[p]) wanted.push_back(p);
  std::vector<Profile> profiles(wanted.size());
  in_parallel(static_cast<int>(wanted.size()), jobs, [&](int k) {
    Profile& profile = profiles[k];
    profile.parameter = wanted[k];
    const double deviation = std::min(inference.parameters[wanted[k]].coordinate_error, 1.0);
    std::vector<std::pair<double, double>> points = {{0.0, 0.0}};
    for (const double side : {-1.0, 1.0}) {
      Globals at = fit.globals;
      std::vector<VecX> states = fit.states;
      for (const double step : {1.0, 2.0, 3.0}) {
        const FittedParameter& parameter = problem.parameters[wanted[k]];
        at.u[wanted[k]] = std::clamp(fit.globals.u[wanted[k]] + side * step * deviation,
                                     parameter.lowest_coordinate(), parameter.highest_coordinate());
        FitOptions o;
        o.most_iterations = 6;
        o.fixed = fixed;
        o.fixed[wanted[k]] = true;
        const FitResult found = boresight::fit(problem, at, states, o);
        at = found.globals;
        states = found.states;
        const double risen = std::max(0.0, found.cost - fit.cost) / inference.variance_factor;
        points.emplace_back(at.u[wanted[k]] - fit.globals.u[wanted[k]], risen);
      }
    }
    std::sort(points.begin(), points.end());
    const FittedParameter& parameter = problem.parameters[wanted[k]];
    const double u0 = fit.globals.u[wanted[k]];
    for (const auto& [u, risen] : points) {
      profile.value.push_back(parameter.value(u0 + u));
      profile.cost_rise.push_back(risen);
    }
    // The root of the rise is nearly straight: interpolate in it.
    const auto crossing = [&](int side) {
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const auto& [a, ra] = points[i];
        const auto& [b, rb] = points[i + 1];
        if (side < 0 ? b > 0.0 : a < 0.0) continue;
        if ((ra - rise) * (rb - rise) > 0.0) continue;
        const double sa = std::sqrt(ra), sb = std::sqrt(rb);
        return parameter.value(u0 + a + (b - a) * (std::sqrt(rise) - sa) / (sb - sa));
      }
      return std::numeric_limits<double>::quiet_NaN();
    };
    profile.low = crossing(-1);
    profile.high = crossing(1);
  });
  return profiles;
}

}  // namespace boresight
