#include "boresight_analyses/calibration/calibration_problem.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"

namespace boresight {
namespace {

[[noreturn]] void refuse_play_that_cannot_move(const CalibrationRun& run) {
  std::string why;
  for (const std::string& sentence : run.prepared->held()) why += (why.empty() ? "" : "; ") + sentence;
  throw ComputationError("no play of " + run.mechanism->name() +
                         " can move, so that measured motions say nothing of its contacts" +
                         (why.empty() ? "" : ": " + why));
}

}  // namespace

CalibrationRun::CalibrationRun(std::string run_name, std::shared_ptr<const Mechanism> with_settings,
                               MeasuredData measured)
    : name(std::move(run_name)), mechanism(std::move(with_settings)), data(std::move(measured)) {
  prepared = std::make_shared<const PreparedScene>(*mechanism, ideal_motion(*mechanism, mechanism->parameters()),
                                                   mechanism->parameters());
  if (prepared->scene().layout().n == 0) return;
  tables = prepared->tables(mechanism->parameters());
  prepared->pose_gain(mechanism->boresight_body());
}

void CalibrationRun::take(const Parameters& parameters) {
  if (!same_scene(parameters, told())) {
    // Of a motion that is simulated, masses decide where it goes.
    if (!is_kinematic(*mechanism) || !same_centers(parameters, told()))
      prepared = std::make_shared<const PreparedScene>(*mechanism, ideal_motion(*mechanism, parameters), parameters);
    if (tables) tables = prepared->tables(parameters);
    prepared->pose_gain(mechanism->boresight_body());
  }
  taken = std::make_shared<const Parameters>(parameters);
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

bool CalibrationProblem::follows_play() const {
  return std::any_of(parameters.begin(), parameters.end(), [](const FittedParameter& p) { return !p.is_error(); });
}

bool CalibrationProblem::fits_errors() const {
  return std::any_of(parameters.begin(), parameters.end(), [](const FittedParameter& p) { return p.is_error(); });
}

void CalibrationProblem::prepare(double window_length, bool from_rest) {
  const bool any_mass = std::any_of(parameters.begin(), parameters.end(),
                                    [](const FittedParameter& p) { return !p.is_error() && !p.is_contact(); });
  for (const CalibrationRun& run : runs)
    if (any_mass && !is_kinematic(*run.mechanism))
      throw ComputationError("calibrate fits masses where every freedom is driven: the motion of " +
                             run.mechanism->name() + " is simulated, and masses decide where it goes");
  if (follows_play())
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (freedoms(static_cast<int>(r)) == 0) refuse_play_that_cannot_move(runs[r]);
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
      w.start = start_of(w);
      w.end = end_of(w);
      // Poses have no state to start with.
      w.from_rest = (from_rest && first == 0) || !follows_play();
      if (w.from_rest && first == 0) w.start = 0.0;
      const auto values = data.value.middleRows(first, last - first + 1).array();
      // Its own start state takes 2n numbers; a window that has not more says nothing.
      if (values.isFinite().count() > (w.from_rest ? 0 : state_size(w))) windows.push_back(w);
      first = last + 1;
    }
  }
  find_offsets();
  prepare_errors();
  for (std::size_t r = 0; r < runs.size(); ++r) choose_steps(static_cast<int>(r));
}

// Each channel's, or each run's of each channel that it has readings of.
void CalibrationProblem::find_offsets() {
  offsets.clear();
  offset_index_.assign(runs.size() * channels.size(), -1);
  const int count = static_cast<int>(channels.size());
  const auto read = [&](int run, int channel) {
    const int k = column(run, channel);
    return k >= 0 && std::any_of(windows.begin(), windows.end(), [&](const Window& w) {
             return w.run == run &&
                    runs[run].data.value.col(k).segment(w.first, w.last - w.first + 1).array().isFinite().any();
           });
  };
  if (!offsets_per_run)
    for (int c = 0; c < count; ++c) offsets.push_back({-1, c});
  for (int r = 0; r < static_cast<int>(runs.size()); ++r)
    for (int c = 0; c < count; ++c) {
      int& index = offset_index_[static_cast<std::size_t>(r * count + c)];
      if (!offsets_per_run) {
        index = c;
      } else if (read(r, c)) {
        index = static_cast<int>(offsets.size());
        offsets.push_back({r, c});
      }
    }
}

void CalibrationProblem::choose_steps(int run) {
  if (freedoms(run) == 0) return;
  Window whole;
  whole.run = run;
  whole.end = runs[run].data.time.empty() ? runs[run].mechanism->duration() : runs[run].data.time.back();
  whole.from_rest = true;
  const std::vector<double> theta = values(start());
  MotionRequest request;
  request.end = whole.end;
  request.tolerance = tolerance;
  try {
    set_start(whole, theta, VecX::Zero(state_size(whole)), false, request);
    runs[run].implicit_steps = implicit_steps_pay(*runs[run].mechanism, parameters_at(run, theta),
                                                  tables_at(run, theta), contact_numbers_at(run, theta), request);
  } catch (const ComputationError&) {  // that it cannot be followed, the fit says
  }
}

double CalibrationProblem::start_of(const Window& w) const {
  // A lag looks back; behind five of them hardly anything is left.
  return std::max(0.0, runs[w.run].data.time[w.first] - largest_time_offset - (fit_lag ? 5.0 * lag_prior : 0.0));
}

double CalibrationProblem::end_of(const Window& w) const {
  return std::min(runs[w.run].mechanism->duration(), runs[w.run].data.time[w.last] + largest_time_offset);
}

void CalibrationProblem::prepare_errors() {
  constexpr int kFirstSize = 9;  // of channel_names(): from here on sizes without a direction
  if (fits_errors() && std::all_of(channels.begin(), channels.end(), [](int c) { return c >= kFirstSize; }))
    throw InputError({runs.front().data.file, 1}, "header", "sizes of errors alone",
                     "a channel with a sign too, such as dx, rx or bx: the size of a pointing error does not tell the "
                     "sign of what makes it");
  for (CalibrationRun& run : runs) {
    const Parameters& own = run.mechanism->parameters();
    if (!fits_errors() && !has_errors(own)) continue;
    if (!is_kinematic(*run.mechanism))
      throw ComputationError("calibrate takes standing errors where every freedom is driven: the motion of " +
                             run.mechanism->name() + " is simulated, and what errors do to it hangs on all of it");
    MatX weight = MatX::Zero(static_cast<Eigen::Index>(own.error.size()), parameter_count());
    for (int p = 0; p < parameter_count(); ++p) {
      if (!parameters[p].is_error()) continue;
      Parameters one = own;
      std::fill(one.error.begin(), one.error.end(), 0.0);
      parameters[p].place.front().set(one, 1.0);
      weight.col(p) = Eigen::Map<const VecX>(one.error.data(), weight.rows());
    }
    run.standing = std::make_shared<const StandingPoses>(
        run.mechanism, std::shared_ptr<const IdealMotion>(run.prepared, &run.prepared->ideal()), run.data.time,
        std::move(weight));
  }
}

std::vector<int> CalibrationProblem::followed_parameters() const {
  std::vector<int> followed;
  for (int p = 0; p < parameter_count(); ++p)
    if (!parameters[p].is_error()) followed.push_back(p);
  return followed;
}

std::vector<double> CalibrationProblem::followed_values(const std::vector<double>& values) const {
  std::vector<double> of_contacts;
  for (const int p : followed_parameters()) of_contacts.push_back(values[p]);
  return of_contacts;
}

std::function<Parameters(const std::vector<double>&)> CalibrationProblem::with_followed(
    int run, const std::vector<double>& values) const {
  return [this, run, all = values, contacts = followed_parameters()](const std::vector<double>& x) mutable {
    for (std::size_t c = 0; c < contacts.size(); ++c) all[contacts[c]] = x[c];
    return parameters_at(run, all);
  };
}

std::vector<std::string> CalibrationProblem::global_names() const {
  std::vector<std::string> names;
  for (const FittedParameter& p : parameters) names.push_back(p.path);
  if (fit_time_offset) names.emplace_back("time_offset");
  if (fit_lag) names.emplace_back("lag");
  for (const auto& [fitted, what] : {std::pair{fit_bias, "bias."}, {fit_drift, "drift."}})
    for (std::size_t k = 0; fitted && k < offsets.size(); ++k)
      names.push_back(what + (offsets[k].run < 0 ? std::string() : runs[offsets[k].run].name + ".") +
                      channel_names()[channels[offsets[k].channel]].name);
  return names;
}

std::string CalibrationProblem::global_unit(int g) const {
  if (g < parameter_count()) return parameters[g].si_unit;
  if (g < bias_column()) return "s";
  const bool drift = g >= drift_column();
  const std::string unit =
      channel_names()[channels[offsets[g - (drift ? drift_column() : bias_column())].channel]].si_unit;
  return drift ? unit + "/s" : unit;
}

VecX CalibrationProblem::prior_information() const {
  VecX information = VecX::Zero(global_count());
  for (int p = 0; p < parameter_count(); ++p) information[p] = parameters[p].prior_information();
  if (fit_time_offset && time_offset_prior > 0.0) information[time_offset_column()] = std::pow(time_offset_prior, -2);
  if (fit_lag && lag_prior > 0.0) information[lag_column()] = std::pow(lag_prior, -2);
  return information;
}

VecX CalibrationProblem::packed(const Globals& globals) const {
  VecX out(global_count());
  out.head(parameter_count()) = globals.u;
  if (fit_time_offset) out[time_offset_column()] = globals.time_offset;
  if (fit_lag) out[lag_column()] = globals.lag;
  if (fit_bias) out.segment(bias_column(), globals.bias.size()) = globals.bias;
  if (fit_drift) out.segment(drift_column(), globals.drift.size()) = globals.drift;
  return out;
}

Globals CalibrationProblem::unpacked(const VecX& from) const {
  Globals out = start();
  out.u = from.head(parameter_count());
  if (fit_time_offset) out.time_offset = from[time_offset_column()];
  if (fit_lag) out.lag = from[lag_column()];
  if (fit_bias) out.bias = from.segment(bias_column(), out.bias.size());
  if (fit_drift) out.drift = from.segment(drift_column(), out.drift.size());
  return out;
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
  if (fit_bias) g.bias = VecX::Zero(static_cast<Eigen::Index>(offsets.size()));
  if (fit_drift) g.drift = VecX::Zero(static_cast<Eigen::Index>(offsets.size()));
  return g;
}

std::vector<double> CalibrationProblem::values(const Globals& globals) const {
  std::vector<double> values(parameters.size());
  for (std::size_t p = 0; p < values.size(); ++p)
    values[p] = parameters[p].value(globals.u[static_cast<Eigen::Index>(p)]);
  return values;
}

Parameters CalibrationProblem::parameters_at(int run, const std::vector<double>& values) const {
  Parameters at = runs[run].told();
  for (std::size_t p = 0; p < values.size(); ++p) parameters[p].place.front().set(at, values[p]);
  return at;
}

ContactNumbers CalibrationProblem::contact_numbers_at(int run, const std::vector<double>& values) const {
  return contact_numbers(*runs[run].mechanism, with_followed(run, values), followed_values(values));
}

double CalibrationProblem::prior_cost(const Globals& globals) const {
  return prior_information().dot((packed(globals) - packed(start())).cwiseAbs2());
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
