#include "boresight_analyses/budget/read_contributor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/budget_keys.hpp"
#include "boresight_analyses/budget/budget_runs.hpp"
#include "boresight_analyses/budget/contributor_size.hpp"
#include "boresight_analyses/budget/line_kinds.hpp"
#include "boresight_analyses/budget/read_correlations.hpp"
#include "boresight_analyses/budget/read_measured_course.hpp"
#include "boresight_analyses/budget/read_noise.hpp"
#include "boresight_analyses/random/read_distribution.hpp"

namespace boresight {
namespace {

ContributorClass read_class(Cursor& table) {
  const std::string name = table.choice("class");
  for (const ContributorClass kind : {ContributorClass::random, ContributorClass::periodic, ContributorClass::drift})
    if (name == to_string(kind)) return kind;
  return ContributorClass::bias;
}

// A standing error of the mechanism over time.
ErrorCourse read_error_course(Cursor& table, const BudgetPlan& plan, const MechanismDescription& mechanism) {
  for (const char* key : {"class", "axes", "period", "correlation_time", "recalibrated", "spectrum", "measured",
                          "through", "frame", "axis_correlation"})
    if (table.has(key))
      table.fail_found(key, std::string("error and ") + key,
                       "error without it: course, factor and value say how a standing error varies");
  ErrorCourse error;
  error.error = table.text("error");
  const auto at = std::find_if(mechanism.errors.begin(), mechanism.errors.end(),
                               [&](const ErrorDescription& e) { return e.name == error.error; });
  if (at == mechanism.errors.end()) {
    std::vector<std::string> names;
    for (const ErrorDescription& e : mechanism.errors) names.push_back(e.name);
    table.fail_found("error", "\"" + error.error + "\"", "the name of an [[error]] of the mechanism",
                     nearest_name(error.error, names));
  }
  const ParameterPath place(mechanism, "error." + error.error);
  Parameters marked = nominal_parameters(mechanism);
  for (const RandomParameter& random : plan.inputs.parameters)
    for (const ParameterPath& drawn : random.places) drawn.set(marked, std::numeric_limits<double>::quiet_NaN());
  if (std::isnan(place.get(marked)))
    table.fail_found(
        "error", "\"" + error.error + "\", which [[random]] scatters too",
        "an error that one of the two scatters: value and distribution say here what [[random]] says there");
  error.what = kind_of(*at);
  error.si_unit = unit_of(*at, mechanism.joints);
  const SiUnit& unit = error.si_unit == "m" ? kLength : error.si_unit == "rad" ? kAngle : kTemperature;
  if (table.has("course")) {
    error.text = table.text("course");
    error.course = read_expression(table, "course", plan.start + plan.duration);
  }
  if (table.has("factor")) {
    if (!error.course) table.fail("course", "a course, which factor multiplies");
    Cursor factor = table.table("factor");
    error.factor = read_distribution(factor, kRatio);
  }
  if (table.has("value") && table.has("distribution"))
    table.fail("distribution", "a distribution, or a value, and not both");
  if (!table.has("value") && !table.has("distribution") && !error.course)
    table.fail("course", "a course, a distribution or a value");
  if (table.has("value")) {
    error.value = make_discrete({table.quantity("value", unit)}, {1.0});
    error.unit = table.unit_as_written("value");
  } else if (table.has("distribution")) {
    Cursor distribution = table.table("distribution");
    error.value = read_distribution(distribution, unit);
    error.unit = unit_as_written_of(distribution);
  }
  return error;
}

// The axes that it acts on, each with the parameter; returns them in the order in which they are named.
std::vector<std::size_t> read_axes(Cursor& table, const BudgetAxes& axes, const DistributionPtr& parameter,
                                   Contributor& c) {
  const std::vector<std::string> own = table.has("frame") ? std::vector<std::string>{"x", "y", "z"} : axes.names;
  const std::vector<std::string> named = table.has("axes") ? table.choices("axes") : own;
  std::vector<std::size_t> order;
  for (const std::string& name : named) {
    const auto at = std::find(own.begin(), own.end(), name);
    if (at == own.end()) table.fail_found("axes", "\"" + name + "\"", "an axis of the error", nearest_name(name, own));
    order.push_back(static_cast<std::size_t>(at - own.begin()));
    if (c.parameter[order.back()]) table.fail_found("axes", "\"" + name + "\" twice", "each axis once");
    c.parameter[order.back()] = parameter;
  }
  return order;
}

// How a factor scatters over the members; 1 without the key.
DistributionPtr read_factor(Cursor& table) {
  if (!table.has("factor")) return make_discrete({1.0}, {1.0});
  Cursor of = table.table("factor");
  return read_distribution(of, kRatio);
}

void refuse_beside(Cursor& table, const std::string& kind, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (table.has(key))
      table.fail_found(key, kind + " and " + key,
                       kind + " without it: it says how the contributor goes in time, and factor how it scatters");
}

void set_noise(const Noise& noise, const BudgetPlan& plan, Contributor& c) {
  c.noise = std::make_shared<const Noise>(noise);
  c.noise_course = std::make_shared<const NoiseCourse>(noise, plan.sampling, samples_of(plan));
}

void read_spectrum(Cursor& table, const BudgetPlan& plan, const BudgetAxes& axes, const std::string& si_unit,
                   Contributor& c) {
  refuse_beside(
      table, "spectrum",
      {"measured", "class", "error", "course", "value", "distribution", "period", "correlation_time", "recalibrated"});
  c.kind = ContributorClass::spectrum;
  set_noise(read_noise(table, si_unit), plan, c);
  read_axes(table, axes, read_factor(table), c);
}

void read_measured(Cursor& table, const BudgetPlan& plan, const BudgetAxes& axes, const std::string& si_unit,
                   Contributor& c) {
  refuse_beside(table, "measured",
                {"class", "error", "course", "value", "distribution", "period", "correlation_time", "recalibrated"});
  c.kind = ContributorClass::measured;
  const std::vector<std::size_t> order = read_axes(table, axes, read_factor(table), c);
  c.measured = read_measured_course(table, plan, order, si_unit);
}

// What the transfer functions leave of a class.
void read_through_of_class(Cursor& table, const BudgetPlan& plan, Contributor& c) {
  const std::vector<TransferFunction> through = read_through(table);
  if (through.empty()) return;
  if (c.kind == ContributorClass::random)
    set_noise(Noise({.deviation = 1.0, .correlation_time = c.correlation_time}, through), plan, c);
  else
    c.through = in_a_row(through);
}

Contributor read_any_size(Cursor& table, const BudgetPlan& plan, PointingQuantity quantity,
                          const MechanismDescription& mechanism) {
  const BudgetAxes axes(quantity);
  table.only(budget_contributor_keys());
  Contributor c;
  c.name = table.text("name");
  table.rename("budget.contributor." + c.name);
  if (table.has("error")) {
    c.of_error = read_error_course(table, plan, mechanism);
    c.group = table.text("group", "");
    table.finish();
    return c;
  }
  const bool angle = quantity != PointingQuantity::position_error;
  if (table.has("spectrum") || table.has("measured")) {
    (table.has("spectrum") ? read_spectrum : read_measured)(table, plan, axes, angle ? "rad" : "m", c);
    read_frame(table, axes, c);
    c.group = table.text("group", "");
    table.finish();
    return c;
  }
  if (table.has("course")) table.fail("course", "this beside error only");
  if (table.has("factor")) table.fail("factor", "this beside error, spectrum or measured only");
  if (!table.has("class"))
    table.fail("class", "a class, a spectrum, a measured course, or error for a standing error of the mechanism");
  c.kind = read_class(table);
  const bool periodic = c.kind == ContributorClass::periodic, random = c.kind == ContributorClass::random;

  const bool drift = c.kind == ContributorClass::drift;
  const SiUnit of = angle ? (drift ? kAngularRate : kAngle) : (drift ? kSpeed : kLength);
  if (table.has("value") == table.has("distribution"))
    table.fail("distribution", "a distribution, or a value, and not both");
  DistributionPtr parameter;
  if (table.has("value")) {
    parameter = make_discrete({table.quantity("value", of)}, {1.0});
  } else {
    Cursor distribution = table.table("distribution");
    parameter = read_distribution(distribution, of);
  }
  read_axes(table, axes, parameter, c);

  if (table.has("period") && !periodic) table.fail("period", "a period with class = \"periodic\" only");
  if (periodic && !table.has("period")) table.fail("period", "a period, which class = \"periodic\" needs");
  if (table.has("correlation_time") && !random)
    table.fail("correlation_time", "a correlation time with class = \"random\" only");
  c.period = table.quantity("period", 0.0);
  if (periodic && !(c.period > 2.0 * plan.sampling)) {
    // It would be folded down to a slower one, or to none.
    char found[80], expected[120];
    std::snprintf(found, sizeof found, "%.6g s", c.period);
    std::snprintf(expected, sizeof expected,
                  "more than two samples of the histories, %.6g s; a finer sampling has more", 2.0 * plan.sampling);
    table.fail_found("period", found, expected);
  }
  c.correlation_time = table.quantity("correlation_time", plan.sampling);
  c.recalibrated = table.boolean("recalibrated");
  if (c.recalibrated && (periodic || random))
    table.fail("recalibrated", "this with class = \"bias\" or \"drift\" only");
  read_through_of_class(table, plan, c);
  read_frame(table, axes, c);
  c.group = table.text("group", "");
  table.finish();
  return c;
}

}  // namespace

Contributor read_contributor(Cursor& table, const BudgetPlan& plan, PointingQuantity quantity,
                             const MechanismDescription& mechanism) {
  Contributor c = read_any_size(table, plan, quantity, mechanism);
  const double size = largest_size(c, plan.windows, plan.duration, samples_of(plan));
  if (size <= kLargestExternalError) return c;
  const std::string unit = c.of_error                                     ? c.of_error->si_unit
                           : quantity != PointingQuantity::position_error ? "rad"
                                                                          : "m";
  char found[80], expected[80];
  std::snprintf(found, sizeof found, "errors of up to %.3g %s", size, unit.c_str());
  std::snprintf(expected, sizeof expected, "none above %.0g %s", kLargestExternalError, unit.c_str());
  for (const char* key : {"measured", "spectrum", "course", "value", "distribution"})
    if (table.has(key)) table.fail_found(key, std::isfinite(size) ? found : "errors that no number holds", expected);
  throw InputError(table.origin(), table.path(), found, expected);
}

}  // namespace boresight
