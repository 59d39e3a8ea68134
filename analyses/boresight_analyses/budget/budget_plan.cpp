#include "boresight_analyses/budget/budget_plan.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "boresight/io/content_hash.hpp"
#include "boresight/io/referred_file.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/budget_keys.hpp"
#include "boresight_analyses/budget/budget_runs.hpp"
#include "boresight_analyses/budget/read_contributor.hpp"
#include "boresight_analyses/budget/read_correlations.hpp"
#include "boresight_analyses/budget/read_noise.hpp"
#include "boresight_analyses/budget/read_parts.hpp"

namespace boresight {
namespace {

constexpr double kMostHistorySamples = 100'000;
constexpr double kUsualHistorySamples = 2000.0;

template <typename Values>
std::vector<std::string> names_of(const Values& values) {
  std::vector<std::string> names;
  for (const auto value : values) names.emplace_back(to_string(value));
  return names;
}

template <typename Values>
auto chosen(Cursor& table, const std::string& key, const Values& values) {
  const std::vector<std::string> names = names_of(values);
  const std::string name = table.choice(key);
  return values[std::find(names.begin(), names.end(), name) - names.begin()];
}

std::size_t read_axis(Cursor& table, const std::string& key, const BudgetAxes& axes) {
  const std::vector<std::string> known = axes.all();
  const std::string name = table.choice(key, known, axes.total);
  return static_cast<std::size_t>(std::find(known.begin(), known.end(), name) - known.begin());
}

// One requirement, or of jitter one for each exposure.
std::vector<BudgetRequirement> read_requirement(Cursor& table, const BudgetPlan& plan, const BudgetAxes& axes,
                                                const SiUnit& unit) {
  table.only(budget_requirement_keys());
  BudgetRequirement r;
  r.index = chosen(table, "index", kErrorIndices);
  const bool jitter = table.has("exposures");
  if (table.has("limits") && !jitter) table.fail("limits", "exposures beside it, each of which has a limit");
  if (jitter && r.index != ErrorIndex::rpe)
    table.fail_found("exposures", std::string("exposures of ") + to_string(r.index),
                     "exposures with index = \"RPE\" only");
  if (jitter && table.has("limit")) table.fail_found("limit", "exposures and limit", "limits, one for each exposure");
  const std::string missing = jitter ? "" : plan.windows.missing_for(r.index, plan.duration);
  if (!missing.empty())
    table.fail("index", std::string("in [budget] ") + missing + ", which " + to_string(r.index) + " needs");
  r.axis = read_axis(table, "axis", axes);
  r.interpretation = chosen(table, "interpretation", kInterpretations);
  r.probability = table.number("probability");
  r.confidence = table.number("confidence");
  std::vector<BudgetRequirement> out;
  if (jitter) {
    const std::vector<double> exposures = table.quantities("exposures"), limits = table.values("limits", unit);
    r.unit = table.unit_as_written("limits");
    if (limits.size() != exposures.size())
      table.fail_found("limits", std::to_string(limits.size()) + " of them",
                       std::to_string(exposures.size()) + ", one for each exposure");
    for (std::size_t k = 0; k < exposures.size(); ++k) {
      r.exposure = exposures[k];
      r.limit = limits[k];
      table.require(r.exposure >= 2.0 * plan.sampling, "exposures", "at least two samples of the history each");
      const std::string needed = plan.windows_of(r).missing_for(r.index, plan.duration);
      table.require(needed.empty(), "exposures", needed);
      out.push_back(r);
    }
  } else {
    r.limit = table.quantity("limit", unit);
    r.unit = table.unit_as_written("limit");
    out.push_back(r);
  }
  table.finish();
  return out;
}

void read_times(Cursor& table, BudgetPlan& plan, double index_start, double duration) {
  plan.start = table.quantity("start", index_start);
  table.require(plan.start >= 0.0 && plan.start < duration, "start", "0 or more, and before the end of the motion");
  plan.duration = duration - plan.start;
  plan.sampling = table.quantity("sampling", duration / kUsualHistorySamples);
  table.require(duration / plan.sampling <= kMostHistorySamples && plan.sampling <= 0.1 * plan.duration, "sampling",
                "10 to 100000 samples in the motion");
  Windows& w = plan.windows;
  w.start = plan.start;
  w.window = table.quantity("window", 0.0);
  table.require(w.window == 0.0 || w.window >= 2.0 * plan.sampling, "window", "at least two samples of the history");
  w.separation = table.quantity("separation", 0.0);
  w.observation = table.quantity("observation", 0.0);
  table.require(w.observation <= plan.duration, "observation", "no longer than the motion from `start` on");
  w.revisit = table.quantity("revisit", 0.0);
  // What is given is meant: a window that an index cannot use is a mistake, not less of a budget.
  const auto fits = [&](const char* key, ErrorIndex index) {
    const std::string missing = w.missing_for(index, plan.duration);
    if (table.has(key) && !missing.empty()) table.fail(key, missing);
  };
  fits("window", ErrorIndex::mpe);
  fits("separation", ErrorIndex::pde);
  fits("revisit", ErrorIndex::pre);
  // Whole samples may have no place for what fits in seconds.
  if (w.missing_for(ErrorIndex::pre, plan.duration).empty() &&
      index_values(ErrorIndex::pre, {plan.sampling, std::vector<Vec3>(samples_of(plan), Vec3::Zero())}, w).empty())
    table.fail(table.has("revisit") ? "revisit" : "window",
               "windows that find a place in the samples of the motion: a finer `sampling`, or a shorter window");
}

// What scatters: the study's [[random]] tables, or those of a calibration's posterior.
void read_scatter(Cursor& root, Cursor& table, BudgetPlan& plan, const Study& study,
                  const MechanismDescription& mechanism, const std::function<void(const Setting&)>& accepts) {
  if (table.has("posterior")) {
    if (root.has("random")) table.fail("posterior", "a posterior, or [[random]] tables, and not both");
    const std::filesystem::path named = table.text("posterior");
    plan.posterior = named.is_absolute()
                         ? named.string()
                         : (std::filesystem::path(study.file).parent_path() / named).lexically_normal().string();
    read_referred(table.origin("posterior"), table.path("posterior"), plan.posterior, [&] {
      Document document = Document::from_file(plan.posterior);
      plan.posterior_hash = document.content_hash();
      Cursor posterior(document);
      posterior.only(posterior_keys());
      posterior.require(!posterior.boolean("interrupted"), "interrupted",
                        "the posterior of a calibration that was not interrupted");
      plan.inputs = read_random_inputs(posterior, mechanism, accepts);
    });
  } else if (root.has("random")) {
    plan.inputs = read_random_inputs(root, mechanism, accepts);
  } else {
    if (table.has("groups")) table.fail("groups", "[[random]] tables, whose parameters are grouped");
    return;
  }
  if (plan.posterior.empty() || table.has("groups")) {
    plan.groups = read_parameter_groups(table, plan.inputs);
    return;
  }
  // What one fit estimated is correlated, and one group.
  plan.groups = {{{}}, {"calibrated parameters"}};
  for (std::size_t i = 0; i < plan.inputs.size(); ++i) plan.groups.members[0].push_back(static_cast<int>(i));
}

}  // namespace

BudgetAxes::BudgetAxes(PointingQuantity quantity) {
  const bool two = quantity == PointingQuantity::boresight_error || quantity == PointingQuantity::line_of_sight_error;
  names = two ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
  total = two ? "half cone" : "total";
}

std::vector<std::string> BudgetAxes::all() const {
  std::vector<std::string> out = names;
  out.push_back(total);
  return out;
}

BudgetRequirement BudgetPlan::headline(const BudgetAxes& axes) const {
  for (const BudgetRequirement& r : requirements)
    if (r.exposure == 0.0) return r;
  return BudgetRequirement{.axis = axes.count()};
}

Windows BudgetPlan::windows_of(const BudgetRequirement& requirement) const {
  Windows w = windows;
  if (requirement.exposure > 0.0) w.window = requirement.exposure;
  return w;
}

bool BudgetPlan::is_of_errors(std::size_t group) const {
  for (const int i : groups.members[group])
    for (const std::string& path : inputs.parameters[static_cast<std::size_t>(i)].paths)
      if (!path.starts_with("error.")) return false;
  return true;
}

std::vector<ErrorIndex> BudgetPlan::indices() const {
  std::vector<ErrorIndex> out;
  for (const ErrorIndex index : kErrorIndices)
    if (windows.missing_for(index, duration).empty()) out.push_back(index);
  return out;
}

std::string BudgetPlan::sample_text(const Study& study) const {
  char times[80];
  std::snprintf(times, sizeof times, "sampling %.17g start %.17g\n", sampling, start);
  std::string text = inputs.text + design().text() + "\nquantity " + study.index.quantity + "\n" + times;
  if (const std::size_t lead = lead_of(*this); lead > 0) text += "lead " + std::to_string(lead) + "\n";
  for (const auto& group : groups.members) {
    text += "group";
    for (const int i : group) text += " " + std::to_string(i);
    text += "\n";
  }
  return text;
}

std::string question_of(const BudgetPlan& plan, const BudgetRequirement& r) {
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, " %.17g", value);
    return std::string(text);
  };
  const Windows w = plan.windows_of(r);
  std::string text = std::string(to_string(r.index)) + " " + std::to_string(r.axis) + " " + to_string(r.interpretation);
  for (const double value :
       {r.limit, r.probability, r.confidence, plan.leave_out, w.window, w.separation, w.observation, w.revisit})
    text += number(value);
  if (plan.through) text += "\nthrough " + plan.through->text();
  for (const Contributor& c : plan.contributors) {
    if (const auto& e = c.of_error) {
      text += "\nerror " + e->error + " course " + e->text + " group " + c.group;
      for (const DistributionPtr& spread : {e->factor, e->value}) text += "\n" + (spread ? spread->text() : "none");
      continue;
    }
    text += std::string("\n") + to_string(c.kind) + number(c.period) + number(c.correlation_time) +
            (c.recalibrated ? " recalibrated " : " ") + c.group + (c.noise ? " " + c.noise->text() : "") +
            (c.measured ? " " + c.measured->text() : "") + (c.through ? " " + c.through->text() : "");
    for (const DistributionPtr& parameter : c.parameter)
      text += "\n" + (parameter ? parameter->text() : std::string("none"));
  }
  const auto matrix = [&](const Mat3& m) {
    if (m != Mat3::Identity())
      for (const double value : m.reshaped()) text += number(value);
  };
  for (const Contributor& c : plan.contributors) {
    matrix(c.frame);
    matrix(c.axes_factor);
  }
  for (const ContributorCorrelation& c : plan.correlations)
    text += "\ncorrelation " + std::to_string(c.first) + " " + std::to_string(c.second) + number(c.coefficient);
  ContentHash hash;
  hash.add(text);
  return "first_look " + hash.hexadecimal();
}

BudgetPlan read_budget_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism, double duration,
                            const std::function<void(const Setting&)>& accepts) {
  Cursor table = root.table("budget");
  table.only(budget_keys());
  BudgetPlan plan;
  plan.members = static_cast<std::uint64_t>(table.integer("members"));
  const auto most = static_cast<long long>(plan.members);
  const long long again = table.integer("attribution", std::min(most, static_cast<long long>(plan.attribution)));
  table.require(again >= 2 && again <= most, "attribution", "2 to " + std::to_string(most));
  plan.attribution = static_cast<std::uint64_t>(again);
  plan.seed = static_cast<std::uint64_t>(table.integer("seed"));
  plan.confidence = table.number("confidence");
  plan.leave_out = table.number("leave_out");
  read_times(table, plan, study.index.start, duration);
  if (const std::vector<TransferFunction> through = read_through(table); !through.empty())
    plan.through = in_a_row(through);
  read_scatter(root, table, plan, study, mechanism, accepts);
  const BudgetAxes axes(study.index.kind());
  const bool angle = study.index.si_unit() == "rad";
  const SiUnit unit = angle ? kAngle : kLength;
  for (Cursor& entry : table.tables("contributor")) {
    plan.contributors.push_back(read_contributor(entry, plan, study.index.kind(), mechanism));
    const std::string& name = plan.contributors.back().name;
    for (std::size_t i = 0; i + 1 < plan.contributors.size(); ++i)
      if (plan.contributors[i].name == name)
        entry.fail_found("name", "\"" + name + "\" a second time", "each contributor once");
  }
  for (Cursor& entry : table.tables("requirement"))
    for (const BudgetRequirement& one : read_requirement(entry, plan, axes, unit)) plan.requirements.push_back(one);
  read_parts(table, plan, unit);
  read_correlations(table, plan);
  table.finish();
  return plan;
}

}  // namespace boresight
