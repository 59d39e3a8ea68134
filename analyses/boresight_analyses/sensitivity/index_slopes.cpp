#include "boresight_analyses/sensitivity/index_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/mechanism/interruption.hpp"
#include "boresight/slopes/sensitive_motion.hpp"
#include "boresight/slopes/start_slopes.hpp"

namespace boresight {
namespace {

PoseError error_of(const Mechanism& mechanism, const PreparedScene& prepared, const StandingDisplacement& standing,
                   double t, const VecX& z, const Vec6& besides = Vec6::Zero()) {
  const int body = mechanism.boresight_body();
  const BodyMotion ideal = prepared.ideal().body(t, body);
  BodyMotion truth = ideal;
  displace(truth, DisplacedBodies(prepared, standing, t, z).displacement(body) + besides);
  return pose_error({truth.p, Quat(truth.R)}, {ideal.p, Quat(ideal.R)}, mechanism.pointing());
}

// A central difference of fourth order, its relative truncation some 1e-12 at a thousandth of the size (Fornberg 1988, table 1).
template <typename At>
double slope_of(double h, const At& at) {
  return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
}

// The step of an error, so that what it displaces is a thousandth of the error there is; 0 where either vanishes.
double step_of(const Vec6& per_unit, const PoseError& error, double length) {
  const double moved = per_unit.head<3>().norm() / length + per_unit.tail<3>().norm();
  return moved > 0.0 ? 1e-3 * (error.position / length + error.orientation) / moved : 0.0;
}

}  // namespace

IndexSlopes index_slopes(const Mechanism& mechanism, const PreparedScene& prepared,
                         const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                         const std::vector<double>& values, const IndexChoice& index, const SlopeOptions& options) {
  const Parameters parameters = parameters_at(values);
  const StandingDisplacement standing = prepared.standing(parameters);
  const auto tables = prepared.tables(parameters, standing);
  std::vector<StandingDisplacement> by_error;  // per unit
  std::vector<std::string> why_not(values.size());
  for (const std::vector<double>& unit : options.errors) {
    Parameters of_unit = parameters;
    of_unit.error = unit;
    by_error.push_back(prepared.standing(of_unit));
    why_not.emplace_back();
    for (std::size_t e = 0; e < unit.size(); ++e)
      if (unit[e] != 0.0 && by_error.back() && by_error.back().influence().uses_play(e))
        why_not.back() = "error." + mechanism.description().errors[e].name +
                         " takes up play of joints that hold each other: what that does is no slope of the motion";
  }
  const Eigen::Index n = tables->layout.n;
  MotionRequest request;
  request.end = options.end > 0.0 ? options.end : mechanism.duration();
  const StartSlopes start = start_slopes(mechanism, *tables, parameters_at, values, true);
  const bool own_start = options.start_state.size() == 0;
  request.start_state = own_start ? start.state : options.start_state;
  request.start_state.head(n).array() += options.start_offset;
  if (own_start && !values.empty()) request.start_by_parameters = start.by;
  request.tolerance = options.tolerance;
  request.longest_step = longest_step_of(prepared);
  request.derivative_tolerance = options.control_derivatives ? options.tolerance : 0.0;
  request.by_parameters = !values.empty();
  for (int k = 0; k <= options.points; ++k)
    request.times.push_back(index.start + (request.end - index.start) * k / options.points);
  request.reached = [end = request.end](double t) { work_reached("following the motion's derivatives", t / end); };
  const ContactNumbers numbers = contact_numbers(mechanism, parameters_at, values);
  request.implicit = request.by_parameters && implicit_steps_pay(mechanism, parameters, tables, numbers, request);
  const SensitiveMotion motion = follow_with_sensitivity(mechanism, parameters, tables, numbers, request);

  // The pose's error is a closed-form function of z and of the standing errors.
  const std::size_t count = request.times.size();
  std::vector<double> e(count);
  const auto of_contacts = static_cast<Eigen::Index>(values.size());
  MatX slope = MatX::Zero(of_contacts + static_cast<Eigen::Index>(by_error.size()), static_cast<Eigen::Index>(count));
  IndicesOverTime indices(mechanism.pointing().line_of_sight.has_value());
  for (std::size_t k = 0; k < count; ++k) {
    const double t = request.times[k];
    const auto column = static_cast<Eigen::Index>(k);
    const VecX z = motion.state.col(column).head(n);
    const PoseError error = error_of(mechanism, prepared, standing, t, z);
    indices.add(t, error);
    e[k] = index.of(error);
    for (std::size_t i = 0; i < by_error.size(); ++i) {
      const Vec6 per_unit = by_error[i].at(t, mechanism.boresight_body());
      const double h = step_of(per_unit, error, mechanism.characteristic_length());
      if (h == 0.0) continue;
      slope(of_contacts + static_cast<Eigen::Index>(i), column) = slope_of(
          h, [&](double step) { return index.of(error_of(mechanism, prepared, standing, t, z, step * per_unit)); });
    }
    const double h = 1e-3 * z.lpNorm<Eigen::Infinity>();
    if (h == 0.0 || of_contacts == 0) continue;  // the error has no slope where it vanishes
    VecX gradient(n);
    for (Eigen::Index i = 0; i < n; ++i)
      gradient[i] = slope_of(h, [&](double step) {
        VecX moved = z;
        moved[i] += step;
        return index.of(error_of(mechanism, prepared, standing, t, moved));
      });
    slope.col(column).head(of_contacts) = motion.by[k].topRows(n).transpose() * gradient;
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
  for (std::size_t k = 0; k < why_not.size(); ++k)
    if (!why_not[k].empty()) out.by[k] = std::numeric_limits<double>::quiet_NaN();
  out.why_not = std::move(why_not);
  return out;
}

}  // namespace boresight
