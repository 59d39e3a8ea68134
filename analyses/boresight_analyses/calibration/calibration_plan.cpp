#include "boresight_analyses/calibration/calibration_plan.hpp"

#include <algorithm>
#include <cstdio>

#include "boresight/contact/normal_law.hpp"
#include "boresight/io/referred_file.hpp"
#include "boresight/io/tried_value.hpp"
#include "boresight/io/varied_paths.hpp"
#include "boresight/keys/parameter_unit.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight/play/joint_play.hpp"
#include "boresight_analyses/calibration/allowances.hpp"
#include "boresight_analyses/calibration/calibration_keys.hpp"
#include "boresight_analyses/random/csv_column.hpp"

namespace boresight {
namespace {

std::vector<Setting> settings_of(Cursor& table) {
  std::vector<Setting> settings;
  if (!table.has("set")) return settings;
  for (const std::string& text : table.texts("set")) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) table.fail_found("set", in_quotes(text), "PATH=VALUE");
    settings.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return settings;
}

PlannedParameter read_parameter(Cursor table, const MechanismDescription& mechanism) {
  table.only(calibrate_parameter_keys());
  PlannedParameter p;
  p.path = table.text("path");
  p.origin = table.origin("path");
  const bool is_error = p.path.starts_with("error.");
  const std::string unit = ParameterPath(mechanism, p.path, p.origin).unit();
  const SiUnit written_in = unit_of_parameters(mechanism, {p.path}, unit);
  const bool is_mass = !is_error && !p.path.starts_with("clearance.") && unit == "kg";
  if (!is_error && !is_mass && !p.path.starts_with("clearance."))
    table.fail("path",
               "a parameter of a clearance joint, a standing error, or a mass; speeds belong to a run's settings");
  const auto value = [&](const char* key) -> std::optional<double> {
    if (!table.has(key)) return {};
    if (p.written_unit.empty()) p.written_unit = table.unit_as_written(key);
    // The scale of a drive has no unit, as in the mechanism file.
    const double x = is_error && table.is_number(key) ? table.value(key, kRatio) : table.value(key, written_in);
    if ((!is_error || key == std::string("prior")) && !(x > 0.0)) table.fail(key, "more than 0");
    return x;
  };
  p.start = value("start");
  p.lower = value("lower");
  p.upper = value("upper");
  p.prior_is_share = table.has("prior") && !is_error && table.is_text("prior") && table.unit_as_written("prior") == "%";
  if (p.prior_is_share) {
    p.prior = table.quantity("prior", kRatio);
    if (!(*p.prior > 0.0)) table.fail("prior", "more than 0");
  } else {
    p.prior = value("prior");
  }
  if (is_mass)
    table.require(p.prior.has_value(), "prior", "how well this mass is known: readings tell little of masses");
  table.finish();
  return p;
}

DrawOptions read_draws(Cursor table) {
  table.only(calibrate_posterior_keys());
  DrawOptions draws;
  draws.draws = static_cast<int>(table.integer("draws"));
  draws.chains = static_cast<int>(table.integer("chains"));
  draws.temperatures = static_cast<int>(table.integer("temperatures"));
  draws.warm_up = static_cast<int>(table.integer("warm_up"));
  draws.thin = static_cast<int>(table.integer("thin"));
  draws.reach = table.number("reach");
  table.require(draws.draws >= 8 * draws.chains, "draws", "at least 8 of each chain");
  table.finish();
  return draws;
}

PlannedRun read_run(Cursor& run, const std::string& study_file) {
  PlannedRun planned;
  planned.origin = run.origin();
  for (Cursor& sensor : run.tables("sensor")) planned.sensors.push_back(read_sensor(sensor, study_file));
  std::string data;
  if (planned.sensors.empty()) {
    data = run.text("data");
    planned.data = beside(study_file, data);
    planned.origin = run.origin("data");
  } else if (run.has("data")) {
    run.fail_found("data", "data beside sensors", "data, or [[calibrate.run.sensor]] tables");
  }
  planned.name = run.text("name", planned.sensors.empty() ? data : planned.sensors.front().data);
  planned.settings = settings_of(run);
  run.finish();
  return planned;
}

MeasuredData data_of(const PlannedRun& run, const Mechanism& mechanism) {
  if (run.sensors.empty())
    return read_referred(run.origin, "data", run.data, [&] { return read_measured_data(run.data); });
  std::vector<MeasuredData> sensors;
  for (const PlannedSensor& sensor : run.sensors) sensors.push_back(read_data(sensor, mechanism));
  return together(sensors);
}

// What the mechanism's own reader would refuse is refused as a start or a bound.
void check_values(const PlannedParameter& p, const Mechanism& mechanism,
                  const std::function<std::shared_ptr<const Mechanism>(const std::vector<Setting>&)>& mechanism_with) {
  const std::string unit = ParameterPath(mechanism.description(), p.path, p.origin).unit();
  for (const std::optional<double>& value : {p.start, p.lower, p.upper}) {
    if (!value) continue;
    const TriedValue tried(*value, unit);
    try {
      mechanism_with({{p.path, tried.exact()}});
    } catch (const InputError& error) {
      throw InputError(p.origin, p.path, tried.in_message(error.found), error.expected, error.nearest);
    }
  }
}

FittedParameter planned_parameter(const PlannedParameter& p, const Mechanism& mechanism) {
  // Where numbers of the path differ, the first of them: a start alone, from which one value is fitted to all.
  const double own = ParameterPath(mechanism.description(), p.path, p.origin).values(mechanism.parameters()).front();
  FittedParameter fitted = fitted_parameter(mechanism.description(), p.path, p.start.value_or(own), p.origin);
  if (!fitted.is_error() && !(fitted.start > 0.0))
    throw InputError(p.origin, p.path, "a start of 0", "start = ..., more than 0");
  if (!p.written_unit.empty()) fitted.written_unit = p.written_unit;
  if (p.prior) {
    fitted.has_prior = true;
    (fitted.is_error() ? fitted.size : fitted.prior) = *p.prior * (p.prior_is_share ? fitted.start : 1.0);
  }
  fitted.lower = p.lower.value_or(fitted.lower);
  fitted.upper = p.upper.value_or(fitted.upper);
  if (!(fitted.lower < fitted.start && fitted.start < fitted.upper)) {
    const auto text = [](double x) {
      char digits[40];
      std::snprintf(digits, sizeof digits, "%g", x);
      return std::string(digits);
    };
    throw InputError(p.origin, p.path, "a start of " + text(fitted.start),
                     "one between lower and upper, " + text(fitted.lower) + " and " + text(fitted.upper));
  }
  return fitted;
}

// Without a contact's parameter no motion is followed, and contact laws make no difference.
void refuse_what_poses_have_not(const CalibrationPlan& plan, const CalibrationProblem& problem) {
  if (!problem.follows_play() && !plan.laws.empty())
    throw InputError(plan.parameters.front().origin, "calibrate.laws", "contact laws where errors alone are fitted",
                     "no laws, or a parameter of a clearance beside the errors");
}

// A law whose numbers the file has not would be compared with none of them.
void refuse_law_without_numbers(const CalibrationPlan& plan, const MechanismDescription& mechanism,
                                const std::string& law) {
  const ContactGeometry geometry = normal_law(law).geometry;
  for (const ClearanceDescription& c : mechanism.clearances) {
    const JointDescription& joint = mechanism.joints[static_cast<std::size_t>(c.joint)];
    const auto refuse = [&](const std::string& expected) {
      throw InputError(plan.parameters.front().origin, "calibrate.laws",
                       in_quotes(law) + " for " + in_quotes(joint.name), expected);
    };
    if (geometry == ContactGeometry::linear && !(c.parameters.contact.linear_stiffness > 0.0))
      refuse("laws that need no stiffness of their own, which the mechanism file gives that law alone");
    if (geometry == ContactGeometry::line &&
        (!(c.parameters.sleeve_length > 0.0) || joint.type == JointType::spherical || joint.type == JointType::planar ||
         c.guide == GuideShape::rectangular))
      refuse("laws for points: a law for cylinders is one of a journal in a sleeve whose length is known");
  }
}

// Which fitted parameter a setting would hold at a value of its own; "": none.
std::string also_fitted(const MechanismDescription& mechanism, const VariedPaths& fitted, const std::string& path) {
  try {
    for (const std::string& single : single_paths(mechanism, path))
      if (fitted.contains(single)) return single;
  } catch (const InputError&) {  // no parameter: a drive, a law
  }
  return "";
}

// What is held out of the fit has to be read with offsets that the fit knows.
void refuse_offsets_held_out(const CalibrationPlan& plan, const CalibrationProblem& problem) {
  for (const CalibrationProblem::Offset& offset : problem.offsets) {
    const CalibrationRun& run = problem.runs[static_cast<std::size_t>(offset.run)];
    const auto read = run.data.value.col(problem.column(offset.run, offset.channel)).array();
    if (std::none_of(problem.windows.begin(), problem.windows.end(), [&](const Window& w) {
          return w.run == offset.run && !w.held_out && read.segment(w.first, w.last - w.first + 1).isFinite().any();
        }))
      throw InputError(plan.hold_out_origin, "calibrate.hold_out",
                       "every window in which " + run.name + " has readings of " +
                           channel_names()[problem.channels[static_cast<std::size_t>(offset.channel)]].name,
                       "a smaller share or shorter windows, as each run has offsets of its own (offsets_per_run), "
                       "which readings of it that are fitted have to tell");
  }
}

}  // namespace

CalibrationPlan read_calibration_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism) {
  Cursor table = root.table("calibrate");
  table.only(calibrate_keys());
  CalibrationPlan plan;
  if (const std::optional<double> window = table.quantity_or_word("window")) plan.window = *window;
  plan.from_rest = table.choice("start") == "rest";
  plan.data_from = study.index.start;
  const std::string loss = table.choice("loss");
  plan.loss.kind = loss == "none" ? Loss::none : loss == "huber" ? Loss::huber : Loss::cauchy;
  plan.loss.scale = table.number("loss_scale", loss == "cauchy" ? 2.4 : 2.0);
  plan.starts = static_cast<int>(table.integer("starts"));
  plan.seed = static_cast<std::uint64_t>(table.integer("seed"));
  plan.corrections = static_cast<int>(table.integer("corrections"));
  plan.confidence = table.number("confidence");
  if (table.has("time_offset")) plan.largest_time_offset = table.quantity("time_offset");
  if (table.has("sensor_lag")) plan.sensor_lag = table.quantity("sensor_lag");
  plan.mounting_bias = table.boolean("mounting_bias");
  plan.drift = table.boolean("drift");
  plan.offsets_per_run = table.boolean("offsets_per_run");
  if (plan.offsets_per_run && !plan.mounting_bias && !plan.drift)
    table.fail_found("offsets_per_run", "true", "mounting_bias or drift beside it, which say that there are offsets");
  Cursor discrepancy = table.table_or_empty("discrepancy");
  discrepancy.only(calibrate_discrepancy_keys());
  plan.discrepancy = {discrepancy.quantity("axial", plan.discrepancy.axial),
                      discrepancy.quantity("masses", plan.discrepancy.masses), discrepancy.quantity("lag"),
                      discrepancy.boolean("law")};
  discrepancy.finish();
  if (table.has("hold_out")) {
    plan.hold_out = table.quantity("hold_out");
    plan.hold_out_origin = table.origin("hold_out");
  }
  plan.profile = table.boolean("profile");
  if (table.has("posterior")) {
    plan.draws = read_draws(table.table("posterior"));
    plan.draws_origin = table.origin("posterior");
  }
  if (table.has("laws")) plan.laws = table.choices("laws");
  plan.noise =
      VecX::Constant(static_cast<Eigen::Index>(channel_names().size()), std::numeric_limits<double>::quiet_NaN());
  if (table.has("noise")) {
    Cursor noise = table.table("noise");
    noise.only(calibrate_noise_keys());
    for (std::size_t c = 0; c < channel_names().size(); ++c) {
      const ChannelName& channel = channel_names()[c];
      if (!noise.has(channel.name)) continue;
      plan.noise[static_cast<Eigen::Index>(c)] = noise.quantity(channel.name);
      plan.noise_origin[static_cast<int>(c)] = noise.origin(channel.name);
    }
    noise.finish();
  }
  VariedPaths fitted(mechanism);
  for (Cursor& parameter : table.tables("parameter")) {
    plan.parameters.push_back(read_parameter(parameter, mechanism));
    // Data are made with the mechanism's own values: what a fit has no use for calibration_problem() says.
    fitted.take(parameter.origin("path"), parameter.path("path"), {plan.parameters.back().path}, OwnValue::read);
  }
  for (Cursor& run : table.tables("run")) {
    run.only(calibrate_run_keys());
    plan.runs.push_back(read_run(run, study.file));
    for (const Setting& setting : plan.runs.back().settings)
      if (const std::string both = also_fitted(mechanism, fitted, setting.path); !both.empty())
        run.fail_found("set", "\"" + both + "\", which is fitted", "settings of what is known");
  }
  for (Cursor& candidate : table.tables("candidate")) {
    candidate.only(calibrate_candidate_keys());
    const std::string name = candidate.text("name");
    plan.candidates.push_back({name, "", settings_of(candidate), candidate.origin()});
    for (const Setting& setting : plan.candidates.back().settings)
      if (const std::string both = also_fitted(mechanism, fitted, setting.path); !both.empty())
        candidate.fail_found("set", "\"" + both + "\", which is fitted", "settings of what is known");
    candidate.finish();
  }
  table.finish();
  return plan;
}

CalibrationProblem calibration_problem(
    const CalibrationPlan& plan,
    const std::function<std::shared_ptr<const Mechanism>(const std::vector<Setting>&)>& mechanism_with) {
  CalibrationProblem problem;
  for (const PlannedRun& run : plan.runs) {
    const std::shared_ptr<const Mechanism> with_settings = mechanism_with(run.settings);
    problem.runs.emplace_back(run.name, with_settings, data_of(run, *with_settings));
  }
  for (CalibrationRun& run : problem.runs)
    for (std::size_t i = 0; i < run.data.time.size() && run.data.time[i] < plan.data_from; ++i)
      run.data.value.row(static_cast<Eigen::Index>(i)).setConstant(std::numeric_limits<double>::quiet_NaN());
  const Mechanism& mechanism = *problem.runs.front().mechanism;
  for (const PlannedParameter& p : plan.parameters) check_values(p, mechanism, mechanism_with);
  VariedPaths fitted(mechanism.description());
  for (const PlannedParameter& p : plan.parameters)
    fitted.take(p.origin, p.path, {p.path}, p.start ? OwnValue::unread : OwnValue::read);
  for (const std::string& law : plan.laws) refuse_law_without_numbers(plan, mechanism.description(), law);
  for (const CalibrationRun& run : problem.runs)
    for (int channel : run.data.channels)
      if (channel_names()[channel].name == std::string("line_of_sight_error") && !mechanism.pointing().line_of_sight)
        throw InputError({run.data.file, 1}, "line_of_sight_error", "it of a mechanism that names no target",
                         "a [pointing] table with a target or a distance in " + mechanism.description().origin.file);
  const bool follows_play = std::any_of(plan.parameters.begin(), plan.parameters.end(),
                                        [](const auto& p) { return p.path.starts_with("clearance."); });
  for (int c = 0; follows_play && c < mechanism.clearances(); ++c) {
    const ClearanceDescription& clearance = mechanism.description().clearances[c];
    if (JointPlay(clearance, mechanism.description().joints[clearance.joint].type, clearance.parameters).sticks)
      throw InputError(clearance.origin, "friction.law", in_quotes(clearance.friction_law),
                       "a law without bristles: calibrate does not follow their state");
  }
  for (const PlannedParameter& p : plan.parameters) problem.parameters.push_back(planned_parameter(p, mechanism));
  refuse_what_poses_have_not(plan, problem);
  problem.loss = plan.loss;
  problem.largest_time_offset = plan.largest_time_offset;
  problem.fit_time_offset = plan.largest_time_offset > 0.0;
  problem.fit_lag = plan.sensor_lag > 0.0;
  problem.lag_prior = plan.sensor_lag;
  problem.fit_bias = plan.mounting_bias;
  problem.fit_drift = plan.drift;
  problem.offsets_per_run = plan.offsets_per_run;
  allow_for(plan.discrepancy, problem);
  problem.prepare(plan.window, plan.from_rest);
  for (const auto& [channel, origin] : plan.noise_origin)
    if (std::find(problem.channels.begin(), problem.channels.end(), channel) == problem.channels.end())
      throw InputError(origin,
                       std::string("calibrate.noise.") + channel_names()[static_cast<std::size_t>(channel)].name,
                       "noise of a channel that no data have", "a channel that was measured");
  hold_out_windows(problem, plan.hold_out);
  if (plan.offsets_per_run && plan.hold_out > 0.0) refuse_offsets_held_out(plan, problem);
  if (plan.hold_out > 0.0 && problem.windows.size() < 2)
    throw InputError(plan.hold_out_origin, "calibrate.hold_out", "one window",
                     "two at least, so that one is left to fit: a second run, or a window shorter than the run");
  if (plan.draws &&
      std::any_of(problem.windows.begin(), problem.windows.end(), [](const Window& w) { return !w.from_rest; }))
    throw InputError(plan.draws_origin, "calibrate.posterior",
                     "windows that start freely, whose start states would have to be drawn too",
                     "runs from rest: window = \"whole\" and start = \"rest\"");
  if (std::none_of(problem.windows.begin(), problem.windows.end(), [](const Window& w) { return !w.held_out; }))
    throw InputError({problem.runs.front().data.file, 0}, "data", "too few values",
                     "more in a window than its start state has numbers");
  return problem;
}

}  // namespace boresight
