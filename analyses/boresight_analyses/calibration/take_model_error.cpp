#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "boresight_analyses/calibration/model_error.hpp"

namespace boresight {

void span(const std::vector<Globals>& ends, const CalibrationProblem& problem, const Globals& fitted,
          CalibrationModelError& error) {
  if (ends.size() < 2) return;
  const VecX at = problem.packed(fitted), known = error.covariance.diagonal().cwiseSqrt();
  for (const Globals& end : ends) {
    VecX off = problem.packed(end) - at;
    for (Eigen::Index g = 0; g < off.size(); ++g)
      if (!std::isfinite(known[g])) off[g] = 0.0;
    if ((off.array().abs() > known.array()).any()) ++error.ends;
    // One of them is the lowest itself, or all but.
    error.covariance += off * off.transpose() / static_cast<double>(ends.size() - 1);
  }
}

void take_model_error(const CalibrationModelError& error, double confidence, const CalibrationProblem& problem,
                      const Globals& fitted, Inference& inference) {
  const double quantile = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  MatX covariance = error.covariance;
  for (Eigen::Index g = 0; g < covariance.rows(); ++g) {
    ParameterEstimate& e = inference.parameters[static_cast<std::size_t>(g)];
    e.data_error = e.standard_error;
    if (!std::isfinite(covariance(g, g))) continue;
    const double before = e.coordinate_error * e.coordinate_error;
    const double more = std::max(0.0, covariance(g, g) - before), grow = std::sqrt((before + more) / covariance(g, g));
    covariance.row(g) *= grow;
    covariance.col(g) *= grow;
    e.coordinate_error = std::sqrt(before + more);
    const double extra = quantile * quantile * more;
    if (g >= problem.parameter_count()) {
      e.value += error.shift[g];
      const auto wider = [&](double half) { return std::sqrt(half * half + extra); };
      const double low = wider(e.value - error.shift[g] - e.low), high = wider(e.high - e.value + error.shift[g]);
      e.low = e.value - low;
      e.high = e.value + high;
      e.standard_error = e.coordinate_error;
      continue;
    }
    const FittedParameter& p = problem.parameters[static_cast<std::size_t>(g)];
    const double u = fitted.u[g], at = u + error.shift[g];
    const double low = u - p.coordinate(e.low), high = p.coordinate(e.high) - u;
    e.value = p.value(at);
    e.standard_error = p.slope(at) * e.coordinate_error;
    e.low = p.value(at - std::sqrt(low * low + extra));
    e.high = p.value(at + std::sqrt(high * high + extra));
    if (e.identifiable) assess_identifiability(p, e);
  }
  inference.covariance = covariance;
  const VecX deviation = covariance.diagonal().cwiseSqrt();
  inference.correlation = deviation.cwiseInverse().asDiagonal() * covariance * deviation.cwiseInverse().asDiagonal();
}

}  // namespace boresight
