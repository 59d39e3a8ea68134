#include "boresight_analyses/matching/matching_plan.hpp"

#include <algorithm>

#include "boresight/io/varied_paths.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/matching/design_slopes.hpp"
#include "boresight_analyses/matching/matching_keys.hpp"

namespace boresight {
namespace {

MeasureChoice read_measure(Cursor& table, const std::string& key) {
  MeasureChoice m;
  const std::string measure = table.choice(key);
  for (const MeasureName& name : measure_names())
    if (measure == name.name) m.measure = name.measure;
  const std::string over = table.choice("over");
  for (const OverName& name : over_names())
    if (over == name.name) m.over = name.over;
  if (table.has("probability")) {
    if (m.over != Over::quantile) table.fail("probability", "probability with over = \"quantile\" only");
    m.probability = table.number("probability");
  }
  return m;
}

int count(Cursor& table, const char* key) { return static_cast<int>(table.integer(key)); }

}  // namespace

std::vector<std::vector<double>> MatchingPlan::starts() const {
  std::size_t most = 1;
  for (const DesignVariable& v : variables) most = std::max(most, v.starts.size());
  std::vector<std::vector<double>> all(most);
  for (std::size_t k = 0; k < most; ++k)
    for (const DesignVariable& v : variables)
      all[k].push_back(v.starts.empty() ? v.from_search(0.5 * (v.to_search(v.from) + v.to_search(v.to)))
                                        : v.starts[std::min(k, v.starts.size() - 1)]);
  return all;
}

Parameters MatchingPlan::parameters_with(const Mechanism& mechanism, std::span<const double> values) const {
  Parameters p = inputs ? inputs->parameters_with(mechanism, values.subspan(variables.size())) : mechanism.parameters();
  for (std::size_t i = 0; i < variables.size(); ++i)
    for (const ParameterPath& place : variables[i].places) place.set(p, values[i]);
  return p;
}

std::string MatchingPlan::sample_text(const Study& study) const {
  std::string text = "index " + study.index.text() + "\nseed " + std::to_string(seed) + " samples " +
                     std::to_string(samples) + " confirm " + std::to_string(confirm) + "\n";
  for (const DesignVariable& v : variables) {
    for (const std::string& path : v.paths) text += path + " ";
    text += "\n";
  }
  return inputs ? text + inputs->text : text;
}

MatchingPlan read_matching_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                const AcceptsSetting& accepts, const AcceptsSettings& accepts_all) {
  Cursor table = root.table("match");
  table.only(match_keys());
  MatchingPlan plan;
  plan.objective = read_measure(table, "minimise");
  bool scatters = plan.objective.over != Over::nominal;
  for (Cursor& entry : table.tables("constraint")) {
    entry.only(match_constraint_keys());
    MatchingConstraint c;
    c.measure = read_measure(entry, "measure");
    const std::string unit = c.measure.si_unit(study.index);
    c.at_most = entry.value("at_most", unit_called(unit));
    c.unit = entry.unit_as_written("at_most");
    if ((c.measure.over == Over::nominal) != (plan.objective.over == Over::nominal))
      entry.fail("over", "nominal for the objective and all constraints, or for none of them");
    scatters = scatters || c.measure.over != Over::nominal;
    plan.constraints.push_back(c);
    entry.finish();
  }
  plan.samples = static_cast<std::size_t>(table.integer("samples"));
  plan.confirm = static_cast<std::size_t>(table.integer("confirm"));
  if (!scatters)
    for (const char* key : {"samples", "confirm"})
      if (table.has(key)) table.fail(key, std::string(key) + " with over = \"mean\", \"quantile\" or \"worst\" only");
  plan.seed = static_cast<std::uint64_t>(table.integer("seed"));
  plan.evaluations = count(table, "evaluations");
  plan.tolerance = table.number("tolerance");
  plan.global = table.choice("global");
  plan.local = table.choice("local");
  plan.map = count(table, "map");
  plan.front = count(table, "front");

  VariedPaths taken(mechanism);
  for (Cursor& entry : table.tables("variable")) {
    plan.variables.push_back(read_design_variable(entry, mechanism));
    taken.take(entry.origin("parameter"), entry.path("parameter"), plan.variables.back().paths);
  }
  std::vector<BoxSide> sides;
  for (const DesignVariable& v : plan.variables) sides.push_back(v.side());
  check_corners(sides, accepts, accepts_all);
  const std::size_t n = plan.variables.size();
  if (plan.local == "bobyqa" && n < 2) table.fail("local", "cobyla: bobyqa wants two variables or more");
  if (plan.wants_gradients())
    if (const std::string why = why_no_slopes(plan); !why.empty())
      table.fail("local", "cobyla or bobyqa, which need no gradients: " + why);
  if (!plan.constraints.empty()) {
    if (plan.local == "bobyqa") table.fail("local", "cobyla: bobyqa takes no constraints");
    if (plan.global == "crs2" || plan.global == "mlsl")
      table.fail("global", "direct-l or isres: " + plan.global + " takes no constraints");
  }
  table.finish();
  if (scatters) {
    plan.inputs = read_random_inputs(root, mechanism, accepts);
    for (const RandomParameter& p : plan.inputs->parameters)
      for (const std::string& path : p.paths)
        for (const std::string& single : single_paths(mechanism, path))
          if (taken.contains(single))
            root.fail_found("random", "\"" + single + "\", which is a variable of [match] too",
                            "parameters that are either chosen or scatter");
  } else {
    plan.samples = plan.confirm = 1;
  }
  return plan;
}

bool asks_peak_acceleration(const MatchingPlan& plan) {
  bool asks = plan.objective.measure == Measure::peak_acceleration;
  for (const MatchingConstraint& c : plan.constraints) asks = asks || c.measure.measure == Measure::peak_acceleration;
  return asks;
}

}  // namespace boresight
