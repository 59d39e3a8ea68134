#include "match/match_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "boresight/pointing/relative_text.hpp"
#include "report_parts/report_parts.hpp"
#include "results/pilot_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

std::string value_text(const MatchStudy& s, double value) {
  if (!std::isfinite(value)) return "none";
  if (s.plan.objective.measure == Measure::free_flight_share) return fmt::format("{:.3g} %", 100.0 * value);
  return readable_as(value, s.plan.objective.si_unit(s.study.index), written_unit(s.plan, s.plan.objective.measure));
}

DisplayUnit objective_unit(const MatchStudy& s) {
  double most = 0.0;
  for (const MatchingVisit& v : s.result.visits)
    if (std::isfinite(v.objective)) most = std::max(most, std::abs(v.objective));
  if (s.plan.objective.measure == Measure::free_flight_share) return {"%", 100.0};
  return display_unit_as(s.plan.objective.si_unit(s.study.index), most, written_unit(s.plan, s.plan.objective.measure));
}

DisplayUnit variable_unit(const DesignVariable& v) {
  return display_unit_as(v.si_unit, std::max(std::abs(v.from), std::abs(v.to)), v.unit);
}

report::Axis axis_of(const DesignVariable& v) { return {v.name(), variable_unit(v).name, v.log}; }

report::Table optimum_table(const MatchStudy& s) {
  report::Table table{
      .title = "The optimum",
      .caption =
          "As good: the values among those tried whose objective cannot be told from the optimum's with "
          "these samples, or within the accuracy.",
      .columns = {{"variable"}, {"value"}, {"as good"}, {"bounds"}, {"at its bound"}}};
  for (std::size_t i = 0; i < s.plan.variables.size(); ++i) {
    const DesignVariable& v = s.plan.variables[i];
    std::string as_good = "";
    if (i < s.result.as_good_from.size())
      as_good = readable_as(s.result.as_good_from[i], v.si_unit, v.unit) + " to " +
                readable_as(s.result.as_good_to[i], v.si_unit, v.unit);
    table.rows.push_back({v.name(), readable_as(s.result.design[i], v.si_unit, v.unit), as_good,
                          readable_as(v.from, v.si_unit, v.unit) + " to " + readable_as(v.to, v.si_unit, v.unit),
                          s.result.at_bound[i] ? "yes" : "no"});
  }
  return table;
}

report::Table descent_table(const MatchStudy& s) {
  report::Table table{
      .title = "Descents held against each other",
      .caption =
          "The same answer: the end's objective is not worse than the best one's by more than the accuracy, "
          "as far as the "
          "samples can tell.",
      .columns = {{"from"}, {"start"}, {"end"}, {"objective"}, {"evaluations"}, {"same answer"}}};
  for (const MatchingDescent& d : s.result.descents)
    table.rows.push_back({d.from, design_text(s.plan, d.start), design_text(s.plan, d.end), value_text(s, d.objective),
                          d.evaluations, d.agrees ? "yes" : "no"});
  return table;
}

report::Series optimum_mark(const MatchStudy& s, const report::Numbers& x, const report::Numbers& y) {
  return {
      .name = "optimum", .x = x, .y = y, .style = report::Style::markers, .text = {value_text(s, s.result.objective)}};
}

// One variable: the objective along it. Two or more: over the first two, with the way of the search.
report::Chart map_chart(const MatchStudy& s) {
  const MatchingMap& map = s.result.map;
  const DesignVariable& v = s.plan.variables[0];
  const DisplayUnit ux = variable_unit(v), uz = objective_unit(s);
  report::Chart chart{.title = "The objective and the way of the search", .x = axis_of(v)};
  report::Numbers x;
  for (const double value : map.x) x.push_back(value * ux.per_si);
  if (map.y.empty()) {
    chart.y = {s.plan.objective.title(s.study.index), uz.name};
    report::Numbers y;
    for (const double value : map.value.front()) y.push_back(value * uz.per_si);
    chart.series.push_back({.name = "map", .x = x, .y = y, .style = report::Style::line_markers});
    report::Series tried{.name = "tried by the search", .style = report::Style::markers};
    report::Numbers tx, ty;
    for (const MatchingVisit& visit : s.result.visits)
      if (visit.stage != "map" && visit.stage != "front" && std::isfinite(visit.objective)) {
        tx.push_back(visit.design[0] * ux.per_si);
        ty.push_back(visit.objective * uz.per_si);
        tried.text.push_back(visit.stage);
      }
    tried.x = tx;
    tried.y = ty;
    chart.series.push_back(std::move(tried));
    chart.series.push_back(optimum_mark(s, {s.result.design[0] * ux.per_si}, {s.result.objective * uz.per_si}));
    return chart;
  }
  const DesignVariable& w = s.plan.variables[1];
  const DisplayUnit uy = variable_unit(w);
  chart.y = axis_of(w);
  chart.caption = "Colours: the objective, the other variables at the optimum; gaps: a constraint is broken.";
  chart.height = 520;
  report::Heatmap heat{.x = x, .label = s.plan.objective.title(s.study.index), .unit = uz.name};
  report::Numbers y;
  for (const double value : map.y) y.push_back(value * uy.per_si);
  heat.y = y;
  for (const auto& row : map.value) {
    heat.z.emplace_back();
    for (const double value : row) heat.z.back().push_back(value * uz.per_si);
  }
  chart.heatmap = std::move(heat);
  std::vector<std::string> stages;
  for (const MatchingVisit& visit : s.result.visits)
    if (visit.stage != "map" && visit.stage != "front" &&
        std::find(stages.begin(), stages.end(), visit.stage) == stages.end())
      stages.push_back(visit.stage);
  for (const std::string& stage : stages) {
    report::Numbers px, py;
    for (const MatchingVisit& visit : s.result.visits)
      if (visit.stage == stage) {
        px.push_back(visit.design[0] * ux.per_si);
        py.push_back(visit.design[1] * uy.per_si);
      }
    chart.series.push_back(
        {.name = stage,
         .x = px,
         .y = py,
         .style = stage == "search of the box" ? report::Style::markers : report::Style::line_markers});
  }
  chart.series.push_back(optimum_mark(s, {s.result.design[0] * ux.per_si}, {s.result.design[1] * uy.per_si}));
  return chart;
}

report::Chart settling_chart(const MatchStudy& s) {
  const DisplayUnit unit = objective_unit(s);
  report::Chart chart{.title = "How the search settled",
                      .caption = "Every design in the order it was asked for, and the best so far.",
                      .x = {"evaluation", ""},
                      .y = {s.plan.objective.title(s.study.index), unit.name}};
  report::Numbers n, value, best;
  double least = std::nan("");
  for (const MatchingVisit& v : s.result.visits) {
    if (v.stage == "map" || v.stage == "front") continue;
    if (v.violation <= 1e-6 && std::isfinite(v.objective) && !(v.objective >= least)) least = v.objective;
    n.push_back(static_cast<double>(n.size() + 1));
    value.push_back(v.objective * unit.per_si);
    best.push_back(least * unit.per_si);
  }
  chart.series.push_back({.name = "tried", .x = n, .y = value, .style = report::Style::markers});
  chart.series.push_back({.name = "best so far", .x = n, .y = best, .style = report::Style::steps});
  return chart;
}

report::Chart front_chart(const MatchStudy& s) {
  double most = 0.0;
  for (const FrontPoint& p : s.result.front) most = std::max(most, p.index);
  const DisplayUnit unit = display_unit_as(s.study.index.si_unit(), most, written_unit(s.plan, Measure::index));
  report::Chart chart{
      .title = "Accuracy against stability",
      .caption = "Designs that no other one beats in both. Stability: the less time in free flight the steadier.",
      .x = {s.study.index.title(), unit.name},
      .y = {"share of time in free flight", "%"}};
  report::Series series{.name = "front", .style = report::Style::line_markers};
  report::Numbers x, y;
  for (const FrontPoint& p : s.result.front) {
    x.push_back(p.index * unit.per_si);
    y.push_back(100.0 * p.free_flight_share);
    series.text.push_back(design_text(s.plan, p.design));
  }
  series.x = x;
  series.y = y;
  chart.series.push_back(std::move(series));
  return chart;
}

report::Table front_table(const MatchStudy& s) {
  report::Table table{.title = "The front", .columns = {{"design"}, {s.study.index.title()}, {"free flight"}}};
  for (const FrontPoint& p : s.result.front)
    table.rows.push_back({design_text(s.plan, p.design),
                          readable_as(p.index, s.study.index.si_unit(), written_unit(s.plan, Measure::index)),
                          readable_share(p.free_flight_share)});
  return table;
}

}  // namespace

std::string written_unit(const MatchingPlan& plan, Measure measure) {
  for (const MatchingConstraint& c : plan.constraints)
    if (c.measure.measure == measure && !c.unit.empty()) return c.unit;
  return "";
}

std::string design_text(const MatchingPlan& plan, const std::vector<double>& design) {
  std::string text;
  for (std::size_t i = 0; i < design.size(); ++i)
    text += (i == 0 ? "" : ", ") + plan.variables[i].name() + " = " +
            readable_as(design[i], plan.variables[i].si_unit, plan.variables[i].unit);
  return text;
}

std::string objective_text(const MatchingPlan& plan, const IndexChoice& index, double value, double beside) {
  if (!std::isfinite(value)) return "nothing";
  if (plan.objective.measure == Measure::free_flight_share) return fmt::format("{:.4g} %", 100.0 * value);
  const DisplayUnit unit =
      display_unit_as(plan.objective.si_unit(index), beside, written_unit(plan, plan.objective.measure));
  return fmt::format("{:.4g}{}{}", value * unit.per_si, unit.name.empty() ? "" : " ", unit.name);
}

std::string rung_of_optimum(const MatchStudy& s) {
  return s.result.on_confirming_rung ? s.result.confirmation.front().rung : s.rung.name;
}

report::Table constraint_table(const MatchStudy& s) {
  const MatchingResult& r = s.result;
  // Where a descent went on there, the values are the confirmation's already.
  const MatchingConfirmation* beside = r.confirmation.empty() || r.on_confirming_rung ? nullptr : &r.confirmation[0];
  report::Table table{.title = "Constraints at the optimum", .columns = {{"of"}, {"value on " + rung_of_optimum(s)}}};
  if (beside != nullptr) {
    table.columns.push_back({"confirmed on " + beside->rung});
    table.caption = fmt::format("Confirmed: by {} of the confirmation, which the search has not seen.",
                                how_many(beside->samples, "run"));
  }
  for (const char* name : {"at most", "kept", "active"}) table.columns.push_back({name});
  for (std::size_t k = 0; k < s.plan.constraints.size() && k < r.constraint_values.size(); ++k) {
    const MatchingConstraint& c = s.plan.constraints[k];
    const std::string unit = c.measure.si_unit(s.study.index);
    const auto beyond = [&](double value) { return !(value <= c.at_most * (1 + 1e-6)); };
    const double value = r.constraint_values[k];
    std::vector<nlohmann::json> row = {c.measure.title(s.study.index), readable_as(value, unit, c.unit)};
    std::string kept = beyond(value) ? "no" : "yes";
    if (beside != nullptr) {
      const double confirmed = beside->constraint_values.at(k);
      row.emplace_back(readable_as(confirmed, unit, c.unit));
      if (!std::isfinite(confirmed))
        kept += ", not confirmed";
      else if (beyond(confirmed) != beyond(value))
        kept += beyond(confirmed) ? ", not as confirmed" : ", but as confirmed";
    }
    row.insert(row.end(), {readable_limit(c.at_most, unit, c.unit), kept, r.active[k] ? "yes" : "no"});
    table.rows.push_back(std::move(row));
  }
  return table;
}

bool ends_at_nothing(const DesignVariable& v, double at) {
  const bool none_below = v.si_unit == "kg" || std::all_of(v.paths.begin(), v.paths.end(), [](const std::string& path) {
                            return path.starts_with("clearance.");
                          });
  return none_below && v.from == 0.0 && at - v.from < v.to - at;
}

std::string search_text(const MatchingResult& result) {
  if (result.global.empty()) return "interrupted in the search of the box, before any descent";
  if (result.local.empty()) return "search of the box: " + result.global + ", interrupted in the first descent";
  return "search of the box: " + result.global + ", descent: " + result.local;
}

// As a sentence begins.
static std::string with_capital(std::string text) {
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string match_sentence(const MatchStudy& s) {
  const MatchingResult& r = s.result;
  if (r.design.empty() && r.interrupted) return "No design was computed before the interruption.";
  if (r.design.empty()) return "Nothing was found: no design could be computed.";
  std::string text = fmt::format("{}: {} at {}", with_capital(s.plan.objective.title(s.study.index)),
                                 value_text(s, r.objective), design_text(s.plan, r.design));
  if (std::isfinite(r.interval.low) && std::isfinite(r.interval.high) && r.interval.low < r.interval.high)
    text += fmt::format(" ({} to {} at {:g} % confidence)", value_text(s, r.interval.low),
                        value_text(s, r.interval.high), 100.0 * r.interval.confidence);
  text += ".";
  if (!r.feasible)
    text += fmt::format(" No design was found that keeps all constraints: this one breaks them least, by {}.",
                        relative_text(r.violation, 3, "the bound"));
  if (!r.confirmation.empty()) text += " Confirmation: " + r.confirmation.front().sentence + ".";
  return text;
}

report::Document match_report(const MatchStudy& s) {
  report::Document document{.title = s.mechanism.name(),
                            .subtitle = "Matching: least " + s.plan.objective.title(s.study.index),
                            .verb = "match"};
  const bool good = s.result.feasible && s.result.converged && s.result.confirmed() && !s.result.interrupted;
  document.verdict = report::Verdict{
      good ? report::Standing::good : report::Standing::bad,
      (s.result.interrupted && !s.result.design.empty() ? "Interrupted; the best so far. " : "") + match_sentence(s)};
  document.warnings = s.warnings;
  document.provenance = provenance_of(s.command, s.mechanism, s.rung);
  document.provenance.back() = {"Data",
                                "summary.json and evaluations.csv beside this file; evaluations.db holds every sample"};
  document.provenance.push_back({"Study hash", s.study.content_hash});
  if (s.result.design.empty()) return document;
  document.facts = {{.label = "Least " + s.plan.objective.title(s.study.index),
                     .value = value_text(s, s.result.objective),
                     .note = "on the " + rung_of_optimum(s) + " rung"},
                    {.label = "Designs computed",
                     .value = s.result.evaluations,
                     .note = s.result.reused > 0 ? fmt::format("and {} from an earlier run", s.result.reused) : ""},
                    {.label = "Samples per design", .value = s.plan.samples}};
  for (std::size_t i = 0; i < s.plan.variables.size(); ++i)
    document.facts.push_back(
        {.label = s.plan.variables[i].name(),
         .value = readable_as(s.result.design[i], s.plan.variables[i].si_unit, s.plan.variables[i].unit)});

  report::Section optimum{.id = "optimum", .title = "What to choose", .items = {optimum_table(s)}};
  if (!s.plan.constraints.empty()) optimum.items.emplace_back(constraint_table(s));
  document.sections.push_back(std::move(optimum));
  if (!s.result.map.value.empty())
    document.sections.push_back({.id = "map", .title = "Where it lies", .items = {map_chart(s)}});
  if (s.result.front.size() > 1)
    document.sections.push_back(
        {.id = "front", .title = "What stability costs in accuracy", .items = {front_chart(s), front_table(s)}});
  const std::string how =
      with_capital(search_text(s.result) + "." + (s.result.why.empty() ? "" : " " + s.result.why + "."));
  document.sections.push_back(
      {.id = "search", .title = "How it was found", .intro = how, .items = {descent_table(s), settling_chart(s)}});
  document.sections.push_back(
      {.id = "model", .title = "What this model leaves out", .items = {report::Text{s.leaves_out}}});
  if (s.rung.pilot) document.sections.push_back(pilot_section(*s.rung.pilot));
  return document;
}

}  // namespace boresight::app
