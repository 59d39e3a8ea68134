#include "boresight_analyses/sensitivity/index_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/slopes/sensitive_motion.hpp"
#include "boresight/slopes/start_slopes.hpp"

namespace boresight {
namespace {

PoseError error_of(const Mechanism& mechanism, const PreparedScene& prepared, const StandingDisplacement& standing,
                   double t, const VecX& z) {
  BodyAcceleration unused;
  const int body = mechanism.boresight_body();
  const BodyMotion ideal = prepared.ideal().body(t, body);
  const BodyMotion truth = DisplacedBodies(prepared, standing, t, z).at_rest(body, unused);
  return pose_error({truth.p, Quat(truth.R)}, {ideal.p, Quat(ideal.R)}, mechanism.pointing());
}

}  // namespace

IndexSlopes index_slopes(const Mechanism& mechanism, const PreparedScene& prepared,
                         const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                         const std::vector<double>& values, const IndexChoice& index, const SlopeOptions& options) {
  const Parameters parameters = parameters_at(values);
  const auto tables = prepared.tables(parameters);
  const StandingDisplacement standing = prepared.standing(parameters);
  const Eigen::Index n = tables->layout.n;
  MotionRequest request;
  request.end = options.end > 0.0 ? options.end : mechanism.duration();
  const StartSlopes start = start_slopes(mechanism, *tables, parameters_at, values, true);
  const bool own_start = options.start_state.size() == 0;
  request.start_state = own_start ? start.state : options.start_state;
  request.start_state.head(n).array() += options.start_offset;
  if (own_start) request.start_by_parameters = start.by;
  request.tolerance = options.tolerance;
  request.derivative_tolerance = options.control_derivatives ? options.tolerance : 0.0;
  request.by_parameters = true;
  for (int k = 0; k <= options.points; ++k)
    request.times.push_back(index.start + (request.end - index.start) * k / options.points);
  const SensitiveMotion motion = follow_with_sensitivity(mechanism, parameters, tables,
                                                         contact_numbers(mechanism, parameters_at, values), request);

  // The pose's error is a closed-form function of z: its gradient by central differences of fourth order,
  // relative truncation some 1e-12 (Fornberg 1988, table 1).
  const std::size_t count = request.times.size();
  std::vector<double> e(count);
  MatX slope = MatX::Zero(static_cast<Eigen::Index>(values.size()), static_cast<Eigen::Index>(count));
  IndicesOverTime indices(mechanism.pointing().line_of_sight.has_value());
  for (std::size_t k = 0; k < count; ++k) {
    const double t = request.times[k];
    const auto column = static_cast<Eigen::Index>(k);
    const VecX z = motion.state.col(column).head(n);
    const PoseError error = error_of(mechanism, prepared, standing, t, z);
    indices.add(t, error);
    e[k] = index.of(error);
    const double h = 1e-3 * z.lpNorm<Eigen::Infinity>();
    if (h == 0.0) continue;  // the error has no slope where it vanishes
    VecX gradient(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto at = [&](double steps) {
        VecX moved = z;
        moved[i] += steps * h;
        return index.of(error_of(mechanism, prepared, standing, t, moved));
      };
      gradient[i] = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
    }
    slope.col(column) = motion.by[k].topRows(n).transpose() * gradient;
  }

  IndexSlopes out;
  out.value = index.of(indices.result());
  out.impacts = static_cast<int>(motion.impact_speed.size());
  out.grazing = static_cast<int>(motion.grazing.size());
  VecX by = VecX::Zero(slope.rows());
  if (index.statistic == "mean" || index.statistic == "rms") {
    for (std::size_t k = 0; k < count; ++k) {
      const double share = (k == 0 || k + 1 == count ? 0.5 : 1.0) / options.points;
      const double factor = index.statistic == "mean" ? 1.0 : out.value > 0.0 ? e[k] / out.value : 0.0;
      by += share * factor * slope.col(static_cast<Eigen::Index>(k));
    }
  } else {
    const auto nearest = std::min_element(
        e.begin(), e.end(), [&](double a, double b) { return std::abs(a - out.value) < std::abs(b - out.value); });
    by = slope.col(nearest - e.begin());
  }
  out.by.assign(by.data(), by.data() + by.size());
  return out;
}

}  // namespace boresight
