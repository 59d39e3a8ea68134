#include "boresight_analyses/sweep/sweep_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "boresight/io/varied_paths.hpp"
#include "boresight/keys/parameter_unit.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/sweep/paper_facts.hpp"
#include "boresight_analyses/sweep/sweep_keys.hpp"

namespace boresight {
namespace {

std::vector<double> spaced(Cursor& axis, double from, double to) {
  const long long count = axis.integer("count");
  const bool log = axis.choice("scale") == "log";
  if (log) {
    axis.require(from > 0.0, "from", "more than 0, as the scale is \"log\"");
    axis.require(to > 0.0, "to", "more than 0, as the scale is \"log\"");
  }
  std::vector<double> values;
  for (long long i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(log ? from * std::pow(to / from, share) : from + share * (to - from));
  }
  values.back() = to;
  return values;
}

BoxSide side_of(const Cursor& axis, const SweepAxis& result) {
  const auto [least, largest] = std::minmax_element(result.values.begin(), result.values.end());
  const Origin origin = axis.origin(axis.has("values") ? "values" : "from");
  return {result.parameters, result.si_unit, result.unit, *least, *largest, origin, origin};
}

SweepAxis read_axis(Cursor& axis, const MechanismDescription& mechanism) {
  axis.only(sweep_axis_keys());
  SweepAxis result;
  result.parameters = axis.one_or_texts("parameter");

  for (const std::string& path : result.parameters) {
    const ParameterPath parameter(mechanism, path, axis.origin("parameter"));
    if (result.si_unit.empty()) result.si_unit = parameter.unit();
    if (parameter.unit() != result.si_unit)
      axis.fail_found("parameter", "\"" + path + "\" in " + parameter.unit(),
                      "parameters that take the same values, in " + result.si_unit);
  }

  const SiUnit unit = unit_of_parameters(mechanism, result.parameters, result.si_unit);
  if (axis.has("values")) {
    for (const char* key : {"from", "to", "count", "scale"})
      if (axis.has(key)) axis.fail(key, "either values, or from, to and count");
    result.values = axis.values("values", unit);
  } else if (axis.has("from")) {
    const double from = axis.value("from", unit), to = axis.value("to", unit);
    result.values = spaced(axis, from, to);
  } else {
    axis.fail("values", "values = [...], or from, to and count");
  }
  result.unit = unit_to_say(mechanism, result.parameters, axis.unit_as_written(axis.has("values") ? "values" : "from"));
  // The same value twice would be the same point twice.
  if (std::set<double>(result.values.begin(), result.values.end()).size() != result.values.size())
    axis.fail(axis.has("values") ? "values" : "to", "values that differ from one another");
  axis.finish();
  return result;
}

}  // namespace

std::size_t SweepPlan::points() const {
  std::size_t count = 1;
  for (const SweepAxis& axis : axes) count *= axis.values.size();
  return count;
}

std::vector<double> SweepPlan::values_at(std::size_t k) const {
  std::vector<double> values(axes.size());
  for (std::size_t i = axes.size(); i-- > 0; k /= axes[i].values.size())
    values[i] = axes[i].values[k % axes[i].values.size()];
  return values;
}

Parameters SweepPlan::parameters_at(const Mechanism& mechanism, std::size_t k) const {
  Parameters parameters = mechanism.parameters();
  const std::vector<double> values = values_at(k);
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (const std::string& path : axes[i].parameters)
      ParameterPath(mechanism.description(), path).set(parameters, values[i]);
  return parameters;
}

SweepPlan read_sweep_plan(Cursor& root, const MechanismDescription& mechanism, const AcceptsSetting& accepts,
                          const AcceptsSettings& accepts_all) {
  Cursor sweep = root.table("sweep");
  sweep.only(sweep_keys());
  SweepPlan plan;
  if (sweep.has("findings")) plan.findings = sweep.choice("findings");
  if (!plan.findings.empty() && !is_3_rrcpr(mechanism))
    sweep.fail("findings",
               "a mechanism of three legs of R, R, C, P and R, as that paper's; leave findings out for others");
  VariedPaths swept(mechanism);
  std::vector<BoxSide> sides;
  std::size_t points = 1;
  for (Cursor& axis : sweep.tables("axis")) {
    plan.axes.push_back(read_axis(axis, mechanism));
    sides.push_back(side_of(axis, plan.axes.back()));
    swept.take(axis.origin("parameter"), axis.path("parameter"), plan.axes.back().parameters, OwnValue::unread,
               "each parameter on one axis");
    points *= plan.axes.back().values.size();
    if (points > kMostSweepPoints)
      axis.fail_found("values", std::to_string(points) + " points in all",
                      "at most " + std::to_string(kMostSweepPoints));
  }
  check_corners(sides, accepts, accepts_all);
  sweep.finish();
  return plan;
}

}  // namespace boresight
