// What a window's readings are, what is left of the measured ones, and how that follows parameters and start state.
#include <algorithm>
#include <cmath>

#include "boresight/math/cross_matrix.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/slopes/start_slopes.hpp"
#include "boresight_analyses/calibration/calibration_problem.hpp"
#include "boresight_analyses/calibration/rig.hpp"

namespace boresight {

void CalibrationProblem::channel_rows(const CalibrationRun& run, int kind, double t, int n, ChannelRows& out) const {
  const int body = run.mechanism->boresight_body();
  out.size = kind >= 9;
  out.by_pose.setZero();
  const Vec3 place_B = run.data.place_of(kind);
  if (is_of_a_point(kind)) {
    Eigen::Matrix<double, 3, 6> of_point = Eigen::Matrix<double, 3, 6>::Identity();
    if (!place_B.isZero(0.0)) of_point.rightCols<3>() = -cross_matrix(run.prepared->ideal().body(t, body).R * place_B);
    if (out.size)
      out.by_pose = of_point;
    else
      out.by_pose.row(0) = of_point.row(kind);
  } else if (kind < 6) {
    out.by_pose(0, kind) = 1.0;
  } else {
    const BodyMotion ideal = run.prepared->ideal().body(t, body);
    const PointingQuantity quantity = out.size ? PointingQuantity(kind - 9) : PointingQuantity::boresight_error;
    const auto gain = error_gain(quantity, {ideal.p, Quat(ideal.R)}, ideal.R * run.mechanism->boresight_B(),
                                 run.mechanism->pointing().line_of_sight);
    if (out.size)
      out.by_pose = gain;
    else
      out.by_pose.row(0) = gain.row(kind - 6);
  }
  if (n == 0) {
    out.rows.resize(3, 0);
    return;
  }
  const TimeTable& gain = run.prepared->pose_gain(body);
  std::vector<double> row(gain.width());
  gain.at(t, row.data());
  out.rows =
      out.by_pose * Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(row.data(), 6, n);
}

void CalibrationProblem::set_start(const Window& w, const std::vector<double>& values, const VecX& state,
                                   bool derivatives, MotionRequest& request) const {
  request.start_state = state.cwiseProduct(state_scale(w));
  request.longest_step = longest_step_of(*runs[w.run].prepared);
  if (!w.from_rest) return;
  const CalibrationRun& run = runs[w.run];
  const StartSlopes start = start_slopes(*run.mechanism, *tables_at(w.run, values), with_followed(w.run, values),
                                         followed_values(values), derivatives, request.beside);
  request.start_state += start.state;
  request.start_by_parameters = start.by;
}

namespace {

// A channel's reading of the boresight body at t, displaced by x from where it is commanded to be; exactly.
double displaced_reading(const CalibrationRun& run, int channel, double t, const Vec6& x) {
  const BodyMotion ideal = run.prepared->ideal().body(t, run.mechanism->boresight_body());
  BodyMotion body = ideal;
  displace(body, x);
  PoseSample sample;
  sample.pose = {body.p, Quat(body.R)};
  sample.ideal = {ideal.p, Quat(ideal.R)};
  sample.error = pose_error(sample.pose, sample.ideal, run.mechanism->pointing());
  return channel_reading(channel, sample, run.mechanism->boresight_B(), run.data.place_of(channel));
}

}  // namespace

std::vector<CalibrationProblem::Moment> CalibrationProblem::moments(double lag) const {
  // Abramowitz and Stegun (1964), table 25.9, n = 3; without a lag only its slope matters, and that is of the mean.
  if (lag == 0.0) return {{1.0, 1.0}};
  return {{0.415774556783, 0.711093009929}, {2.294280360279, 0.278517733569}, {6.289945082937, 0.0103892565016}};
}

std::vector<double> CalibrationProblem::reading_times(const Window& w, const Globals& globals) const {
  std::vector<double> times;
  for (const Moment& m : moments(globals.lag))
    for (int i = w.first; i <= w.last; ++i)
      times.push_back(
          std::clamp(runs[w.run].data.time[i] + globals.time_offset - globals.lag * m.back, w.start, w.end));
  std::sort(times.begin(), times.end());
  return times;
}

MatX CalibrationProblem::mean_readings(const Window& w, const Globals& globals, const MatX& at_times) const {
  const std::vector<double> times = reading_times(w, globals);
  MatX mean = MatX::Zero(w.last - w.first + 1, at_times.cols());
  for (const Moment& m : moments(globals.lag))
    for (int i = w.first; i <= w.last; ++i) {
      const double t =
          std::clamp(runs[w.run].data.time[i] + globals.time_offset - globals.lag * m.back, w.start, w.end);
      mean.row(i - w.first) += m.weight * at_times.row(std::lower_bound(times.begin(), times.end(), t) - times.begin());
    }
  return mean;
}

void CalibrationProblem::evaluate(const Window& w, const Globals& globals, const VecX& state, bool derivatives,
                                  WindowResiduals& out) const {
  // Contacts whose gaps are no numbers never touch, and that motion is followed.
  if (!packed(globals).allFinite() || !state.allFinite()) throw ComputationError("a place of the fit is no number");
  const CalibrationRun& run = runs[w.run];
  const int n = freedoms(w.run), P = parameter_count();
  const ModelCorrection* correction = corrections.empty() || !w.from_rest ? nullptr : &corrections[w.run];
  if (correction && correction->tangent) return evaluate_tangent(w, globals, derivatives, out);
  const std::vector<double> theta = values(globals);
  const VecX scale = state_scale(w);
  const std::vector<int> followed = followed_parameters();
  const std::vector<double> times = reading_times(w, globals);
  out.motion = n > 0 ? follow(w, theta, state, times, derivatives) : SensitiveMotion{};
  const Parameters sample_of_fit = parameters_at(w.run, theta);
  const bool by_time = derivatives && (fit_time_offset || fit_lag);
  constexpr double kShort = 1e-5;  // [s], against the motion's own time
  const auto later_than = [&](double t) { return std::min(t + kShort, run.mechanism->duration()); };
  const auto earlier_than = [&](double t) { return std::max(t - kShort, 0.0); };
  const std::vector<Vec6> nothing(times.size(), Vec6::Zero());
  std::vector<Vec6> standing = nothing, standing_later = nothing, standing_earlier = nothing;
  if (run.standing) {
    standing = run.standing->displacements(sample_of_fit, times);
    if (by_time) {
      std::vector<double> later, earlier;
      for (const double t : times) {
        later.push_back(later_than(t));
        earlier.push_back(earlier_than(t));
      }
      standing_later = run.standing->displacements(sample_of_fit, later);
      standing_earlier = run.standing->displacements(sample_of_fit, earlier);
    }
  }
  const int samples = w.last - w.first + 1, most = samples * static_cast<int>(channels.size());
  out.r.resize(most);
  out.sample.clear();
  out.channel.clear();
  if (derivatives) {
    out.by_global.setZero(most, global_count());
    out.by_state.setZero(most, 2 * n);
  }
  int m = 0;
  ChannelRows at, later, earlier;
  const VecX at_rest;
  for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
    const int column_here = column(w.run, c), offset = offset_index(w.run, c);
    if (column_here < 0) continue;
    for (int i = 0; i < samples; ++i) {
      const double measured = run.data.value(w.first + i, column_here);
      if (!std::isfinite(measured)) continue;
      const double of_clock = run.data.time[w.first + i];
      double model = 0.0;
      for (const Moment& moment : moments(globals.lag)) {
        const double t = std::clamp(of_clock + globals.time_offset - globals.lag * moment.back, w.start, w.end);
        const auto k = static_cast<Eigen::Index>(std::lower_bound(times.begin(), times.end(), t) - times.begin());
        channel_rows(run, channels[c], t, n, at);
        const VecX z = n > 0 ? VecX(out.motion.state.col(k).head(n)) : at_rest;
        const Vec3 vector = at.rows * z + at.by_pose * standing[k];
        const double own = at.size ? vector.norm() : vector[0];
        model += moment.weight *
                 (run.standing ? displaced_reading(run, channels[c], t, play_displaces(run, t, z) + standing[k]) : own);
        if (!derivatives) continue;
        const Vec3 along = at.size ? Vec3(vector / std::max(own, 1e-12)) : Vec3::UnitX();
        const Eigen::RowVectorXd by_z = moment.weight * along.transpose() * at.rows / sigma[c];
        for (std::size_t p = 0; p < followed.size(); ++p)
          out.by_global(m, followed[p]) += by_z.dot(out.motion.by[k].col(static_cast<Eigen::Index>(p)).head(n)) *
                                           parameters[followed[p]].slope(globals.u[followed[p]]);
        if (run.standing) {
          const Eigen::RowVectorXd by_error =
              moment.weight * along.transpose() * at.by_pose * run.standing->slopes(w.first + i) / sigma[c];
          for (int p = 0; p < P; ++p)
            if (parameters[p].is_error()) out.by_global(m, p) += by_error[p] * parameters[p].slope(globals.u[p]);
        }
        if (n > 0 && !w.from_rest)
          out.by_state.row(m) += by_z * out.motion.by[k].rightCols(2 * n).topRows(n) * scale.asDiagonal();
        // Beyond the motion's ends readings stay what they are there.
        const double wanted = of_clock + globals.time_offset - globals.lag * moment.back;
        if (!by_time || wanted < w.start || wanted > w.end) continue;
        channel_rows(run, channels[c], later_than(t), n, later);
        channel_rows(run, channels[c], earlier_than(t), n, earlier);
        const Vec3 turning = ((later.rows - earlier.rows) * z + later.by_pose * standing_later[k] -
                              earlier.by_pose * standing_earlier[k]) /
                             (later_than(t) - earlier_than(t));
        const double moving =
            (n > 0 ? by_z.dot(out.motion.state.col(k).tail(n)) : 0.0) + moment.weight * along.dot(turning) / sigma[c];
        if (fit_time_offset) out.by_global(m, time_offset_column()) += moving;
        if (fit_lag) out.by_global(m, lag_column()) -= moment.back * moving;
      }
      if (correction) model += correction->offset(w.first + i, column_here);
      out.r[m] = (model + globals.offset_at(offset, of_clock) - measured) / sigma[c];
      out.sample.push_back(w.first + i);
      out.channel.push_back(c);
      if (derivatives && fit_bias) out.by_global(m, bias_column() + offset) = 1.0 / sigma[c];
      if (derivatives && fit_drift) out.by_global(m, drift_column() + offset) = of_clock / sigma[c];
      ++m;
    }
  }
  out.r.conservativeResize(m);
  if (!derivatives) return;
  out.by_global.conservativeResize(m, Eigen::NoChange);
  out.by_state.conservativeResize(m, Eigen::NoChange);
}

std::shared_ptr<const SceneTables> CalibrationProblem::tables_at(int run, const std::vector<double>& theta) const {
  const bool of_masses = std::any_of(parameters.begin(), parameters.end(),
                                     [](const FittedParameter& p) { return !p.is_error() && !p.is_contact(); });
  return of_masses ? runs[run].prepared->tables(parameters_at(run, theta)) : runs[run].tables;
}

std::vector<TablesBeside> CalibrationProblem::tables_beside(int run, const std::vector<double>& theta) const {
  // To either side, of the value: what tables bend by in between is a millionth of their slope.
  constexpr double kShare = 1e-3;
  std::vector<TablesBeside> beside;
  const std::vector<int> followed = followed_parameters();
  for (std::size_t k = 0; k < followed.size(); ++k) {
    const int p = followed[k];
    if (parameters[p].is_contact()) continue;
    const auto at = [&](double share) {
      std::vector<double> moved = theta;
      moved[p] *= 1.0 + share;
      return runs[run].prepared->tables(parameters_at(run, moved));
    };
    beside.push_back({static_cast<int>(k), 2.0 * kShare * theta[p], at(-kShare), at(kShare)});
  }
  return beside;
}

SensitiveMotion CalibrationProblem::follow(const Window& w, const std::vector<double>& theta, const VecX& state,
                                           const std::vector<double>& times, bool derivatives) const {
  const CalibrationRun& run = runs[w.run];
  MotionRequest request;
  request.start = w.start;
  request.end = w.end;
  if (derivatives) request.beside = tables_beside(w.run, theta);
  set_start(w, theta, state, derivatives, request);
  request.tolerance = tolerance;
  request.by_parameters = derivatives;
  request.by_start_state = derivatives && !w.from_rest;
  request.derivative_tolerance = derivatives ? derivative_tolerance : 0.0;
  request.times = times;
  request.most_steps = w.most_steps;
  request.implicit = run.implicit_steps;
  return follow_with_sensitivity(*run.mechanism, parameters_at(w.run, theta), tables_at(w.run, theta),
                                 contact_numbers_at(w.run, theta), request);
}

// E z of the boresight body.
Vec6 CalibrationProblem::play_displaces(const CalibrationRun& run, double t, const VecX& z) const {
  if (z.size() == 0) return Vec6::Zero();
  const TimeTable& gain = run.prepared->pose_gain(run.mechanism->boresight_body());
  std::vector<double> row(gain.width());
  gain.at(t, row.data());
  return Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(row.data(), 6, z.size()) * z;
}

void CalibrationProblem::evaluate_tangent(const Window& w, const Globals& globals, bool derivatives,
                                          WindowResiduals& out) const {
  const TangentModel& model = *corrections[w.run].tangent;
  const VecX away = globals.u - model.at;
  const double later = globals.time_offset - model.time_offset, more_lag = globals.lag - model.lag;
  const int P = parameter_count(), most = (w.last - w.first + 1) * static_cast<int>(channels.size());
  out.motion = model.motion;
  out.r.resize(most);
  out.sample.clear();
  out.channel.clear();
  if (derivatives) {
    out.by_global.setZero(most, global_count());
    out.by_state.setZero(most, state_size(w));
  }
  int m = 0;
  for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
    const int k = column(w.run, c), offset = offset_index(w.run, c);
    if (k < 0) continue;
    for (int i = w.first; i <= w.last; ++i) {
      const double measured = runs[w.run].data.value(i, k);
      if (!std::isfinite(measured)) continue;
      double reading = model.reading(i, k) + model.by_time(i, k) * later + model.by_lag(i, k) * more_lag;
      for (int p = 0; p < P; ++p) reading += model.slope[p](i, k) * away[p];
      const double of_clock = runs[w.run].data.time[i];
      reading += globals.offset_at(offset, of_clock);
      out.r[m] = (reading - measured) / sigma[c];
      out.sample.push_back(i);
      out.channel.push_back(c);
      if (derivatives) {
        for (int p = 0; p < P; ++p) out.by_global(m, p) = model.slope[p](i, k) / sigma[c];
        if (fit_time_offset) out.by_global(m, time_offset_column()) = model.by_time(i, k) / sigma[c];
        if (fit_lag) out.by_global(m, lag_column()) = model.by_lag(i, k) / sigma[c];
        if (fit_bias) out.by_global(m, bias_column() + offset) = 1.0 / sigma[c];
        if (fit_drift) out.by_global(m, drift_column() + offset) = of_clock / sigma[c];
      }
      ++m;
    }
  }
  out.r.conservativeResize(m);
  if (!derivatives) return;
  out.by_global.conservativeResize(m, Eigen::NoChange);
  out.by_state.conservativeResize(m, Eigen::NoChange);
}

}  // namespace boresight
