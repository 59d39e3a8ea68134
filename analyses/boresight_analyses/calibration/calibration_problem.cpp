#include "boresight_analyses/calibration/calibration_problem.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/slopes/start_slopes.hpp"

namespace boresight {

CalibrationRun::CalibrationRun(std::string run_name, std::shared_ptr<const Mechanism> with_settings,
                               MeasuredData measured)
    : name(std::move(run_name)), mechanism(std::move(with_settings)), data(std::move(measured)) {
  prepared = std::make_shared<const PreparedScene>(*mechanism, ideal_motion(*mechanism, mechanism->parameters()),
                                                   mechanism->parameters());
  tables = prepared->tables(mechanism->parameters());
  prepared->pose_gain(mechanism->boresight_body());
  if (tables->layout.n == 0) {
    std::string why;
    for (const std::string& sentence : prepared->held()) why += (why.empty() ? "" : "; ") + sentence;
    throw ComputationError("no play of " + mechanism->name() +
                           " can move, so that measured motions say nothing of its contacts" +
                           (why.empty() ? "" : ": " + why));
  }
}

double ResidualLoss::residual(double r) const {
  const double a = std::abs(r);
  if (kind == Loss::huber && a > scale) return std::copysign(std::sqrt(2.0 * scale * a - scale * scale), r);
  if (kind == Loss::cauchy) return std::copysign(scale * std::sqrt(std::log1p(r * r / (scale * scale))), r);
  return r;
}

double ResidualLoss::slope(double r) const {
  const double a = std::abs(r);
  if (kind == Loss::huber && a > scale) return scale / std::sqrt(2.0 * scale * a - scale * scale);
  if (kind == Loss::cauchy && a > 1e-6 * scale) return r / (1.0 + r * r / (scale * scale)) / residual(r);
  return 1.0;
}

double ResidualLoss::score(double r) const { return residual(r) * slope(r); }

double ResidualLoss::weight(double r) const {
  const double square = r * r / (scale * scale);
  if (kind == Loss::huber) return square > 1.0 ? 0.0 : 1.0;
  if (kind == Loss::cauchy) return std::max(0.0, (1.0 - square) / ((1.0 + square) * (1.0 + square)));
  return 1.0;
}

void CalibrationProblem::prepare(double window_length, bool from_rest) {
  channels.clear();
  windows.clear();
  for (const CalibrationRun& run : runs)
    for (int c : run.data.channels)
      if (std::find(channels.begin(), channels.end(), c) == channels.end()) channels.push_back(c);
  std::sort(channels.begin(), channels.end());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const MeasuredData& data = runs[r].data;
    const double duration = runs[r].mechanism->duration();
    for (std::size_t i = 0; i < data.time.size(); ++i)
      if (data.time[i] < 0.0 || data.time[i] > duration * (1.0 + 1e-9))
        throw InputError({data.file, data.line[i]}, "t", std::to_string(data.time[i]) + " s",
                         "a time within the motion, 0 to " + std::to_string(duration) + " s");
    const int samples = static_cast<int>(data.time.size());
    for (int first = 0; first < samples;) {
      int last = first;
      while (last + 1 < samples && data.time[last + 1] < data.time[first] + window_length) ++last;
      Window w{static_cast<int>(r), first, last, 0.0, 0.0, false};
      w.start = std::max(0.0, data.time[first] - largest_time_offset);
      w.end = std::min(duration, data.time[last] + largest_time_offset);
      w.from_rest = from_rest && first == 0;
      if (w.from_rest) w.start = 0.0;
      const auto values = data.value.middleRows(first, last - first + 1).array();
      // Its own start state takes 2n numbers; a window that has not more says nothing.
      if (values.isFinite().count() > (w.from_rest ? 0 : state_size(w))) windows.push_back(w);
      first = last + 1;
    }
  }
}

std::vector<std::string> CalibrationProblem::global_names() const {
  std::vector<std::string> names;
  for (const FittedParameter& p : parameters) names.push_back(p.path);
  if (fit_time_offset) names.emplace_back("time_offset");
  if (fit_bias)
    for (int c : channels) names.push_back(std::string("bias.") + channel_names()[c].name);
  return names;
}

VecX CalibrationProblem::state_scale(const Window& window) const {
  const double clearance = smallest_clearance(runs[window.run].mechanism->parameters());
  const double length = clearance > 0.0 ? clearance : 1e-4;
  VecX scale = VecX::Constant(state_size(window), length);
  scale.tail(scale.size() / 2) /= kFlightTime;
  return scale;
}

VecX CalibrationProblem::prior_deviation(const Window& window) const {
  VecX deviation = VecX::Constant(state_size(window), 10.0);
  deviation.tail(deviation.size() / 2).setConstant(100.0);
  return deviation;
}

int CalibrationProblem::column(int run, int channel) const {
  const std::vector<int>& own = runs[run].data.channels;
  const auto found = std::find(own.begin(), own.end(), channels[channel]);
  return found == own.end() ? -1 : static_cast<int>(found - own.begin());
}

Globals CalibrationProblem::start() const {
  Globals g;
  g.u.resize(parameter_count());
  for (int p = 0; p < parameter_count(); ++p) g.u[p] = parameters[p].coordinate(parameters[p].start);
  if (fit_bias) g.bias = VecX::Zero(static_cast<Eigen::Index>(channels.size()));
  return g;
}

std::vector<double> CalibrationProblem::values(const Globals& globals) const {
  std::vector<double> values(parameters.size());
  for (std::size_t p = 0; p < values.size(); ++p)
    values[p] = parameters[p].value(globals.u[static_cast<Eigen::Index>(p)]);
  return values;
}

Parameters CalibrationProblem::parameters_at(int run, const std::vector<double>& values) const {
  Parameters at = runs[run].mechanism->parameters();
  for (std::size_t p = 0; p < values.size(); ++p) parameters[p].place.front().set(at, values[p]);
  return at;
}

ContactNumbers CalibrationProblem::contact_numbers_at(int run, const std::vector<double>& values) const {
  return contact_numbers(
      *runs[run].mechanism, [&](const std::vector<double>& x) { return parameters_at(run, x); }, values);
}

void CalibrationProblem::channel_rows(const CalibrationRun& run, int kind, double t, ChannelRows& out) const {
  const int n = run.tables->layout.n, body = run.mechanism->boresight_body();
  const TimeTable& gain = run.prepared->pose_gain(body);
  std::vector<double> row(gain.width());
  gain.at(t, row.data());
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>> E(row.data(), 6, n);
  out.size = kind >= 9;
  out.rows.setZero(3, n);
  if (kind < 6) {
    out.rows.row(0) = E.row(kind);
    return;
  }
  const BodyMotion ideal = run.prepared->ideal().body(t, body);
  const PointingQuantity quantity = out.size ? PointingQuantity(kind - 9) : PointingQuantity::boresight_error;
  const MatX rows = error_gain(quantity, {ideal.p, Quat(ideal.R)}, ideal.R * run.mechanism->boresight_B(),
                               run.mechanism->pointing().line_of_sight) *
                    E;
  if (out.size)
    out.rows = rows;
  else
    out.rows.row(0) = rows.row(kind - 6);
}

void CalibrationProblem::set_start(const Window& w, const std::vector<double>& values, const VecX& state,
                                   bool derivatives, MotionRequest& request) const {
  request.start_state = state.cwiseProduct(state_scale(w));
  if (!w.from_rest) return;
  const CalibrationRun& run = runs[w.run];
  const StartSlopes start = start_slopes(
      *run.mechanism, *run.tables, [&](const std::vector<double>& x) { return parameters_at(w.run, x); }, values,
      derivatives);
  request.start_state += start.state;
  request.start_by_parameters = start.by;
}

void CalibrationProblem::evaluate(const Window& w, const Globals& globals, const VecX& state, bool derivatives,
                                  WindowResiduals& out) const {
  const CalibrationRun& run = runs[w.run];
  const int n = run.tables->layout.n, P = parameter_count();
  const ModelCorrection* correction = corrections.empty() || !w.from_rest ? nullptr : &corrections[w.run];
  if (correction && correction->tangent) return evaluate_tangent(w, globals, derivatives, out);
  const std::vector<double> theta = values(globals);
  const VecX scale = state_scale(w);
  MotionRequest request;
  request.start = w.start;
  request.end = w.end;
  set_start(w, theta, state, derivatives, request);
  request.tolerance = tolerance;
  request.by_parameters = derivatives;
  request.by_start_state = derivatives && !w.from_rest;
  request.derivative_tolerance = derivatives ? derivative_tolerance : 0.0;
  for (int i = w.first; i <= w.last; ++i)
    request.times.push_back(std::clamp(run.data.time[i] + globals.time_offset, w.start, w.end));
  out.motion = follow_with_sensitivity(*run.mechanism, parameters_at(w.run, theta), run.tables,
                                       contact_numbers_at(w.run, theta), request);
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
  for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
    const int column_here = column(w.run, c);
    if (column_here < 0) continue;
    for (int i = 0; i < samples; ++i) {
      const double measured = run.data.value(w.first + i, column_here);
      if (!std::isfinite(measured)) continue;
      const double t = request.times[i];
      channel_rows(run, channels[c], t, at);
      const auto z = out.motion.state.col(i).head(n);
      const Vec3 vector = at.rows * z;
      const double own = at.size ? vector.norm() : vector[0];
      double model = own;
      if (correction) model += correction->offset(w.first + i, column_here);
      const double bias = globals.bias.size() > 0 ? globals.bias[c] : 0.0;
      out.r[m] = (model + bias - measured) / sigma[c];
      out.sample.push_back(w.first + i);
      out.channel.push_back(c);
      if (derivatives) {
        const Vec3 along = at.size ? Vec3(vector / std::max(own, 1e-12)) : Vec3::UnitX();
        const Eigen::RowVectorXd by_z = along.transpose() * at.rows / sigma[c];
        for (int p = 0; p < P; ++p)
          out.by_global(m, p) = by_z.dot(out.motion.by[i].col(p).head(n)) * parameters[p].slope(globals.u[p]);
        if (!w.from_rest)
          out.by_state.row(m) = by_z * out.motion.by[i].rightCols(2 * n).topRows(n) * scale.asDiagonal();
        int g = P;
        if (fit_time_offset) {
          constexpr double kShort = 1e-5;  // [s], against the motion's own time
          channel_rows(run, channels[c], std::min(t + kShort, run.mechanism->duration()), later);
          channel_rows(run, channels[c], std::max(t - kShort, 0.0), earlier);
          const double apart = std::min(t + kShort, run.mechanism->duration()) - std::max(t - kShort, 0.0);
          const Vec3 turning = (later.rows - earlier.rows) * z / apart;
          out.by_global(m, g++) = by_z.dot(out.motion.state.col(i).tail(n)) + along.dot(turning) / sigma[c];
        }
        if (fit_bias) out.by_global(m, g + c) = 1.0 / sigma[c];
      }
      ++m;
    }
  }
  out.r.conservativeResize(m);
  if (derivatives) {
    out.by_global.conservativeResize(m, Eigen::NoChange);
    out.by_state.conservativeResize(m, Eigen::NoChange);
  }
}

void CalibrationProblem::evaluate_tangent(const Window& w, const Globals& globals, bool derivatives,
                                          WindowResiduals& out) const {
  const TangentModel& model = *corrections[w.run].tangent;
  const VecX away = globals.u - model.at;
  const double later = globals.time_offset - model.time_offset;
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
    const int k = column(w.run, c);
    if (k < 0) continue;
    for (int i = w.first; i <= w.last; ++i) {
      const double measured = runs[w.run].data.value(i, k);
      if (!std::isfinite(measured)) continue;
      double reading = model.reading(i, k) + model.by_time(i, k) * later;
      for (int p = 0; p < P; ++p) reading += model.slope[p](i, k) * away[p];
      if (globals.bias.size() > 0) reading += globals.bias[c];
      out.r[m] = (reading - measured) / sigma[c];
      out.sample.push_back(i);
      out.channel.push_back(c);
      if (derivatives) {
        for (int p = 0; p < P; ++p) out.by_global(m, p) = model.slope[p](i, k) / sigma[c];
        if (fit_time_offset) out.by_global(m, P) = model.by_time(i, k) / sigma[c];
        if (fit_bias) out.by_global(m, P + (fit_time_offset ? 1 : 0) + c) = 1.0 / sigma[c];
      }
      ++m;
    }
  }
  out.r.conservativeResize(m);
  if (!derivatives) return;
  out.by_global.conservativeResize(m, Eigen::NoChange);
  out.by_state.conservativeResize(m, Eigen::NoChange);
}

double CalibrationProblem::cost(const Window& window, const Globals& globals, const VecX& state) const {
  WindowResiduals at;
  try {
    evaluate(window, globals, state, false, at);
  } catch (const ComputationError&) {
    return std::numeric_limits<double>::infinity();
  }
  double sum = state.cwiseQuotient(prior_deviation(window)).squaredNorm();
  for (Eigen::Index i = 0; i < at.r.size(); ++i) sum += loss.residual(at.r[i]) * loss.residual(at.r[i]);
  return sum;
}

}  // namespace boresight
