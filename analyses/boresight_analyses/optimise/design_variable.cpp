#include "boresight_analyses/optimise/design_variable.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/keys/parameter_unit.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/optimise/design_variable_keys.hpp"

namespace boresight {

double DesignVariable::to_search(double value) const { return log ? std::log(value) : value; }
double DesignVariable::slope_of_search(double x) const { return log ? std::exp(x) : 1.0; }
double DesignVariable::from_search(double x) const {
  const double value = log ? std::exp(x) : x;
  return std::min(std::max(value, from), to);  // the logarithm's rounding
}

BoxSide DesignVariable::side() const { return {paths, si_unit, unit, from, to, from_at, to_at}; }

DesignVariable read_design_variable(Cursor& entry, const MechanismDescription& mechanism) {
  entry.only(design_variable_keys());
  DesignVariable v;
  v.paths = entry.one_or_texts("parameter");
  for (const std::string& path : v.paths) {
    v.places.emplace_back(mechanism, path, entry.origin("parameter"));
    if (v.si_unit.empty()) v.si_unit = v.places.back().unit();
    if (v.places.back().unit() != v.si_unit)
      entry.fail_found("parameter", "\"" + path + "\" in " + v.places.back().unit(),
                       "parameters that take the same values, in " + v.si_unit);
  }
  const SiUnit unit = unit_of_parameters(mechanism, v.paths, v.si_unit);
  v.from = entry.value("from", unit);
  v.to = entry.value("to", unit);
  v.unit = unit_to_say(mechanism, v.paths, entry.unit_as_written("from"));
  entry.require(v.from < v.to, "to", "more than from");
  v.log = entry.choice("scale") == "log";
  if (v.log) entry.require(v.from > 0.0, "from", "more than 0, as the scale is \"log\"");
  if (entry.has("starts")) {
    v.starts = entry.values("starts", unit);
    for (const double start : v.starts)
      entry.require(start >= v.from && start <= v.to, "starts", "values between from and to");
  }
  v.from_at = entry.origin("from");
  v.to_at = entry.origin("to");
  entry.finish();
  return v;
}

}  // namespace boresight
